#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "hal/recording_file.hpp"
#include "tests/latency/figures.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::test {
namespace {

constexpr int channels = 24;
constexpr double rate_Hz = 102'400;
constexpr double block_s = 0.01;  // as often as the sequencer hands blocks on

double cpu_s() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

hal::RecordingLayout layout() {
  hal::RecordingLayout all;
  all.points = {{1210, 50, 1}};
  for (int i = 0; i < channels; ++i) {
    all.acceleration_channels.push_back({"accel_" + std::to_string(i), "m/s²", "+X"});
  }
  all.acceleration_rate_Hz = rate_Hz;
  all.torque_rate_Hz = 500;
  return all;
}

}  // namespace

// Paced as the samples come: flushes and syncs are those of a real record.
std::vector<Figure> measure_recording(double duration_s) {
  const ScratchFolder scratch;
  const auto made = hal::RecordingWriter::create(scratch / "r.h5", layout());
  if (!made) throw std::runtime_error(describe(made.error()));
  hal::AccelerationBlock block;
  block.scans.resize(Eigen::Index(rate_Hz * block_s), channels);
  for (Eigen::Index i = 0; i < block.scans.size(); ++i) block.scans.data()[i] = float(i % 977);
  const double before_s = cpu_s();
  const auto began = std::chrono::steady_clock::now();
  const int blocks = int(duration_s / block_s);
  std::vector<double> appends_ms;
  for (int i = 0; i < blocks; ++i) {
    std::this_thread::sleep_until(began + std::chrono::duration<double>(i * block_s));
    const auto start = std::chrono::steady_clock::now();
    if (!made.value()->append(0, block)) throw std::runtime_error("a block was not written");
    appends_ms.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
            .count());
  }
  if (!made.value()->end_point({0, 0, "ok", 1210, 2})) throw std::runtime_error("no end");
  const double share_pct = 100 * (cpu_s() - before_s) / duration_s;
  return {{"recording 24 channels at 102.4 kHz, of one core", share_pct, "%", 5, 30},
          {"a block of 10 ms handed to the file, longest", quantile(appends_ms, 1), "ms"}};
}

}  // namespace rvbench::test
