#include "sim/decimator.hpp"

#include <cmath>
#include <numbers>

namespace rvbench::sim {

Decimator::Decimator(Eigen::Index channels)
    : taps_(length), history_(Eigen::MatrixXd::Zero(channels, 2 * length)) {
  constexpr double pi = std::numbers::pi;
  for (Eigen::Index i = 0; i < length; ++i) {
    const double k = static_cast<double>(i - half);
    const double sinc = i == half ? 0.5 : std::sin(pi * k / 2) / (pi * k);
    const double blackman =
        0.42 + 0.5 * std::cos(pi * k / (half + 1)) + 0.08 * std::cos(2 * pi * k / (half + 1));
    taps_[i] = sinc * blackman;
  }
  taps_ /= taps_.sum();
}

void Decimator::step(const Eigen::Ref<const Eigen::VectorXd>& first,
                     const Eigen::Ref<const Eigen::VectorXd>& second,
                     Eigen::Ref<Eigen::VectorXf> out) {
  for (const auto* scan : {&first, &second}) {
    history_.col(at_) = *scan;
    history_.col(at_ + length) = *scan;
    at_ = (at_ + 1) % length;
  }
  out = (history_.middleCols(at_, length) * taps_).cast<float>();
}

}  // namespace rvbench::sim
