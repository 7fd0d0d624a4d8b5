#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "analysis/explain/forward_model.hpp"
#include "bench/campaign.hpp"
#include "hal/config_reader.hpp"
#include "sim/effect_sites.hpp"
#include "sim/excitation.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// A plant beside recordings of its inputs and outputs, compared sample by sample.
///
/// Values   (measured − simulated) of each output, over the standard deviation of what was
///          measured: their root mean square is the relative error. Where a motion is prescribed
///          below a band, the difference is kept below it too, and thinned to what is left of it.
/// Units    stretches of a record, 12 to each that is learned from, of 0.25 s at least
/// Effects  every type of the term library at every place its gate allows
class TimeTwin final : public analysis::ForwardModel {
 public:
  /// @return the twin, or why plant and recordings do not fit
  static std::variant<std::unique_ptr<TimeTwin>, Refusal> make(
      sim::PlantSpec plant, const Campaign& campaign,
      const sim::TermLibrary& library = sim::standard_terms());  ///< outlives the twin

  const std::vector<analysis::ObservedUnit>& units() const override { return units_; }
  const std::vector<analysis::ModelParameter>& base() const override { return base_; }
  const std::vector<analysis::Candidate>& library() const override { return candidates_; }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>& trained) const override;
  /// Position and speed of the body that the first output is about, as the base moves it.
  Eigen::MatrixXd states() const override;

  /// From now on residuals() throws Interrupted once a stop is requested.
  void stop_on(std::stop_token stop) { stop_ = std::move(stop); }
  struct Interrupted : std::runtime_error {
    Interrupted() : std::runtime_error("interrupted") {}
  };

  /// The plant with these effects and values: what an accepted explanation makes of it.
  sim::PlantSpec plant_with(const std::vector<std::size_t>& effects,
                            const std::vector<double>& values) const;

  /// What was measured and what a model makes of it, for one record and output.
  struct Comparison {
    std::string record, channel, unit;
    bool learned_from = true;
    double spread = 1;  ///< of the channel: what residuals are in units of
    double rate_Hz = 0, start_s = 0;
    Eigen::VectorXd measured, simulated;  ///< in the channel's unit, below the band
    double error() const;                 ///< RMS of the difference
    double relative_error() const;        ///< over the RMS of what was measured
  };
  /// All records, also those that were only to be predicted. Empty if it cannot be simulated.
  std::vector<Comparison> compare(const std::vector<std::size_t>& effects,
                                  const std::vector<double>& values) const;

 private:
  struct Record;
  TimeTwin(sim::PlantSpec plant, const sim::TermLibrary& library);

  Refusal load(const Campaign& campaign);
  std::vector<hal::ConfigFault> load_record(const CampaignRecord& of, int steps);
  void align_repeats();
  std::vector<hal::ConfigFault> find_spreads();
  const Record& first_learned() const;
  void find_parameters(const sim::NaturalScales& natural);
  void find_candidates(const sim::NaturalScales& natural);
  void cut_units();
  sim::NaturalScales natural_scales() const;
  double largest_deviation() const;
  Eigen::VectorXd below_band(const Record& record, const Eigen::VectorXd& x,
                             Eigen::Index step) const;
  std::optional<Eigen::VectorXd> by_units(
      const std::function<std::optional<std::vector<Eigen::VectorXd>>(const Record&)>& show) const;

  sim::PlantSpec plant_;
  const sim::TermLibrary& terms_;
  std::stop_token stop_;
  double band_Hz_ = 0;  ///< 0: no limit
  std::vector<std::shared_ptr<Record>> records_;
  std::vector<double> spread_;      ///< per output: of what was measured
  std::vector<std::size_t> moved_;  ///< of quantities(plant), those in base()
  std::vector<std::pair<std::size_t, sim::EffectSite>> acts_;  ///< per candidate: type and place
  std::vector<std::map<std::string, double>> chosen_;  ///< per candidate: what is not fitted
  std::vector<analysis::ObservedUnit> units_;
  std::vector<analysis::ModelParameter> base_;
  std::vector<analysis::Candidate> candidates_;
};

}  // namespace rvbench::bench
