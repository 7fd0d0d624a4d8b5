#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double order = 0.3917;  // of a cage on the shaft
constexpr double slip_rms = 0.002;
constexpr double slip_lasts_s = 0.5;

// A bearing's cage that drags a seal along and slips at random. rvbench has no term for it.
class Cage final : public BenchEffect {
 public:
  Cage(double size_Nm, std::uint64_t seed) : size_Nm_(size_Nm), draw_(seed) {}
  void push(const Moment& now, double step_s, Eigen::VectorXd& torque_Nm) override {
    const double faded = step_s / slip_lasts_s;
    slip_ += -faded * slip_ + std::sqrt(2 * faded) * slip_rms * draw_.normal();
    angle_rad_ = std::fmod(angle_rad_ + order * (1 + slip_) * now.v[sun] * step_s, turn);
    torque_Nm[sun] += size_Nm_ * std::cos(angle_rad_);
  }

 private:
  double size_Nm_;
  Draw draw_;
  double slip_ = 0, angle_rad_ = 0;
};

}  // namespace

HiddenInBench cage_slip(const BenchNumbers&, Draw& draw) {
  const std::uint64_t seed = draw.seed();
  return {.name = "cage_slip",
          .bodies = {"input_shaft"},
          .anywhere = true,
          .size = 0.01,
          .line_Hz = [](double, double shaft_Hz) { return order * shaft_Hz; },
          .make = [=](double size_Nm) { return std::make_unique<Cage>(size_Nm, seed); }};
}

}  // namespace seal
