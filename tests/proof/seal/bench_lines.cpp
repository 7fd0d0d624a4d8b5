#include "tests/proof/seal/bench_lines.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <complex>
#include <functional>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

namespace seal {
namespace {

using std::complex;

constexpr int highest_order = 121 * 15;  // below half the rate at the highest speed
constexpr int turns_per_period = 121;
constexpr int periods = 2;
constexpr int samples_per_turn = 40;
constexpr int own_lines_per_record = 4;   // the motor's ripple and three of the meshes
constexpr double glance_turns = 0.3;      // of the output: enough for these
constexpr double seen_share = 0.42;       // of the rate
constexpr double lines_repeat_to = 0.01;  // from record to record
constexpr double least_of_strongest = 0.03;
constexpr double gain_tolerance = 0.03, drag_tolerance = 0.2;
constexpr double pole_pairs = 2;

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

// What is left of a change when numbers take of it what they can within what is known of them.
// @param moved  by a standard deviation of each number
// @param known_to  what else the values differ by
Eigen::VectorXd left_by_calibration(const Eigen::VectorXd& change, const Eigen::MatrixXd& moved,
                                    const Eigen::VectorXd& known_to) {
  const Eigen::MatrixXd j = known_to.cwiseInverse().asDiagonal() * moved;
  const Eigen::MatrixXd information =
      j.transpose() * j + Eigen::MatrixXd::Identity(j.cols(), j.cols());
  return change - moved * information.ldlt().solve(j.transpose() * change.cwiseQuotient(known_to));
}

// A parabola through the three samples beside it.
double at(const Eigen::VectorXd& x, double place) {
  const auto i = std::clamp<Eigen::Index>(std::lround(place), 1, x.size() - 2);
  const double t = place - static_cast<double>(i);
  return x[i] + t / 2 * (x[i + 1] - x[i - 1]) + t * t / 2 * (x[i + 1] - 2 * x[i] + x[i - 1]);
}

// Of a wave with this phase at each sample, under a Hann window.
complex<double> line_along(const BenchRecord& record,
                           const std::function<double(Eigen::Index)>& phase_rad) {
  const auto count = static_cast<double>(record.torque_Nm.size());
  complex<double> sum = 0;
  for (Eigen::Index i = 0; i < record.torque_Nm.size(); ++i) {
    sum += (1 - std::cos(turn * (static_cast<double>(i) + 0.5) / count)) * record.torque_Nm[i] *
           std::polar(1.0, -phase_rad(i));
  }
  return 2.0 / count * sum;
}

std::vector<BenchRecord> run(const BenchNumbers& numbers, double turns,
                             const HiddenInBench* effect = nullptr, double size = 0) {
  Nuisance none;
  none.noise_Nm = none.friction_scatter = 0;
  return run_bench(numbers, bench_matrix(1), turns, none, 1, [&] {
    std::vector<std::unique_ptr<BenchEffect>> acting;
    if (effect != nullptr) acting.push_back(effect->make(size));
    return acting;
  });
}

double supply_Hz(const BenchRecord& record) { return record.point.speed_rpm / 60 * pole_pairs; }

double mesh_order(double sun_teeth) {
  return sun_teeth * (turns_per_period - 1) / turns_per_period;
}

// Of the lines a machine has without any effect: of the motor's ripple first, then of the meshes.
double own_line_Hz(const BenchRecord& record, double sun_teeth, Eigen::Index line) {
  return line == 0 ? 6 * supply_Hz(record)
                   : static_cast<double>(line) * mesh_order(sun_teeth) * shaft_Hz(record);
}

// Amplitudes of these, of each record; 0 where they are not seen.
Eigen::VectorXd own_lines(const std::vector<BenchRecord>& records, double sun_teeth) {
  const auto count = static_cast<Eigen::Index>(records.size());
  Eigen::MatrixXd lines = Eigen::MatrixXd::Zero(own_lines_per_record, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const BenchRecord& record = records[std::size_t(i)];
    for (Eigen::Index line = 0; line < own_lines_per_record; ++line) {
      const double line_Hz = own_line_Hz(record, sun_teeth, line);
      if (line_Hz > seen_share * bench_rate_Hz) continue;
      const double order = static_cast<double>(line) * mesh_order(sun_teeth);
      const auto along_angle = [&](Eigen::Index k) { return order * record.angle_rad[k]; };
      lines(line, i) =
          std::abs(line == 0 ? line_of(record, line_Hz) : line_along(record, along_angle));
    }
  }
  return lines.reshaped();
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
  return line_along(record, [&](Eigen::Index k) {
    return turn * frequency_Hz * static_cast<double>(k) / bench_rate_Hz;
  });
}

BenchSight::BenchSight(nlohmann::json machine, double output_turns)
    : machine_(std::move(machine)),
      numbers_(numbers_of(machine_)),
      output_turns_(output_turns),
      without_(run(numbers_, periods + 0.2)) {
  for (const BenchRecord& record : without_) lines_.push_back(orders_of(record, highest_order));
}

Visibility BenchSight::of(const HiddenInBench& effect, double size) {
  const auto with = run(numbers_, periods + 0.2, &effect, size);
  if (effect.in_means) return in_means(with);
  return effect.in_own_lines ? in_own_lines(with) : in_lines(effect, with);
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
      const double line_Hz = effect.line_Hz(supply_Hz(with[i]), turns_Hz);
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
  // Drawn evenly within its tolerance, a number is off by 1/sqrt(3) of it.
  const Eigen::VectorXd left = left_by_calibration(change, known / std::sqrt(3.0),
                                                   Eigen::VectorXd::Constant(count, scatter_Nm));
  Visibility seen;
  seen.line_Nm = std::sqrt(left.squaredNorm() / static_cast<double>(count));
  seen.strongest_Nm = 0;
  return seen;
}

// What all numbers with a tolerance may take of it.
Visibility BenchSight::in_own_lines(const std::vector<BenchRecord>& with) {
  if (moved_Nm_.size() == 0) {
    const auto machines = each_off(machine_);
    const Eigen::VectorXd as_it_is = own_lines(run(numbers_, glance_turns), numbers_.sun_teeth);
    moved_Nm_.resize(as_it_is.size(), static_cast<Eigen::Index>(machines.size()));
    for (std::size_t i = 0; i < machines.size(); ++i) {
      const auto records = run(numbers_of(machines[i]), glance_turns);
      moved_Nm_.col(Eigen::Index(i)) = own_lines(records, numbers_.sun_teeth) - as_it_is;
    }
  }
  const Eigen::VectorXd before = own_lines(without_, numbers_.sun_teeth);
  const Eigen::VectorXd known_to =
      (lines_repeat_to * before).cwiseMax(lines_repeat_to * least_of_strongest * before.maxCoeff());
  const Eigen::VectorXd left =
      left_by_calibration(own_lines(with, numbers_.sun_teeth) - before, moved_Nm_, known_to);
  Visibility seen;
  seen.strongest_Nm = before.maxCoeff();
  seen.line_Nm = left.cwiseAbs().maxCoeff();
  const auto of = left.reshaped(own_lines_per_record, Eigen::Index(with.size()));
  for (std::size_t i = 0; i < with.size(); ++i) {
    Eigen::Index line = 0;
    const double amplitude_Nm = of.col(Eigen::Index(i)).cwiseAbs().maxCoeff(&line);
    seen.under.push_back({amplitude_Nm, own_line_Hz(with[i], numbers_.sun_teeth, line),
                          record_length_s(with[i].point.speed_rpm, output_turns_)});
  }
  return seen;
}

}  // namespace seal
