#include "tests/proof/seal/bench_campaign.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/types/parallel_for.hpp"
#include "tests/proof/seal/bench_train.hpp"
#include "tests/proof/seal/noise.hpp"

namespace seal {
namespace {

constexpr int thinning = 5;          // of the acquisition, which sees 4960 Hz
constexpr int steps_per_sample = 5;  // of the acquisition
constexpr double acquired_Hz = bench_rate_Hz * thinning;
constexpr double settling_s = 3.5;
constexpr double run_up_share = 0.4;
constexpr double rated_output_Nm = 167;
constexpr double pole_pairs = 2;
constexpr int filter_reach = 20;  // samples that are left
constexpr double passband = 0.85;

// Low-pass below what is left of the rate: a sinc under Blackman's window.
Eigen::VectorXd thinning_filter() {
  const int reach = filter_reach * thinning;
  Eigen::VectorXd taps(2 * reach + 1);
  for (int i = -reach; i <= reach; ++i) {
    const double x = std::numbers::pi * passband * i / thinning;
    const double at = std::numbers::pi * (i + reach) / reach;
    taps[i + reach] =
        (i == 0 ? 1 : std::sin(x) / x) * (0.42 - 0.5 * std::cos(at) + 0.08 * std::cos(2 * at));
  }
  return taps / taps.sum();
}

Eigen::VectorXd thinned(const Eigen::VectorXd& x, double late_samples) {
  static const Eigen::VectorXd taps = thinning_filter();
  const auto late = static_cast<Eigen::Index>(std::round(late_samples * thinning));
  const Eigen::Index margin = thinning;  // a delay of one sample either way
  const Eigen::Index count = (x.size() - taps.size() - 2 * margin) / thinning;
  return Eigen::VectorXd::NullaryExpr(count, [&](Eigen::Index i) {
    return taps.dot(x.segment(margin - late + i * thinning, taps.size()));
  });
}

void drop_out(Eigen::VectorXd& x, int times, Draw& draw) {
  for (int i = 0; i < times; ++i) {
    const auto at = static_cast<Eigen::Index>(draw.uniform(1, static_cast<double>(x.size()) - 2));
    x[at] = x[at + 1] = x[at - 1];
  }
}

}  // namespace

std::vector<BenchPoint> bench_matrix(int repeats) {
  std::vector<BenchPoint> points;
  for (const double speed_rpm : {605.0, 1210.0, 1815.0}) {
    for (const double load_pct : {0.0, 75.0, 150.0}) {
      for (int repeat = 1; repeat <= repeats; ++repeat) {
        points.push_back({speed_rpm, load_pct, repeat});
      }
    }
  }
  return points;
}

double record_length_s(double speed_rpm, double output_turns) {
  return output_turns * 121 * 60 / speed_rpm;
}

std::vector<BenchRecord> run_bench(
    const BenchNumbers& numbers, const std::vector<BenchPoint>& points, double output_turns,
    const Nuisance& nuisance, std::uint64_t seed,
    const std::function<std::vector<std::unique_ptr<BenchEffect>>()>& effects) {
  std::vector<BenchRecord> records(points.size());
  Draw seeds(seed);
  std::vector<std::uint64_t> own(points.size());
  std::ranges::generate(own, [&] { return seeds.seed(); });
  rvbench::parallel_for(points.size(), [&](std::size_t number) {
    const BenchPoint& point = points[number];
    Draw draw(own[number]);
    const auto acting = effects();
    std::vector<BenchEffect*> pointers;
    for (const auto& effect : acting) pointers.push_back(effect.get());
    BenchTrain train(numbers, pointers, 1 / (acquired_Hz * steps_per_sample));
    const double age = static_cast<double>(number) / static_cast<double>(points.size());
    train.set_friction_factor((1 + nuisance.friction_scatter * draw.normal()) *
                              (1 - nuisance.warming * age));
    train.set_error_factor(1 + nuisance.line_jitter * draw.normal());
    train.set_brake_Nm(point.load_pct / 100 * rated_output_Nm);
    const double supply_Hz = point.speed_rpm / 60 * pole_pairs;
    const double settle = settling_s * draw.uniform(1, 1.3) * acquired_Hz;
    for (int i = 0; i < static_cast<int>(settle); ++i) {
      train.set_supply_Hz(supply_Hz * std::min(1.0, i / (run_up_share * settle)));
      for (int step = 0; step < steps_per_sample; ++step) train.step();
    }
    const auto count =
        static_cast<Eigen::Index>(record_length_s(point.speed_rpm, output_turns) * acquired_Hz +
                                  (2 * filter_reach + 3) * thinning);
    Eigen::VectorXd torque_Nm(count), angle_rad(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (int step = 0; step < steps_per_sample; ++step) train.step();
      torque_Nm[i] = train.coupling_Nm();
      angle_rad[i] = train.sun_rad();
    }
    BenchRecord& record = records[number];
    record.point = point;
    record.angle_rad = thinned(angle_rad, 0);
    record.torque_Nm =
        nuisance.torque_gain * thinned(torque_Nm, nuisance.torque_delay_samples) +
        nuisance.noise_Nm * coloured_noise(record.angle_rad.size(), nuisance.noise_slope, draw);
    drop_out(record.torque_Nm, nuisance.drop_outs, draw);
  });
  return records;
}

}  // namespace seal
