#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "bench/candidate_probes.hpp"
#include "bench/order_records.hpp"
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

  Refusal load(const Campaign& campaign);
  void sort_in(OrderRecord& record, const Eigen::VectorXd& inputs);
  std::optional<hal::ConfigFault> solve_nominal(const sim::SteadyPlant& steady);
  void compare_speeds();
  ParameterScales scales() const;
  std::vector<CandidateProbe> probe();
  Eigen::MatrixXd marks_of(const std::vector<CandidateProbe>& probes) const;
  void cut_units();
  std::variant<std::vector<sim::SteadyState>, hal::ConfigFault> states_of(
      const sim::PlantSpec& plant, const std::vector<std::size_t>& conditions) const;
  std::optional<std::vector<sim::SteadyState>> solved(const std::vector<std::size_t>& effects,
                                                      const std::vector<double>& values) const;
  Eigen::VectorXd features_of(const sim::SteadyState& state, const OrderCondition& condition) const;
  Eigen::VectorXd shown_by(Eigen::VectorXd features, const OrderRecord& record) const;

  std::size_t angle_ = 0;    ///< output that is the reference shaft's angle
  int turning_ = 0;          ///< body that it is the angle of
  double period_turns_ = 0;  ///< of that body
  std::vector<OrderCondition> conditions_;
  std::vector<OrderRecord> records_;
};

}  // namespace rvbench::bench
