#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {
namespace {

constexpr double rated_Nm = 167;
constexpr double palmgren = 1.1;  // power of the load, of roller bearings
constexpr double creep_rad_s = 1;

// Bearings whose friction grows with what they carry.
class Seals final : public BenchEffect {
 public:
  Seals(double coefficient, double ratio) : coefficient_(coefficient), ratio_(ratio) {}
  void push(const Moment& now, double, Eigen::VectorXd& torque_Nm) override {
    const double load_Nm = rated_Nm * std::pow(now.brake_Nm / rated_Nm, palmgren) / ratio_;
    torque_Nm[sun] -= coefficient_ * load_Nm * std::tanh(now.v[sun] / creep_rad_s);
  }

 private:
  double coefficient_, ratio_;
};

}  // namespace

HiddenInBench load_friction(const BenchNumbers& n, Draw&) {
  return {.name = "load_friction",
          .also = {"backlash"},
          .bodies = {},
          .anywhere = true,
          .parameter = "coefficient",
          .size = 0.05,
          .most = 0.25,
          .in_means = true,
          .make = [=](double size) { return std::make_unique<Seals>(size, n.ratio()); }};
}

}  // namespace seal
