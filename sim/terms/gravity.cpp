#include "sim/terms/gravity.hpp"

#include <cmath>

namespace rvbench::sim {
namespace {

class Gravity final : public OneAxisTerm {
 public:
  explicit Gravity(const TermSite& at)
      : OneAxisTerm("gravity", at.axis), sine_(at["sine"]), cosine_(at["cosine"]) {}

  double effort(const PlantState& s) const override {
    return sine_ * std::sin(way(s)) + cosine_ * std::cos(way(s));
  }
  double stored_energy_J(const PlantState& s) const override {
    return cosine_ * std::sin(way(s)) - sine_ * std::cos(way(s));
  }
  void add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const override {
    add_order(turns[axis().body_a], orders);
  }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return std::sqrt(std::hypot(sine_, cosine_) * mobility(inertia));
  }

 private:
  double sine_, cosine_;
};

ParameterCard part(std::string name) {
  return {.name = std::move(name),
          .unit = UnitKind::force,
          .min = -unbounded,
          .max = unbounded,
          .start = 0.3,
          .fallback = 0};
}

}  // namespace

TermType gravity() {
  return {.card = {.name = "gravity",
                   .effect = false,
                   .equation = "F = A·sin q + B·cos q",
                   .sign = "A > 0 pulls back to q = 0, B > 0 pushes towards −q there",
                   .leaves_out = "joints below it that tilt the axis",
                   .source = "Siciliano et al., Robotics, ch. 7.2"},
          .parameters = {part("sine"), part("cosine")},
          .gate = {.translation = false, .between_two = false},
          .make = [](const TermSite& at) { return std::make_unique<Gravity>(at); }};
}

}  // namespace rvbench::sim
