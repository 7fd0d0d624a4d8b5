#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double third = 0.05;  // harmonic

// A neighbouring machine that runs at twice the mains' frequency.
class Shaker final : public BenchEffect {
 public:
  Shaker(int body, double size_Nm, double frequency_Hz, double phase_rad)
      : body_(body), size_Nm_(size_Nm), frequency_Hz_(frequency_Hz), phase_rad_(phase_rad) {}
  void push(const Moment& now, double, Eigen::VectorXd& torque_Nm) override {
    const double at = turn * frequency_Hz_ * now.time_s + phase_rad_;
    torque_Nm[body_] += size_Nm_ * (std::cos(at) + third * std::cos(3 * at));
  }

 private:
  int body_;
  double size_Nm_, frequency_Hz_, phase_rad_;
};

}  // namespace

HiddenInBench external_force(const BenchNumbers&, Draw& draw) {
  const bool on_motor = draw.below(2) == 0;
  const double phase_rad = draw.phase_rad();
  return {.name = "external_force",
          .also = {"mains_hum", "speed_modulation"},
          .bodies = {on_motor ? "motor" : "input_shaft"},
          .anywhere = true,
          .parameter = "amplitude",
          .size = 0.01,
          .line_Hz = [](double, double) { return 100.0; },
          .make =
              [=](double size_Nm) {
                return std::make_unique<Shaker>(on_motor ? motor : sun, size_Nm, 100, phase_rad);
              }};
}

}  // namespace seal
