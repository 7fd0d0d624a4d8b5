#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/explain/forward_model.hpp"
#include "analysis/explain/residual_cells.hpp"
#include "bench/campaign.hpp"
#include "bench/plant_family.hpp"
#include "bench/pushed_features.hpp"
#include "bench/stop_on_signal.hpp"
#include "sim/plant_spec.hpp"
#include "sim/term_library.hpp"

namespace rvbench::bench {

/// A plant beside recordings of the machine it stands for.
class Twin : public analysis::ForwardModel {
 public:
  /// From now on residuals() throws Interrupted once a stop is requested.
  void stop_on(std::stop_token stop) { stop_ = std::move(stop); }

  const std::vector<analysis::ObservedUnit>& units() const final { return units_; }
  const std::vector<analysis::ModelParameter>& base() const final { return base_; }
  const std::vector<analysis::Candidate>& library() const final { return family_->candidates(); }

  /// The plant with these effects and values: what an accepted explanation makes of it.
  sim::PlantSpec plant_with(const std::vector<std::size_t>& effects,
                            const std::vector<double>& values) const {
    return family_->with(effects, values);
  }

  /// What was measured and what a model makes of it, for one record and output.
  struct Comparison {
    std::string record, channel, unit;
    bool learned_from = true;
    double spread = 1;                    ///< of the channel: what residuals are in units of
    std::string over;                     ///< "time [s]", "order of the input shaft"
    double first = 0, step = 1;           ///< of what it is over
    Eigen::VectorXd measured, simulated;  ///< in `unit`
    bool is_by_orders() const { return over.starts_with("order"); }
    double error() const;           ///< RMS of the difference
    double relative_error() const;  ///< over the RMS of what was measured
  };
  /// All records, also those that were only to be predicted. Empty if it cannot be simulated.
  virtual std::vector<Comparison> compare(const std::vector<std::size_t>& effects,
                                          const std::vector<double>& values) const = 0;

  /// What a mean or a line of a channel is off by without any reason: a part of its error.
  struct Noise {
    std::string channel, of, unit;  ///< "input_torque", "mean, from record to record", "N·m"
    double standard_deviation = 0;
  };

  /// What of the recordings is not compared, and why.
  virtual std::vector<std::string> notes() const { return {}; }

  /// Means and lines of all conditions that are learned from, beside what a model makes of them.
  struct Cells {
    std::vector<analysis::ResidualCell> all;  ///< empty if this twin compares nothing of the kind
    double beside = 0;  ///< orders, Hz, or s, within which cells are one place
    std::vector<Noise> noise = {};
  };
  virtual Cells cells(const std::vector<std::size_t>& effects,
                      const std::vector<double>& values) const {
    (void)effects, (void)values;
    return {};
  }

  /// These means and lines, with what forces on the plant's bodies would add. Empty if this twin
  /// compares nothing of the kind.
  virtual PushedFeatures pushed_features(const std::vector<std::size_t>& effects,
                                         const std::vector<double>& values) const {
    (void)effects, (void)values;
    return {};
  }

 protected:
  /// @param library  outlives the twin
  Twin(sim::PlantSpec plant, const sim::TermLibrary& library)
      : plant_(std::move(plant)), terms_(library) {}

  /// @throws Interrupted if a stop is requested
  void stop_if_asked() const { end_if_stopped(stop_); }

  sim::PlantSpec plant_;
  const sim::TermLibrary& terms_;
  std::vector<analysis::ObservedUnit> units_;
  std::optional<PlantFamily> family_;  ///< made once the recordings tell what is much
  std::vector<analysis::ModelParameter> base_;

 private:
  std::stop_token stop_;
};

using TwinOrRefusal = std::variant<std::unique_ptr<Twin>, Refusal>;

/// The twin that compares as the plant's outputs ask for, or why plant and recordings do not fit.
/// @param library  outlives the twin
TwinOrRefusal make_twin(sim::PlantSpec plant, const Campaign& campaign,
                        const sim::TermLibrary& library = sim::standard_terms());

}  // namespace rvbench::bench
