// Streams from Debian's iiod into a recording for as long as asked, and looks at every sample.
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "hal/recording_file.hpp"
#include "hal/steady_clock.hpp"
#include "tests/peers/iio_peer.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

using namespace rvbench;

double cpu_s(int who) {
  rusage used{};
  ::getrusage(who, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

constexpr double most_writing_share = 0.05;

struct Options {
  double seconds = 600;
  double rate_Hz = 102'400;
  int channels = 24;
};

struct Soak {
  long scans = 0, wrong = 0;
  double longest_gap_s = 0, writing_s = 0, receiving_s = 0, took_s = 0, uncertainty_s = 0;
};

std::unique_ptr<hal::RecordingWriter> recording(const std::filesystem::path& file,
                                                const hal::Accelerometers& accelerometers) {
  hal::RecordingLayout layout;
  layout.points = {{1210, 50, 1}};
  layout.acceleration_channels = accelerometers.channels();
  layout.acceleration_rate_Hz = accelerometers.rate_Hz();
  auto made = hal::RecordingWriter::create(file, layout);
  if (!made) throw std::runtime_error(describe(made.error()));
  return std::move(made).value();
}

// Whether each sample is the one that the device has made of this scan.
long wrong_scans(const hal::AccelerationBlock::Scans& scans, long first) {
  long wrong = 0;
  for (Eigen::Index i = 0; i < scans.rows(); ++i) {
    for (Eigen::Index c = 0; c < scans.cols(); ++c) {
      if (scans(i, c) == test::standin_m_s2(first + i, int(c))) continue;
      ++wrong;
      break;
    }
  }
  return wrong;
}

Soak soak(const Options& options, const std::filesystem::path& folder) {
  const test::Iiod iiod(options.rate_Hz, options.channels);
  hal::SteadyClock clock;
  const auto accelerometers =
      make_iio_accelerometers(test::options_of(iiod, options.rate_Hz, options.channels), clock);
  if (const Status connected = accelerometers->connect(); !connected) {
    throw std::runtime_error(describe(connected.error()));
  }
  const auto writer = recording(folder / "soak.h5", *accelerometers);
  Soak result;
  const double cpu_before_s = cpu_s(RUSAGE_SELF);
  if (const Status started = accelerometers->start(); !started) {
    throw std::runtime_error(describe(started.error()));
  }
  const double start_s = clock.now_s();
  double came_s = start_s, checking_s = 0;
  while (double(result.scans) < options.seconds * options.rate_Hz) {
    clock.wait_until(clock.now_s() + 0.01);
    const auto block = accelerometers->read();
    if (!block) throw std::runtime_error(describe(block.error()));
    if (block.value().scans.rows() == 0) continue;
    result.uncertainty_s = block.value().time_uncertainty_s;
    const double before_s = cpu_s(RUSAGE_THREAD);
    result.wrong += wrong_scans(block.value().scans, result.scans);
    const double checked_s = cpu_s(RUSAGE_THREAD);
    checking_s += checked_s - before_s;
    if (!writer->append(0, block.value())) throw std::runtime_error("the file takes no more");
    result.writing_s += cpu_s(RUSAGE_THREAD) - checked_s;
    result.scans += block.value().scans.rows();
    result.longest_gap_s = std::max(result.longest_gap_s, clock.now_s() - came_s);
    came_s = clock.now_s();
  }
  result.took_s = clock.now_s() - start_s;
  result.receiving_s = cpu_s(RUSAGE_SELF) - cpu_before_s - checking_s - result.writing_s;
  if (!writer->end_point({0, 0, "ok", 1210, 2})) throw std::runtime_error("the point does not end");
  return result;
}

// Of one core; judged where the run is as long and as wide as it is meant to be.
double writing_share(const Soak& soak) { return soak.writing_s / soak.took_s; }

bool is_whole(const Options& options) {
  const Options meant;
  return options.seconds >= meant.seconds && options.rate_Hz >= meant.rate_Hz &&
         options.channels >= meant.channels;
}

void print(const Options& options, const Soak& soak) {
  fmt::print("{} channels at {:g} Hz from Debian's iiod: {} scans in {:.1f} s\n", options.channels,
             options.rate_Hz, soak.scans, soak.took_s);
  fmt::print("scans lost or wrong                {:10}     limit 0\n", soak.wrong);
  fmt::print("writing HDF5, of one core          {:10.2f} %   limit {:g}{}\n",
             100 * writing_share(soak), 100 * most_writing_share,
             is_whole(options) ? "" : ", not judged in a shorter run");
  fmt::print("receiving, of one core             {:10.2f} %\n",
             100 * soak.receiving_s / soak.took_s);
  fmt::print("longest time between two blocks    {:10.1f} ms\n", 1e3 * soak.longest_gap_s);
  fmt::print("time stamps scatter by             {:10.2f} ms\n", 1e3 * soak.uncertainty_s);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Streams from iiod into a recording, and looks at every sample. What writing takes of a core "
      "is "
      "judged in a run with all defaults, or more."};
  app.add_option("--seconds", options.seconds, "how long")->capture_default_str();
  app.add_option("--rate", options.rate_Hz, "scans per second")->capture_default_str();
  app.add_option("--channels", options.channels, "of each scan")
      ->check(CLI::Range(1, 31))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    const test::ScratchFolder scratch;
    const Soak result = soak(options, scratch.path());
    print(options, result);
    const bool is_slow = is_whole(options) && writing_share(result) > most_writing_share;
    return result.wrong == 0 && !is_slow ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "rvbench_daq_soak: {}\n", error.what());
    return 1;
  }
}
