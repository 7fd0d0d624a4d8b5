#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double mains_Hz = 50;
constexpr double third = 0.1;  // harmonic

// A cable beside the transducer's.
class Hum final : public BenchEffect {
 public:
  Hum(double size_Nm, double phase_rad) : size_Nm_(size_Nm), phase_rad_(phase_rad) {}
  double shown_torque_Nm(double time_s, double torque_Nm) override {
    const double at = turn * mains_Hz * time_s + phase_rad_;
    return torque_Nm + size_Nm_ * (std::cos(at) + third * std::cos(3 * at));
  }

 private:
  double size_Nm_, phase_rad_;
};

}  // namespace

HiddenInBench mains_hum(const BenchNumbers&, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {.name = "mains_hum",
          .also = {"external_force", "speed_modulation"},
          .bodies = {},
          .parameter = "amplitude",
          .size = 1e-3,
          .line_Hz = [](double, double) { return mains_Hz; },
          .make = [=](double size_Nm) { return std::make_unique<Hum>(size_Nm, phase_rad); }};
}

}  // namespace seal
