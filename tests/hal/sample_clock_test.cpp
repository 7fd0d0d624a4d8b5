#include "hal/daq/sample_clock.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "hal/daq/scan_stream.hpp"

using namespace rvbench;
using hal::SampleClock;

namespace {

// A device that sends blocks of 10 ms, each late by a random time that is never below `least_s`.
struct Device {
  double rate_Hz = 10'000;
  double start_s = 3.5;  // of sample 0
  double least_s = 0.0002;
  double scatter_s = 0.003;
  std::mt19937_64 random{7};
  std::int64_t sent = 0;

  double time_of(std::int64_t sample) const { return start_s + double(sample) / rate_Hz; }
  void send(SampleClock& clock, double seconds) {
    std::exponential_distribution<double> late_s(1 / scatter_s);
    const std::int64_t until = sent + std::int64_t(seconds * rate_Hz);
    while (sent < until) {
      sent += 100;
      clock.add(sent, time_of(sent - 1) + least_s + late_s(random));
    }
  }
};

}  // namespace

TEST_CASE("samples are placed by the most punctual blocks, not by the usual ones", "[hal][daq]") {
  Device device;
  SampleClock clock(10'000);
  device.send(clock, 30);
  const double error_s = clock.time_s(device.sent - 1) - device.time_of(device.sent - 1);
  CHECK(error_s >= 0);
  CHECK(error_s < device.least_s + 0.0005);  // usual blocks are 3 ms late
  CHECK(clock.uncertainty_s() < 0.0005);
  CHECK(clock.missing_s() == 0);
}

TEST_CASE("a clock that runs 50 ppm fast is followed", "[hal][daq]") {
  Device device{.rate_Hz = 10'000.5};
  SampleClock clock(10'000);
  device.send(clock, 120);
  CHECK(clock.rate_Hz() == Approx(10'000.5).epsilon(5e-6));
  // Two minutes at the nominal rate would be 6 ms off.
  CHECK(std::abs(clock.time_s(device.sent - 1) - device.time_of(device.sent - 1)) < 0.0007);
}

TEST_CASE("a hole in the stream is found within two seconds", "[hal][daq]") {
  Device device;
  SampleClock clock(10'000);
  device.send(clock, 20);
  REQUIRE(clock.missing_s() == 0);
  device.start_s += 0.02;  // 200 samples that were never sent
  device.send(clock, 2.1);
  CHECK(clock.missing_s() == Approx(0.02).margin(0.002));
}

TEST_CASE("a hole is found in time wherever it is, down to what lateness hides", "[hal][daq]") {
  const double after_s = GENERATE(0.0, 0.25, 0.5, 0.75, 0.99);  // the last whole second
  const double hole_s = GENERATE(0.001, 0.008, 0.05);
  Device device{.scatter_s = 0.0005};
  SampleClock clock(10'000);
  device.send(clock, 20 + after_s);
  REQUIRE(clock.missing_s() == 0);
  device.start_s += hole_s;
  double found_s = 0;
  for (int block = 0; block < 250 && found_s == 0; ++block) {
    device.send(clock, 0.01);
    if (clock.missing_s() > 0) found_s = 0.01 * (block + 1);
  }
  if (hole_s < 0.005) {
    CHECK(found_s == 0);
  } else {
    REQUIRE(found_s > 0);
    CHECK(found_s <= SampleClock::hole_found_within_s);
  }
}

TEST_CASE("a computer that was busy for a while is no hole", "[hal][daq]") {
  Device device;
  SampleClock clock(10'000);
  device.send(clock, 10);
  device.least_s = 0.02;  // for 0.8 s nothing is punctual
  device.send(clock, 0.8);
  device.least_s = 0.0002;
  device.send(clock, 10);
  CHECK(clock.missing_s() == 0);
  CHECK(std::abs(clock.time_s(device.sent - 1) - device.time_of(device.sent - 1)) < 0.0007);
}

TEST_CASE("a rate that is no rate is refused", "[hal][daq]") {
  CHECK_THROWS_AS(SampleClock(0), std::invalid_argument);
  CHECK_THROWS_AS(SampleClock(NAN), std::invalid_argument);
}

TEST_CASE("blocks are handed on in one row, however the clock's estimate moves", "[hal][daq]") {
  hal::ScanStream stream(1000, 1000);
  double end_s = not_known;
  for (int block = 0; block < 200; ++block) {
    const double late_s = block < 50 ? 0.02 : 0.001;  // punctual from then on
    stream.push(hal::AccelerationBlock::Scans::Constant(10, 2, float(block)),
                0.01 * (block + 1) + late_s);
    const auto taken = stream.take();
    REQUIRE(taken);
    REQUIRE(taken.value().scans.rows() == 10);
    CHECK(taken.value().scans(9, 1) == float(block));
    if (block > 0) CHECK(taken.value().t0_s == Approx(end_s).margin(0.0006));
    end_s = taken.value().t0_s + 10 / 1000.0;
  }
  CHECK(end_s == Approx(2.001).margin(0.002));
}

TEST_CASE("blocks that nobody took are one, too many are an overrun", "[hal][daq]") {
  hal::ScanStream stream(1000, 25);
  stream.push(hal::AccelerationBlock::Scans::Constant(10, 2, 1), 0.01);
  stream.push(hal::AccelerationBlock::Scans::Constant(10, 2, 2), 0.02);
  const auto both = stream.take();
  REQUIRE(both);
  REQUIRE(both.value().scans.rows() == 20);
  CHECK(both.value().scans(9, 0) == 1);
  CHECK(both.value().scans(10, 0) == 2);
  CHECK(stream.take().value().scans.rows() == 0);
  for (int block = 0; block < 3; ++block) {
    stream.push(hal::AccelerationBlock::Scans::Constant(10, 2, 3), 0.03 + 0.01 * block);
  }
  CHECK(stream.take().value().scans.rows() == 20);  // what came before the overrun
  const auto after = stream.take();
  REQUIRE_FALSE(after);
  CHECK(after.error().code == IoErrc::overrun);
}
