#pragma once

#include <Eigen/Core>
#include <functional>
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
  ///              base is not looked for anew, but for the last effect's if it has them all; may be
  ///              nullptr
  /// @return nullptr if the twin cannot be solved there
  static std::unique_ptr<StraightOrders> make(const OrderTwin& twin,
                                              const std::vector<std::size_t>& effects,
                                              const std::vector<double>& values,
                                              const StraightOrders* like);

  const std::vector<analysis::ObservedUnit>& units() const override { return twin_.units(); }
  const std::vector<analysis::ModelParameter>& base() const override { return twin_.base(); }
  const std::vector<analysis::Candidate>& library() const override { return twin_.library(); }

  /// With more effects than its own: what the others do to the twin without its own is done here
  /// as well. With others it asks the twin.
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>& trained) const override;
  std::optional<Eigen::MatrixXd> slopes(const std::vector<std::size_t>& effects,
                                        const std::vector<double>& values,
                                        const std::vector<bool>& trained) const override;
  /// Of what it says with more effects than its own.
  std::unique_ptr<analysis::ForwardModel> straightened(const std::vector<std::size_t>& effects,
                                                       const std::vector<double>& values,
                                                       const ForwardModel* like) const override;

 private:
  using Features = std::function<std::optional<Eigen::VectorXcd>(const std::vector<std::size_t>&,
                                                                 const std::vector<double>&)>;
  static std::unique_ptr<StraightOrders> of(const Features& features, const OrderTwin& twin,
                                            const std::vector<std::size_t>& effects,
                                            const std::vector<double>& values,
                                            const StraightOrders* like);
  Eigen::VectorXcd features_at(const std::vector<double>& values) const;
  std::optional<Eigen::VectorXcd> with_more(const std::vector<std::size_t>& effects,
                                            const std::vector<double>& values) const;

  StraightOrders(const OrderTwin& twin, std::vector<std::size_t> effects,
                 std::vector<double> values)
      : twin_(twin), effects_(std::move(effects)), values_(std::move(values)) {}

  const OrderTwin& twin_;
  std::vector<std::size_t> effects_;
  std::vector<double> values_;
  Eigen::VectorXcd features_;
  Eigen::VectorXcd of_base_;  ///< features there without the effects
  Eigen::MatrixXcd slopes_;   ///< one column for each value
};

}  // namespace rvbench::bench
