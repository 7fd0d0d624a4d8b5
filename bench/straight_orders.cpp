#include "bench/straight_orders.hpp"

#include <algorithm>

#include "analysis/explain/fit.hpp"
#include "analysis/explain/fit_problem.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::bench {
namespace {

constexpr double difference_step = 1e-2;  // of a parameter's scale

bool begins_with(const std::vector<std::size_t>& all, const std::vector<std::size_t>& first) {
  return first.size() <= all.size() && std::equal(first.begin(), first.end(), all.begin());
}

std::vector<double> first_of(const std::vector<double>& values, std::size_t count) {
  return {values.begin(), values.begin() + std::ptrdiff_t(count)};
}

}  // namespace

std::unique_ptr<StraightOrders> StraightOrders::make(const OrderTwin& twin,
                                                     const std::vector<std::size_t>& effects,
                                                     const std::vector<double>& values,
                                                     const StraightOrders* like) {
  return of([&](const auto& with, const auto& at) { return twin.features(with, at); }, twin,
            effects, values, like);
}

std::unique_ptr<analysis::ForwardModel> StraightOrders::straightened(
    const std::vector<std::size_t>& effects, const std::vector<double>& values,
    const ForwardModel* like) const {
  if (effects == effects_ || !begins_with(effects, effects_)) return nullptr;
  return of([&](const auto& with, const auto& at) { return with_more(with, at); }, twin_, effects,
            values, like != nullptr ? dynamic_cast<const StraightOrders*>(like) : this);
}

std::unique_ptr<StraightOrders> StraightOrders::of(const Features& features, const OrderTwin& twin,
                                                   const std::vector<std::size_t>& effects,
                                                   const std::vector<double>& values,
                                                   const StraightOrders* like) {
  auto here = features(effects, values);
  if (!here) return nullptr;
  std::unique_ptr<StraightOrders> made(new StraightOrders(twin, effects, values));
  made->features_ = *std::move(here);
  auto of_base =
      effects.empty() ? made->features_ : twin.features({}, first_of(values, twin.base().size()));
  if (!of_base) return nullptr;
  made->of_base_ = *std::move(of_base);
  made->slopes_.resize(made->features_.size(), static_cast<Eigen::Index>(values.size()));
  const auto parameters = analysis::parameters_of(twin, effects);
  std::size_t known = 0;
  if (like != nullptr && begins_with(effects, like->effects_)) {
    known = like->values_.size();
    // The newest effect is the one that bends.
    if (like->effects_ == effects && !effects.empty()) {
      known = analysis::first_value_of(twin, effects, effects.size() - 1);
    }
    made->slopes_.leftCols(Eigen::Index(known)) = like->slopes_.leftCols(Eigen::Index(known));
  }
  std::vector<char> found(values.size() - known, 0);
  parallel_for(found.size(), [&](std::size_t column) {
    const std::size_t i = known + column;
    double step = difference_step * parameters[i].scale;
    if (values[i] + step > parameters[i].high) step = -step;
    std::vector<double> moved = values;
    moved[i] += step;
    const auto there = features(effects, moved);
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
  if (effects == effects_) return twin_.residuals_of(features_at(values));
  if (!begins_with(effects, effects_)) return twin_.residuals(effects, values, trained);
  const auto all = with_more(effects, values);
  if (!all) return std::nullopt;
  return twin_.residuals_of(*all);
}

std::optional<Eigen::MatrixXd> StraightOrders::slopes(const std::vector<std::size_t>& effects,
                                                      const std::vector<double>& values,
                                                      const std::vector<bool>& trained) const {
  if (effects != effects_) return twin_.slopes(effects, values, trained);
  return twin_.slopes_of(features_at(values), slopes_);
}

std::optional<Eigen::VectorXcd> StraightOrders::with_more(const std::vector<std::size_t>& effects,
                                                          const std::vector<double>& values) const {
  const auto own = std::ptrdiff_t(effects_.size());
  const std::vector<std::size_t> others(effects.begin() + own, effects.end());
  std::vector<double> of_others = first_of(values_, twin_.base().size());
  of_others.insert(of_others.end(), values.begin() + std::ptrdiff_t(values_.size()), values.end());
  auto all = twin_.features(others, of_others);
  if (all) *all += features_at(first_of(values, values_.size())) - of_base_;
  return all;
}

Eigen::VectorXcd StraightOrders::features_at(const std::vector<double>& values) const {
  const auto n = static_cast<Eigen::Index>(values.size());
  const Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(values.data(), n) -
                                Eigen::Map<const Eigen::VectorXd>(values_.data(), n);
  return features_ + slopes_ * moved;
}

}  // namespace rvbench::bench
