#include "sim/robot/hammer_test.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "hal/types/parallel_for.hpp"
#include "hal/types/units.hpp"
#include "sim/real_transform.hpp"
#include "sim/robot/white_noise.hpp"

namespace rvbench::sim {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

constexpr Index components = 6;  // of what a hit brings to a point: force and moment

// The line on which spectra are taken, and the way back from it.
class LaplaceLine {
 public:
  explicit LaplaceLine(const RobotOptions& options)
      : rate_Hz_(options.rate_Hz),
        record_(static_cast<Index>(std::lround(options.hit_s * options.rate_Hz))),
        period_(2 * ((3 * record_ + 3) / 4)),
        decay_per_s_(14 * rate_Hz_ / static_cast<double>(period_)),
        s_per_s_(period_ / 2 + 1),
        low_pass_(period_ / 2 + 1) {
    for (Index k = 0; k < s_per_s_.size(); ++k) {
      const double of_nyquist = 2 * static_cast<double>(k) / static_cast<double>(period_);
      const double slope = std::clamp((of_nyquist - 0.7) / 0.3, 0.0, 1.0);
      s_per_s_[k] = {decay_per_s_, of_nyquist * std::numbers::pi * rate_Hz_};
      low_pass_[k] = std::pow(std::cos(0.5 * std::numbers::pi * slope), 2);
    }
  }

  const Eigen::VectorXcd& s_per_s() const { return s_per_s_; }

  /// The record of what has this Laplace transform, low-passed.
  Eigen::VectorXd samples(const Eigen::VectorXcd& transform) const {
    const Eigen::VectorXcd lines = transform.cwiseProduct(low_pass_) * rate_Hz_;
    Eigen::VectorXd period(period_);
    samples_from_lines(period.data(), lines.data(), period_);
    const Eigen::ArrayXd time_s =
        Eigen::ArrayXd::LinSpaced(record_, 0, static_cast<double>(record_ - 1) / rate_Hz_);
    return period.head(record_).array() * (decay_per_s_ * time_s).exp();
  }

 private:
  double rate_Hz_;
  Index record_, period_;
  double decay_per_s_;  // e^-14 over the period: 1e-6
  Eigen::VectorXcd s_per_s_;
  Eigen::VectorXd low_pass_;
};

// ∫ f·e^{-st} dt of half a sine from start_s on, b = π/width: peak·b·(1 + e^{-s·width})/(s² + b²).
Eigen::VectorXcd pulse_transform(const HitPlan& hit, const Eigen::VectorXcd& s_per_s) {
  const double b = std::numbers::pi / hit.width_s;
  const auto s = s_per_s.array();
  const Eigen::ArrayXcd once =
      hit.peak_N * b * (1 + (-hit.width_s * s).exp()) / (s.square() + b * b);
  return once * (-hit.start_s * s).exp() * (1 + hit.second_share * (-hit.second_after_s * s).exp());
}

// Accelerance along the line for the six components at a point: lines x (sensors·6).
Eigen::MatrixXcd point_accelerance(const VirtualRobot& robot, Index point,
                                   const Eigen::MatrixXcd& gains) {
  Eigen::MatrixXd at_point(components, gains.cols());
  at_point << robot.at_paths().middleRows<3>(3 * point),
      robot.at_path_moments().middleRows<3>(3 * point);
  Eigen::MatrixXd products(VirtualRobot::sensors * components, gains.cols());
  for (Index sensor = 0; sensor < VirtualRobot::sensors; ++sensor) {
    products.middleRows<components>(components * sensor) =
        at_point * robot.at_sensors().row(sensor).asDiagonal();
  }
  return gains * products.transpose();
}

// What a converter makes of it: noise of the sensor, then the end of the range.
Channel measured(const DegreeOfFreedom& place, const char* unit, Eigen::VectorXd samples,
                 const HitPlan& hit, double range, std::uint64_t noise_seed,
                 const RobotOptions& options) {
  const double rms = std::sqrt(samples.squaredNorm() / static_cast<double>(samples.size()));
  add_white_noise(samples, options.hit_noise * rms * nominal_peak_N / hit.peak_N, noise_seed);
  samples = samples.cwiseMax(-range).cwiseMin(range);
  return {{place.point, unit, place.direction}, options.rate_Hz, 0, std::move(samples)};
}

Recording record(const VirtualRobot& robot, const LaplaceLine& line, const HitPlan& hit,
                 const Eigen::MatrixXcd& accelerance) {
  const RobotOptions& options = robot.options();
  const Eigen::VectorXcd pulse_N_s = pulse_transform(hit, line.s_per_s());
  Eigen::VectorXcd push(components);
  push << hit.direction.cast<Complex>(), hit.arm_m.cross(hit.direction).cast<Complex>();
  Draw noise(hit.noise_seed);
  const DegreeOfFreedom& aim = robot.path_places()[static_cast<std::size_t>(hit.path)];
  Recording recording;
  recording.source =
      "virtual robot, hit " + std::to_string(hit.number) + " on " + aim.point + " " + aim.direction;
  recording.repeat = hit.number;
  recording.status = "ok";
  recording.channels.push_back(measured(aim, "N", hit.told_share * line.samples(pulse_N_s), hit,
                                        options.force_range_N, noise.seed(), options));
  for (Index sensor = 0; sensor < VirtualRobot::sensors; ++sensor) {
    const Eigen::VectorXcd transform =
        (accelerance.middleCols<components>(components * sensor) * push).cwiseProduct(pulse_N_s);
    recording.channels.push_back(measured(robot.sensor_places()[static_cast<std::size_t>(sensor)],
                                          "m/s²", line.samples(transform), hit,
                                          options.acceleration_range_m_s2, noise.seed(), options));
  }
  return recording;
}

}  // namespace

HammerTest hammer_test(const VirtualRobot& robot) {
  const LaplaceLine line(robot.options());
  const Eigen::MatrixXcd gains = modal_accelerance(robot.modes(), line.s_per_s());
  HammerTest test;
  test.truth = plan_hits(robot.options());
  test.hits.resize(test.truth.size());
  const std::size_t at_point = test.truth.size() / robot_joints;
  const auto one = [&](std::size_t point) {
    const Eigen::MatrixXcd accelerance = point_accelerance(robot, static_cast<Index>(point), gains);
    for (std::size_t i = point * at_point; i < (point + 1) * at_point; ++i) {
      test.hits[i] = record(robot, line, test.truth[i], accelerance);
    }
  };
  parallel_for(robot_joints, one, robot.options().threads);
  return test;
}

}  // namespace rvbench::sim
