#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/explain/forward_model.hpp"
#include "bench/order_twin.hpp"

namespace rvbench::bench {

/// Stand-in of an OrderTwin: its complex lines and means, taken as straight in every parameter.
/// What bends between them and the residuals (amplitudes, noise) is kept as it is.
///
/// Exact  at the values where it was made
class StraightOrders final : public analysis::ForwardModel {
 public:
  /// @param twin  outlives the result
  /// @param like  one with some of these effects: what it knows of their parameters and of the
  ///              base is not looked for anew; may be nullptr
  /// @return nullptr if the twin cannot be solved there
  static std::unique_ptr<StraightOrders> make(const OrderTwin& twin,
                                              const std::vector<std::size_t>& effects,
                                              const std::vector<double>& values,
                                              const StraightOrders* like);

  const std::vector<analysis::ObservedUnit>& units() const override { return twin_.units(); }
  const std::vector<analysis::ModelParameter>& base() const override { return twin_.base(); }
  const std::vector<analysis::Candidate>& library() const override { return twin_.library(); }

  /// With other effects than its own it asks the twin.
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>& trained) const override;
  std::optional<Eigen::MatrixXd> slopes(const std::vector<std::size_t>& effects,
                                        const std::vector<double>& values,
                                        const std::vector<bool>& trained) const override;

 private:
  Eigen::VectorXcd features_at(const std::vector<double>& values) const;

  StraightOrders(const OrderTwin& twin, std::vector<std::size_t> effects,
                 std::vector<double> values)
      : twin_(twin), effects_(std::move(effects)), values_(std::move(values)) {}

  const OrderTwin& twin_;
  std::vector<std::size_t> effects_;
  std::vector<double> values_;
  Eigen::VectorXcd features_;
  Eigen::MatrixXcd slopes_;  ///< one column for each value
};

}  // namespace rvbench::bench
