#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "bench/time_records.hpp"
#include "bench/twin.hpp"

namespace rvbench::bench {

/// A plant beside recordings of its inputs and outputs, compared sample by sample.
///
/// Values   (measured − simulated) of each output, over the standard deviation of what was
///          measured: their root mean square is the relative error. Where a motion is prescribed
///          below a band, the difference is kept below it too, and thinned to what is left of it.
/// Units    stretches of a record, 12 to each that is learned from, of 0.25 s at least
class TimeTwin final : public Twin {
 public:
  /// @param library  outlives the twin
  static TwinOrRefusal make(sim::PlantSpec plant, const Campaign& campaign,
                            const sim::TermLibrary& library = sim::standard_terms());

  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>& trained) const override;
  double nothing_predicted() const override;
  /// Position and speed of the body that the first output is about, as the base moves it.
  Eigen::MatrixXd states() const override;
  std::vector<std::string> notes() const override;

  std::vector<Comparison> compare(const std::vector<std::size_t>& effects,
                                  const std::vector<double>& values) const override;

  /// Means over stretches of the programmes that are repeated.
  Cells cells(const std::vector<std::size_t>& effects,
              const std::vector<double>& values) const override;

 private:
  TimeTwin(sim::PlantSpec plant, TimeRecords records, const sim::TermLibrary& library);

  bool reverses(const sim::EffectSite& site) const;
  void leave_out_what_needs_reversal();
  void leave_out_what_is_too_fast();
  void cut_units();
  sim::NaturalScales natural_scales() const;
  Eigen::VectorXd below_band(const TimeRecord& record, const Eigen::VectorXd& x,
                             Eigen::Index step) const;
  Eigen::VectorXd compared(const TimeRecord& record, const Eigen::VectorXd& x) const;
  std::optional<std::vector<Eigen::VectorXd>> apart(const sim::PlantSpec& plant,
                                                    const TimeRecord& record) const;
  std::optional<Eigen::VectorXd> by_units(
      const std::function<std::optional<std::vector<Eigen::VectorXd>>(const TimeRecord&)>& show)
      const;

  TimeRecords records_;
};

}  // namespace rvbench::bench
