#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double tip = 0.1;  // of the fan's inertia
constexpr double pole_pairs = 2;

// A fan on the motor's shaft that swings against it.
class Fan final : public BenchEffect {
 public:
  Fan(double share, double inertia, double frequency_Hz, double damping_ratio)
      : share_(share),
        inertia_(inertia),
        frequency_Hz_(frequency_Hz),
        damping_ratio_(damping_ratio) {}
  void join(Structure& train) override {
    const double moved = share_ * inertia_, rate = turn * frequency_Hz_;
    train.inertia[motor] -= moved;
    // Two discs in a row, the second small: its mode lies far above the first.
    const int disc = train.add_body(moved * (1 - tip)), end = train.add_body(moved * tip);
    const double stiffness = rate * rate * moved, damping = 2 * damping_ratio_ * rate * moved;
    train.add_spring(motor, disc, stiffness, damping);
    train.add_spring(disc, end, stiffness, damping);
  }

 private:
  double share_, inertia_, frequency_Hz_, damping_ratio_;
};

}  // namespace

HiddenInBench torsional_mode(const BenchNumbers& n, Draw& draw) {
  // Near the ripple of the inverter, which pushes the motor, at the first or at the second speed:
  // away from it a mode is no more than another inertia.
  const double met_rpm = draw.uniform(0, 1) < 0.5 ? 605 : 1210;
  const double frequency_Hz = 6 * pole_pairs * met_rpm / 60 * draw.uniform(0.95, 1.03);
  const double damping_ratio = draw.uniform(0.02, 0.06);
  return {.name = "torsional_mode",
          .also = {"series_compliance"},
          .bodies = {"motor"},
          .needs = {"ripple"},
          .parameter = "inertia_share",
          .size = 0.1,
          .most = 0.5,
          .in_own_lines = true,
          .make = [=](double share) {
            return std::make_unique<Fan>(share, n.motor_inertia, frequency_Hz, damping_ratio);
          }};
}

}  // namespace seal
