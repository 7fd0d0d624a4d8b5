#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double mains_Hz = 100;

// An intermediate circuit that is charged twice in each period of the mains.
class Supply final : public BenchEffect {
 public:
  Supply(double depth, double phase_rad) : depth_(depth), phase_rad_(phase_rad) {}
  double supply_Hz(double time_s, double asked_Hz) override {
    return asked_Hz * (1 + depth_ * std::cos(turn * mains_Hz * time_s + phase_rad_));
  }

 private:
  double depth_, phase_rad_;
};

}  // namespace

HiddenInBench speed_modulation(const BenchNumbers&, Draw& draw) {
  const double phase_rad = draw.phase_rad();
  return {.name = "speed_modulation",
          .also = {"external_force", "mains_hum"},
          .bodies = {"motor"},
          .parameter = "depth",
          .size = 1e-3,
          .line_Hz = [](double, double) { return mains_Hz; },
          .make = [=](double depth) { return std::make_unique<Supply>(depth, phase_rad); }};
}

}  // namespace seal
