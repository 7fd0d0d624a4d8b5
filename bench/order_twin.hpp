#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "bench/candidate_probes.hpp"
#include "bench/order_campaign.hpp"
#include "bench/order_errors.hpp"
#include "bench/twin.hpp"
#include "sim/steady_state.hpp"

namespace rvbench::bench {

/// A plant that turns steadily beside recordings of it: means, and the lines that repeat with the
/// machine or follow supply and mains.
///
/// Values  (measured − predicted) of each mean, and of each line's amplitude, over the standard
///         error of the measurement: the noise beside the line and what repeats differ by
/// Lines   orders of the slowest body's turn that a recording shows or some effect would bring;
///         multiples of the supply's frequency and of the mains'
/// Units   a record each: whatever differs from one to the next is no knowledge
/// Leaves out: phases; angle zero is where a record happens to begin
class OrderTwin final : public Twin {
 public:
  /// @param library  outlives the twin
  static TwinOrRefusal make(sim::PlantSpec plant, const Campaign& campaign,
                            const sim::TermLibrary& library = sim::standard_terms());

  bool counts_standard_errors() const override { return true; }
  double believable() const override { return 5; }
  double least_mean_square() const override { return 1; }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>& trained) const override;
  bool is_quick() const override { return true; }

  std::vector<Comparison> compare(const std::vector<std::size_t>& effects,
                                  const std::vector<double>& values) const override;
  Cells cells(const std::vector<std::size_t>& effects,
              const std::vector<double>& values) const override;
  PushedFeatures pushed_features(const std::vector<std::size_t>& effects,
                                 const std::vector<double>& values) const override;

 private:
  OrderTwin(sim::PlantSpec plant, const sim::TermLibrary& library)
      : Twin(std::move(plant), library) {}

  ParameterScales scales() const;
  bool reverses(const sim::EffectSite& site) const;
  std::vector<CandidateProbe> probe();
  Eigen::MatrixXd marks_of(const std::vector<CandidateProbe>& probes) const;
  void cut_units();
  std::variant<std::vector<sim::SteadyState>, hal::ConfigFault> states_of(
      const sim::PlantSpec& plant, const std::vector<std::size_t>& conditions) const;
  std::optional<std::vector<sim::SteadyState>> solved(const std::vector<std::size_t>& effects,
                                                      const std::vector<double>& values) const;
  Eigen::VectorXd features_of(const sim::SteadyState& state, const OrderCondition& condition) const;

  OrderCampaign seen_;
  OrderScatter scatter_;
};

}  // namespace rvbench::bench
