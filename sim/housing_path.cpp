#include "sim/housing_path.hpp"

#include <stdexcept>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sim {

HousingPath::HousingPath(const std::vector<HousingMode>& modes, double rate_Hz) {
  if (modes.empty()) throw std::invalid_argument("HousingPath: needs at least one mode");
  const auto n = static_cast<Eigen::Index>(modes.size());
  shape_ports_.resize(n, modes[0].at_ports.size());
  shape_sensors_.resize(modes[0].at_sensors.size(), n);
  for (Eigen::ArrayXd* a :
       {&spring_, &damper_, &a11_, &a12_, &a21_, &a22_, &b1_, &b2_, &eta_, &rate_, &next_}) {
    *a = Eigen::ArrayXd::Zero(n);
  }

  for (Eigen::Index m = 0; m < n; ++m) {
    const HousingMode& mode = modes[static_cast<std::size_t>(m)];
    if (!(mode.frequency_Hz > 0 && mode.frequency_Hz < rate_Hz / 2 && mode.damping_ratio > 0)) {
      throw std::invalid_argument("HousingPath: modes must be damped and within (0, rate/2)");
    }
    if (mode.at_ports.size() != shape_ports_.cols() ||
        mode.at_sensors.size() != shape_sensors_.rows()) {
      throw std::invalid_argument("HousingPath: mode shapes differ in size");
    }
    shape_ports_.row(m) = mode.at_ports.transpose();
    shape_sensors_.col(m) = mode.at_sensors;
    const double omega = units::two_pi * mode.frequency_Hz;
    spring_[m] = omega * omega;
    damper_[m] = 2 * mode.damping_ratio * omega;

    Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
    block.topRows<2>() << 0, 1, 0, -spring_[m], -damper_[m], 1;
    const Eigen::MatrixXd step = algebra::exponential(block / rate_Hz);
    a11_[m] = step(0, 0);
    a12_[m] = step(0, 1);
    a21_[m] = step(1, 0);
    a22_[m] = step(1, 1);
    b1_[m] = step(0, 2);
    b2_[m] = step(1, 2);
  }
  drive_ = Eigen::VectorXd::Zero(n);
  answer_ = Eigen::VectorXd::Zero(n);
}

void HousingPath::step(const Eigen::Ref<const Eigen::VectorXd>& forces_N,
                       Eigen::Ref<Eigen::VectorXd> accelerations_m_s2) {
  drive_.noalias() = shape_ports_ * forces_N;
  answer_ = (drive_.array() - damper_ * rate_ - spring_ * eta_).matrix();
  accelerations_m_s2.noalias() = shape_sensors_ * answer_;
  next_ = a11_ * eta_ + a12_ * rate_ + b1_ * drive_.array();
  rate_ = a21_ * eta_ + a22_ * rate_ + b2_ * drive_.array();
  eta_.swap(next_);
}

}  // namespace rvbench::sim
