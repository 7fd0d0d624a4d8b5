#include "tests/proof/seal/bench_lines.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <complex>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

namespace seal {
namespace {

using std::complex;

constexpr int highest_order = 121 * 15;  // below half the rate at the highest speed
constexpr int turns_per_period = 121;
constexpr int periods = 2;
constexpr int samples_per_turn = 40;
constexpr double gain_tolerance = 0.03, drag_tolerance = 0.2;

double mean_of_turns(const BenchRecord& record) {
  const Eigen::Index last = record.angle_rad.size() - 1;
  const double whole =
      std::floor((record.angle_rad[last] - record.angle_rad[0]) / turn / turns_per_period) * turn *
      turns_per_period;
  Eigen::Index end = last;
  while (record.angle_rad[end] > record.angle_rad[0] + whole) --end;
  return record.torque_Nm.head(end).mean();
}

double shaft_Hz(const BenchRecord& record) {
  const Eigen::Index last = record.angle_rad.size() - 1;
  return (record.angle_rad[last] - record.angle_rad[0]) / turn / static_cast<double>(last) *
         bench_rate_Hz;
}

// A parabola through the three samples beside it.
double at(const Eigen::VectorXd& x, double place) {
  const auto i = std::clamp<Eigen::Index>(std::lround(place), 1, x.size() - 2);
  const double t = place - static_cast<double>(i);
  return x[i] + t / 2 * (x[i + 1] - x[i - 1]) + t * t / 2 * (x[i + 1] - 2 * x[i] + x[i - 1]);
}

}  // namespace

Eigen::VectorXcd orders_of(const BenchRecord& record, int highest) {
  constexpr int count = turns_per_period * periods * samples_per_turn;
  const Eigen::VectorXd& angle = record.angle_rad;
  Eigen::VectorXd even(count);
  Eigen::Index i = 0;
  const double first_rad = std::ceil(angle[2] / turn) * turn;
  for (int k = 0; k < count; ++k) {
    const double wanted = first_rad + turn * k / samples_per_turn;
    while (i + 2 < angle.size() && angle[i + 1] < wanted) ++i;
    if (i + 2 >= angle.size()) throw std::runtime_error("the machine turns too slowly");
    const double place = static_cast<double>(i) + (wanted - angle[i]) / (angle[i + 1] - angle[i]);
    even[k] = at(record.torque_Nm, place);
  }
  for (int k = 0; k < count; ++k) even[k] *= 1 - std::cos(turn * (k + 0.5) / count);
  Eigen::VectorXcd spectrum;
  Eigen::FFT<double>().fwd(spectrum, even);
  const double start_rad = std::fmod(first_rad, turn * turns_per_period);
  return Eigen::VectorXcd::NullaryExpr(highest + 1, [&](Eigen::Index order) {
    const double phase = -static_cast<double>(order) / turns_per_period * start_rad;
    return 2.0 / count * spectrum[periods * order] * std::polar(1.0, phase);
  });
}

complex<double> line_of(const BenchRecord& record, double frequency_Hz) {
  const auto count = static_cast<double>(record.torque_Nm.size());
  complex<double> sum = 0;
  for (Eigen::Index i = 0; i < record.torque_Nm.size(); ++i) {
    const auto k = static_cast<double>(i);
    sum += (1 - std::cos(turn * (k + 0.5) / count)) * record.torque_Nm[i] *
           std::polar(1.0, -turn * frequency_Hz * k / bench_rate_Hz);
  }
  return 2.0 / count * sum;
}

BenchSight::BenchSight(const BenchNumbers& numbers, double output_turns)
    : numbers_(numbers), output_turns_(output_turns), without_(run(nullptr, 0)) {
  for (const BenchRecord& record : without_) lines_.push_back(orders_of(record, highest_order));
}

std::vector<BenchRecord> BenchSight::run(const HiddenInBench* effect, double size) const {
  Nuisance none;
  none.noise_Nm = none.friction_scatter = 0;
  return run_bench(numbers_, bench_matrix(1), periods + 0.2, none, 1, [&] {
    std::vector<std::unique_ptr<BenchEffect>> acting;
    if (effect != nullptr) acting.push_back(effect->make(size));
    return acting;
  });
}

Visibility BenchSight::of(const HiddenInBench& effect, double size) const {
  const auto with = run(&effect, size);
  return effect.in_means ? in_means(with) : in_lines(effect, with);
}

Visibility BenchSight::in_lines(const HiddenInBench& effect,
                                const std::vector<BenchRecord>& with) const {
  Visibility seen;
  const int mesh = static_cast<int>(numbers_.sun_teeth) * (turns_per_period - 1);
  for (std::size_t i = 0; i < with.size(); ++i) {
    const double speed_rpm = with[i].point.speed_rpm;
    const double length_s = record_length_s(speed_rpm, output_turns_);
    Visibility::Line& line = seen.under.emplace_back();
    line.length_s = length_s;
    const auto see = [&](double line_Nm, double line_Hz) {
      if (line_Nm <= line.amplitude_Nm) return;
      line.amplitude_Nm = line_Nm;
      line.frequency_Hz = line_Hz;
      seen.line_Nm = std::max(seen.line_Nm, line_Nm);
    };
    const Eigen::VectorXcd& before = lines_[i];
    seen.strongest_Nm = std::max(seen.strongest_Nm, std::abs(before[mesh]));
    const double turns_Hz = shaft_Hz(with[i]);
    if (effect.line_Hz) {
      const double line_Hz = effect.line_Hz(speed_rpm / 60 * 2, turns_Hz);
      if (line_Hz > 1 / length_s) {
        see(std::abs(line_of(with[i], line_Hz) - line_of(without_[i], line_Hz)), line_Hz);
      }
      continue;
    }
    const Eigen::VectorXcd after = orders_of(with[i], highest_order);
    for (int k = 1; k <= highest_order; ++k) {
      see(std::abs(after[k] - before[k]), k * turns_Hz / turns_per_period);
    }
  }
  return seen;
}

// What gain, friction and drags may take of it within what is known of them.
Visibility BenchSight::in_means(const std::vector<BenchRecord>& with) const {
  const auto count = static_cast<Eigen::Index>(with.size());
  Eigen::VectorXd change(count);
  Eigen::MatrixXd known(count, 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    const BenchRecord& before = without_[std::size_t(i)];
    const double mean_Nm = mean_of_turns(before), sun_rad_s = turn * shaft_Hz(before);
    change[i] = mean_of_turns(with[std::size_t(i)]) - mean_Nm;
    known.row(i) << gain_tolerance * mean_Nm, drag_tolerance * numbers_.sun_friction_Nm,
        drag_tolerance * numbers_.sun_drag * sun_rad_s,
        drag_tolerance * numbers_.brake_drag * sun_rad_s / numbers_.ratio() / numbers_.ratio();
  }
  const double scatter_Nm = Nuisance().friction_scatter * numbers_.sun_friction_Nm;
  const Eigen::MatrixXd j = known / std::sqrt(3.0) / scatter_Nm;  // evenly within: √3 deviations
  const Eigen::MatrixXd information = j.transpose() * j + Eigen::MatrixXd::Identity(4, 4);
  const Eigen::VectorXd left =
      change - j * scatter_Nm * information.ldlt().solve(j.transpose() * change / scatter_Nm);
  Visibility seen;
  seen.line_Nm = std::sqrt(left.squaredNorm() / static_cast<double>(count));
  seen.strongest_Nm = 0;
  return seen;
}

}  // namespace seal
