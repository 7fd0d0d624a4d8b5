#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "bench/campaign.hpp"
#include "sim/plant_json.hpp"

namespace rvbench::test {

/// A slide of 3 kg on 8 N·s/m whose way is known in closed form, and so is the force that moves
/// it: none of rvbench's own integrators or laws made the data.
struct MovedSlide {
  /// What pushes against the motion beside mass and viscous friction [N].
  std::function<double(double way_m, double speed_m_s)> law = [](double, double) { return 0.0; };
  double noise_N = 0.1;
  double drift_N = 0;  ///< from the first record to the last
  double gain = 1;     ///< of the force transducer
  double length_s = 6;
  unsigned seed = 1;

  static constexpr double rate_Hz = 500;

  bench::Campaign campaign() const {
    bench::Campaign all;
    all.name = "slide";
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal(0, noise_N);
    const double amplitudes_m[] = {0.1, 0.2, 0.15, 0.1, 0.2, 0.15};
    for (int r = 0; r < 6; ++r) {
      const double slow = 3 + 0.5 * (r % 3), fast = 2.3 * slow;
      bench::CampaignRecord record;
      record.name = "record " + std::to_string(r + 1);
      record.condition = "amplitude " + std::to_string(r % 3);
      record.programme = record.condition;
      const auto n = static_cast<Eigen::Index>(length_s * rate_Hz);
      Eigen::VectorXd way(n), force(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const double t = static_cast<double>(i) / rate_Hz, a = amplitudes_m[r];
        const double q = a * (std::sin(slow * t) + 0.4 * std::sin(fast * t + 1));
        const double v = a * (slow * std::cos(slow * t) + 0.4 * fast * std::cos(fast * t + 1));
        const double acceleration =
            -a * (slow * slow * std::sin(slow * t) + 0.4 * fast * fast * std::sin(fast * t + 1));
        way[i] = q;
        force[i] = gain * (3 * acceleration + 8 * v + law(q, v)) + drift_N * r / 5 + normal(engine);
      }
      record.recording.source = record.name;
      record.recording.channels = {{{"way", "m", "", not_known}, rate_Hz, 0, way},
                                   {{"force", "N", "", not_known}, rate_Hz, 0, force}};
      all.records.push_back(std::move(record));
    }
    return all;
  }

  /// Mass and viscous friction, known within 10 % and free.
  static sim::PlantSpec plant() {
    auto read = sim::parse_plant(hal::ConfigReader::from_text(R"({
      "plant": "slide",
      "bodies": [{"name": "slide", "motion": "translation",
                  "mass": {"value": 3.1, "unit": "kg", "tolerance_pct": 10}}],
      "terms": [{"type": "viscous_friction", "body_a": "slide", "parameters":
                 {"damping": {"value": 6, "unit": "N·s/m", "tolerance_pct": "free"}}}],
      "inputs": [{"channel": "way", "unit": "m", "is": "position", "body": "slide", "band_Hz": 40}],
      "outputs": [{"channel": "force", "unit": "N", "is": "drive", "body": "slide",
                   "offset": {"value": 0, "unit": "N", "tolerance_pct": "free"}}]})",
                                                              "slide.json"));
    REQUIRE(read.index() == 0);
    return std::get<0>(std::move(read));
  }
};

}  // namespace rvbench::test
