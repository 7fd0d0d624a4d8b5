#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "tests/proof/seal/bench_effect.hpp"
#include "tests/proof/seal/bench_numbers.hpp"

namespace seal {

inline constexpr double bench_rate_Hz = 992;  ///< of what is recorded

/// One corner of the matrix.
struct BenchPoint {
  double speed_rpm = 0, load_pct = 0;
  int repeat = 0;
};

/// What differs from record to record, and what the sensors add. None of it is physics.
struct Nuisance {
  double torque_gain = 1;
  double torque_delay_samples = 0;
  double noise_Nm = 2e-3;          ///< rms
  double noise_slope = 0.5;        ///< its power falls as 1/f^slope
  double line_jitter = 0;          ///< of mesh errors, from record to record
  double friction_scatter = 3e-3;  ///< likewise, of the input shaft's friction
  double warming = 0;              ///< friction that is lost from the first record to the last
  int drop_outs = 0;               ///< in each record: the last value stands for two samples
};

struct BenchRecord {
  BenchPoint point;
  Eigen::VectorXd torque_Nm, angle_rad;
};

/// 3 speeds x 3 loads, each as often, records of as many output turns.
std::vector<BenchPoint> bench_matrix(int repeats);
double record_length_s(double speed_rpm, double output_turns);

/// Runs the points. The same seed gives the same noise and scatter whatever acts.
/// @param effects  makes new ones for each record, for they have memories
std::vector<BenchRecord> run_bench(
    const BenchNumbers& numbers, const std::vector<BenchPoint>& points, double output_turns,
    const Nuisance& nuisance, std::uint64_t seed,
    const std::function<std::vector<std::unique_ptr<BenchEffect>>()>& effects);

}  // namespace seal
