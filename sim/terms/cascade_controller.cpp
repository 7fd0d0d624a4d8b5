#include "sim/terms/cascade_controller.hpp"

#include <algorithm>
#include <cmath>

#include "sim/term_memory.hpp"

namespace rvbench::sim {
namespace {

class CascadeController final : public OneAxisTerm, public TermMemory {
 public:
  explicit CascadeController(const TermSite& at)
      : OneAxisTerm("cascade_controller", at.axis),
        set_point_(at.input),
        position_gain_(at["position_gain"]),
        speed_gain_(at["speed_gain"]),
        integral_time_s_(at["integral_time"]),
        limit_(at["limit"]) {}

  double effort(const PlantState& s) const override {
    return -std::clamp(wanted(s), -limit_, limit_);
  }
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return speed_gain_ * mobility(inertia) + position_gain_;
  }

  Eigen::Index size() const override { return 1; }
  void place(Eigen::Index first) override { place_ = first; }
  void add_rates(const PlantState& s, Eigen::Ref<Eigen::VectorXd> rates) const override {
    const double e = error(s);
    if (std::abs(wanted(s)) < limit_ || e * wanted(s) < 0) rates[place_] += e;
  }

 private:
  double error(const PlantState& s) const {
    return position_gain_ * (s.u[set_point_] - way(s)) - speed(s);
  }
  double wanted(const PlantState& s) const {
    return speed_gain_ * (error(s) + s.z[place_] / integral_time_s_);
  }

  int set_point_;
  double position_gain_, speed_gain_, integral_time_s_, limit_;
  Eigen::Index place_ = 0;
};

}  // namespace

TermType cascade_controller() {
  return {.card = {.name = "cascade_controller",
                   .effect = false,
                   .equation = "e = K_p·(r − q) − v, F = −clamp(K_v·(e + ∫e dt/T_i), ±limit)",
                   .sign = "positive gains drive q to the set-point r",
                   .leaves_out = "sampling, the current loop, feed-forward",
                   .source = "Åström & Hägglund, Advanced PID Control, ch. 3.5 and 12"},
          .parameters = {{.name = "position_gain",
                          .unit = UnitKind::frequency,
                          .min = 0,
                          .max = unbounded,
                          .start = 1},
                         {.name = "speed_gain",
                          .unit = UnitKind::damping,
                          .min = 0,
                          .max = unbounded,
                          .start = 1},
                         {.name = "integral_time",
                          .unit = UnitKind::time,
                          .min = smallest,
                          .max = unbounded,
                          .start = 1,
                          .fallback = 1e9},
                         {.name = "limit",
                          .unit = UnitKind::force,
                          .min = 0,
                          .max = unbounded,
                          .start = 1,
                          .fallback = 1e12,
                          .fitted = false}},
          .gate = {.reference = ReferenceKind::input, .reference_key = "set_point"},
          .make = [](const TermSite& at) { return std::make_unique<CascadeController>(at); }};
}

}  // namespace rvbench::sim
