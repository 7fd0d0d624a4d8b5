#include "bench/straight_orders.hpp"

#include <algorithm>

#include "analysis/explain/fit_problem.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::bench {
namespace {

constexpr double difference_step = 1e-2;  // of a parameter's scale

}  // namespace

std::unique_ptr<StraightOrders> StraightOrders::make(const OrderTwin& twin,
                                                     const std::vector<std::size_t>& effects,
                                                     const std::vector<double>& values,
                                                     const StraightOrders* like) {
  auto here = twin.features(effects, values);
  if (!here) return nullptr;
  std::unique_ptr<StraightOrders> made(new StraightOrders(twin, effects, values));
  made->features_ = *std::move(here);
  made->slopes_.resize(made->features_.size(), static_cast<Eigen::Index>(values.size()));
  const auto parameters = analysis::parameters_of(twin, effects);
  std::size_t known = 0;
  if (like != nullptr && like->effects_.size() <= effects.size() &&
      std::ranges::equal(like->effects_.begin(), like->effects_.end(), effects.begin(),
                         effects.begin() + std::ptrdiff_t(like->effects_.size()))) {
    known = like->values_.size();
    made->slopes_.leftCols(like->slopes_.cols()) = like->slopes_;
  }
  std::vector<char> found(values.size() - known, 0);
  parallel_for(found.size(), [&](std::size_t column) {
    const std::size_t i = known + column;
    double step = difference_step * parameters[i].scale;
    if (values[i] + step > parameters[i].high) step = -step;
    std::vector<double> moved = values;
    moved[i] += step;
    const auto there = twin.features(effects, moved);
    if (!there) return;
    made->slopes_.col(static_cast<Eigen::Index>(i)) = (*there - made->features_) / step;
    found[column] = 1;
  });
  if (std::ranges::find(found, 0) != found.end()) return nullptr;
  return made;
}

std::optional<Eigen::VectorXd> StraightOrders::residuals(const std::vector<std::size_t>& effects,
                                                         const std::vector<double>& values,
                                                         const std::vector<bool>& trained) const {
  if (effects != effects_) return twin_.residuals(effects, values, trained);
  return twin_.residuals_of(features_at(values));
}

std::optional<Eigen::MatrixXd> StraightOrders::slopes(const std::vector<std::size_t>& effects,
                                                      const std::vector<double>& values,
                                                      const std::vector<bool>& trained) const {
  if (effects != effects_) return twin_.slopes(effects, values, trained);
  return twin_.slopes_of(features_at(values), slopes_);
}

Eigen::VectorXcd StraightOrders::features_at(const std::vector<double>& values) const {
  const auto n = static_cast<Eigen::Index>(values.size());
  const Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(values.data(), n) -
                                Eigen::Map<const Eigen::VectorXd>(values_.data(), n);
  return features_ + slopes_ * moved;
}

}  // namespace rvbench::bench
