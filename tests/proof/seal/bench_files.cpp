#include "tests/proof/seal/bench_files.hpp"

#include <fstream>
#include <stdexcept>

#include "hal/recording_file.hpp"

namespace seal {

nlohmann::json bench_drawing(const std::filesystem::path& plants) {
  nlohmann::json plant = nlohmann::json::parse(std::ifstream(plants / "rv20e_bench.json"));
  for (nlohmann::json& term : plant.at("terms")) {
    if (term.at("type") != "planet_mesh") continue;
    term["parameters"]["profile_error"] = {{"value", 3e-6}, {"unit", "m"}, {"tolerance_pct", 50}};
    term["parameters"]["profile_phase"] = {{"value", 0.5}, {"unit", "rad"}};
  }
  return plant;
}

void write_recording(const std::filesystem::path& file, const std::vector<BenchRecord>& records) {
  const auto check = [&](const rvbench::Status& done) {
    if (!done) throw std::runtime_error(describe(done.error()));
  };
  rvbench::hal::RecordingLayout layout;
  layout.torque_rate_Hz = bench_rate_Hz;
  layout.software = "a bench";
  for (const BenchRecord& record : records) {
    layout.points.push_back({record.point.speed_rpm, record.point.load_pct, record.point.repeat});
  }
  auto writer = rvbench::hal::RecordingWriter::create(file, layout);
  if (!writer) throw std::runtime_error(describe(writer.error()));
  double t0_s = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const BenchRecord& record = records[i];
    rvbench::hal::TorqueBlock block{t0_s, {}, 0};
    for (Eigen::Index k = 0; k < record.torque_Nm.size(); ++k) {
      block.samples.push_back({record.torque_Nm[k], record.angle_rad[k]});
    }
    check(writer.value()->append(static_cast<int>(i), block));
    check(writer.value()->end_point({static_cast<int>(i), t0_s}));
    t0_s += static_cast<double>(record.torque_Nm.size()) / bench_rate_Hz + 5;
  }
  check(writer.value()->close());
}

}  // namespace seal
