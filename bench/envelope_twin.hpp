#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "bench/envelope_records.hpp"
#include "bench/twin.hpp"

namespace rvbench::bench {

/// A plant that vibrates at random beside recordings of it: levels, and the lines of the squared
/// envelope, which tell what comes and goes in step with the machine.
///
/// Values  (measured − predicted) of the level of each part of an output's band [dB], and of each
///         swell's depth, over their standard errors. Chance gives the one part of these; the
///         other is what a plant of few modes is good for: 3 dB of a level and a quarter of a
///         depth, once for a record, not once for each of its stretches
/// Lines   orders of the shaft that the plant swells at, or some effect would; each is the highest
///         within 2 % of its place, for rolling elements slip
/// Units   stretches of ten turns of the shaft, at most eight of a record
/// Leaves out: phases; a shaft that runs up or down
class EnvelopeTwin final : public Twin {
 public:
  /// @param library  outlives the twin
  static TwinOrRefusal make(sim::PlantSpec plant, const Campaign& campaign,
                            const sim::TermLibrary& library = sim::standard_terms());

  bool counts_standard_errors() const override { return true; }
  bool is_quick() const override { return true; }
  double least_mean_square() const override { return 1; }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>& trained) const override;

  std::vector<Comparison> compare(const std::vector<std::size_t>& effects,
                                  const std::vector<double>& values) const override;

  /// Of each record the level of each part of a band, at its middle, and each swell's depth.
  Cells cells(const std::vector<std::size_t>& effects,
              const std::vector<double>& values) const override;

 private:
  EnvelopeTwin(sim::PlantSpec plant, const sim::TermLibrary& library);

  Refusal load(const Campaign& campaign);
  ParameterScales scales() const;
  Refusal choose_lines();
  void cut_units();
  std::optional<std::vector<sim::Vibration>> solved(const sim::PlantSpec& plant,
                                                    const EnvelopeRecord& record) const;
  /// Calls see(record, its features without noise) for each record that is learned from.
  /// @return false where the plant cannot be solved
  bool for_each_learned(
      const sim::PlantSpec& plant,
      const std::function<void(const EnvelopeRecord&, const Eigen::VectorXd&)>& see) const;
  Eigen::VectorXd without_noise(const std::vector<sim::Vibration>& shown,
                                const EnvelopeRecord& record) const;
  void add_cells(const EnvelopeRecord& record, const Eigen::VectorXd& apart, Cells& cells) const;
  Eigen::VectorXd shown_by(Eigen::VectorXd features, const EnvelopeRecord& record,
                           std::size_t block) const;

  std::vector<EnvelopeRecord> records_;
  std::vector<std::vector<double>> orders_;  ///< per output: lines that are compared
};

}  // namespace rvbench::bench
