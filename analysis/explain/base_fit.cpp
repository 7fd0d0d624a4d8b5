#include "analysis/explain/base_fit.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "analysis/explain/pressed.hpp"

namespace rvbench::analysis {
namespace {

// A model whose residuals are as large as they are.
class Unpressed final : public ForwardModel {
 public:
  explicit Unpressed(const ForwardModel& model) : model_(model) {}

  const std::vector<ObservedUnit>& units() const override { return model_.units(); }
  const std::vector<ModelParameter>& base() const override { return model_.base(); }
  const std::vector<Candidate>& library() const override { return model_.library(); }
  bool counts_standard_errors() const override { return model_.counts_standard_errors(); }
  double least_mean_square() const override { return model_.least_mean_square(); }
  bool is_quick() const override { return model_.is_quick(); }

  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>& trained) const override {
    auto residuals = model_.residuals(effects, values, trained);
    if (!residuals) return residuals;
    const double believable = model_.believable();
    return residuals->unaryExpr([&](double r) { return unpressed(r, believable); });
  }

 private:
  const ForwardModel& model_;
};

// At these values, not yet at rest.
Fit fit_at(const ForwardModel& model, std::vector<double> values,
           const std::vector<bool>& everything) {
  Fit fit;
  fit.values = std::move(values);
  if (auto residuals = model.residuals({}, fit.values, everything)) {
    fit.residuals = *std::move(residuals);
  } else {
    fit.not_certified = "not at its nominal values";
  }
  return fit;
}

}  // namespace

Fit fit_base(const ForwardModel& model, const std::vector<bool>& everything) {
  std::vector<double> nominal;
  for (const ModelParameter& p : model.base()) nominal.push_back(p.nominal);
  const Fit at_nominal = fit_at(model, nominal, everything);
  if (at_nominal.residuals.size() == 0) return at_nominal;
  Fit fit = polish(model, at_nominal, everything);
  if (!std::isfinite(model.believable())) return fit;
  const Unpressed all(model);
  const Fit begun = polish(all, fit_at(all, nominal, everything), everything);
  const Fit other = fit_at(model, begun.values, everything);
  if (other.residuals.size() == 0) return fit;
  Fit from_there = polish(model, other, everything);
  return from_there.cost < fit.cost ? from_there : fit;
}

}  // namespace rvbench::analysis
