#include <comedilib.h>
#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "hal/daq/comedi_accelerometers.hpp"
#include "hal/steady_clock.hpp"
#include "tests/contracts/accelerometers_contract.hpp"
#include "tests/kernel/can_interface.hpp"

using namespace rvbench;
using hal::ComediOptions;

// Linux' comedi_test board: 16 bits, ±10 and ±5 V; of its inputs 0 is a sawtooth and 1 a square of
// ±1 V at 10 Hz by the board's own clock, the others are 0 V.
namespace {

constexpr double m_s2_per_V = 100;
constexpr double step_m_s2 = 20.0 / 65535 * m_s2_per_V;  // of a count in the range of ±10 V

ComediOptions options(int inputs, double rate_Hz) {
  ComediOptions options;
  options.rate_Hz = rate_Hz;
  options.range_m_s2 = 1e6;
  options.deadline_s = 2;
  for (int i = 0; i < inputs; ++i) {
    const std::string number = std::to_string(i);
    options.inputs.push_back({number, {"accel_" + number, "m/s²", "+X", 1 / m_s2_per_V}});
  }
  return options;
}

// So many scans in one piece. An error ends the test.
Eigen::MatrixXd scans_of(hal::Accelerometers& device, hal::Clock& clock, Eigen::Index count) {
  Eigen::MatrixXd all(count, Eigen::Index(device.channels().size()));
  for (Eigen::Index have = 0; have < count;) {
    clock.wait_until(clock.now_s() + 0.005);
    const auto read = device.read();
    INFO((read ? "" : describe(read.error())));
    REQUIRE(read);
    if (read.value().scans.rows() == 0) continue;
    const Eigen::Index take = std::min(count - have, read.value().scans.rows());
    all.middleRows(have, take) = read.value().scans.topRows(take).cast<double>();
    have += take;
  }
  return all;
}

}  // namespace

TEST_CASE("a comedi board's waves come without a hole, in m/s²") {
  hal::SteadyClock clock;
  const auto device = hal::make_comedi_accelerometers(options(3, 1000), clock);
  REQUIRE(device->connect());
  REQUIRE(device->rate_Hz() == Approx(1000).epsilon(0.01));
  REQUIRE(device->start());
  const Eigen::MatrixXd scans = scans_of(*device, clock, 3000);
  const double per_period = device->rate_Hz() / 10;
  const double rise_m_s2 = 2 * m_s2_per_V / per_period;
  int wraps = 0, turns = 0;
  for (Eigen::Index i = 1; i < scans.rows(); ++i) {
    const double step = scans(i, 0) - scans(i - 1, 0);
    if (step < 0) {
      ++wraps;
      CHECK(step + 2 * m_s2_per_V == Approx(rise_m_s2).margin(2.1 * step_m_s2));
    } else {
      CHECK(step == Approx(rise_m_s2).margin(1.1 * step_m_s2));
    }
    if (std::abs(scans(i, 1) - scans(i - 1, 1)) > m_s2_per_V) ++turns;
  }
  CHECK(wraps == Approx(3000 / per_period).margin(1));
  CHECK(turns == Approx(2 * 3000 / per_period).margin(1));
  CHECK(scans.col(0).maxCoeff() == Approx(m_s2_per_V).margin(rise_m_s2 + step_m_s2));
  CHECK(scans.col(0).minCoeff() == Approx(-m_s2_per_V).margin(rise_m_s2 + step_m_s2));
  // The board rounds its amplitude down, and its middle is half a count off.
  CHECK(scans.col(1).cwiseAbs().maxCoeff() == Approx(m_s2_per_V).margin(1.6 * step_m_s2));
  CHECK(scans.col(1).cwiseAbs().minCoeff() == Approx(m_s2_per_V).margin(1.6 * step_m_s2));
  CHECK(scans.col(2).cwiseAbs().maxCoeff() < 1.1 * step_m_s2);
}

TEST_CASE("a comedi board's rate is read back: its times are whole microseconds") {
  hal::SteadyClock clock;
  const auto device = hal::make_comedi_accelerometers(options(8, 9000), clock);
  CHECK(device->rate_Hz() == 9000);
  REQUIRE(device->connect());
  const double period_us = 1e6 / device->rate_Hz();
  CHECK(period_us == Approx(std::round(period_us)).margin(1e-6));
  CHECK(device->rate_Hz() != 9000);
  CHECK(device->rate_Hz() == Approx(9000).epsilon(0.1));
}

TEST_CASE("a comedi board's range is the smallest that holds what is asked for") {
  hal::SteadyClock clock;
  auto asked = options(1, 1000);
  for (const auto& [volts, range_V] : {std::pair{10.0, 10.0}, {4.0, 5.0}, {5.0, 5.0}}) {
    asked.range_V = volts;
    const auto device = hal::make_comedi_accelerometers(asked, clock);
    REQUIRE(device->connect());
    CHECK(device->range_m_s2() == Approx(range_V * m_s2_per_V));
  }
  asked.range_V = 11;
  const auto connected = hal::make_comedi_accelerometers(asked, clock)->connect();
  REQUIRE_FALSE(connected);
  CHECK(connected.error().code == IoErrc::refused);
  CHECK_THAT(connected.error().where, Catch::Contains("±11 V"));
}

TEST_CASE("a comedi board keeps the accelerometers contract") {
  hal::SteadyClock clock;
  const auto device = hal::make_comedi_accelerometers(options(2, 2000), clock);
  test::check_accelerometers_contract(*device, clock, 0.2);
}

TEST_CASE("a comedi board's inputs that are not there are told") {
  hal::SteadyClock clock;
  SECTION("the board") {
    auto asked = options(1, 1000);
    asked.device = "/dev/comedi9";
    const auto connected = hal::make_comedi_accelerometers(asked, clock)->connect();
    CHECK(connected.error().code == IoErrc::disconnected);
    CHECK_THAT(connected.error().where, Catch::Contains("/dev/comedi9"));
  }
  SECTION("a channel") {
    const auto connected = hal::make_comedi_accelerometers(options(9, 1000), clock)->connect();
    CHECK(connected.error().code == IoErrc::refused);
    CHECK_THAT(connected.error().where, Catch::Contains("no input 8 (there is: 0 to 7)"));
  }
  SECTION("a name, or one twice, is the caller's bug") {
    auto asked = options(2, 1000);
    asked.inputs[1].device_channel = "voltage1";
    CHECK_THROWS_AS(hal::make_comedi_accelerometers(asked, clock), std::invalid_argument);
    asked.inputs[1].device_channel = "0";
    CHECK_THROWS_AS(hal::make_comedi_accelerometers(asked, clock), std::invalid_argument);
  }
}

TEST_CASE("a comedi board is free once it is stopped, and starts again") {
  hal::SteadyClock clock;
  const auto one = hal::make_comedi_accelerometers(options(2, 1000), clock);
  const auto other = hal::make_comedi_accelerometers(options(1, 1000), clock);
  REQUIRE(one->connect());
  REQUIRE(one->start());
  (void)scans_of(*one, clock, 100);
  REQUIRE(other->connect());
  CHECK(other->start().error().code == IoErrc::refused);  // it is busy
  one->stop();
  CHECK(one->read().error().code == IoErrc::disconnected);
  REQUIRE(other->start());
  (void)scans_of(*other, clock, 100);
  other->stop();
  REQUIRE(one->start());
  (void)scans_of(*one, clock, 100);
}

TEST_CASE("a comedi board whose buffer runs over says so") {
  hal::SteadyClock clock;
  // Linux gave it one of many seconds; what the driver asks for is one.
  comedi_t* board = comedi_open("/dev/comedi0");
  REQUIRE(board != nullptr);
  REQUIRE(comedi_set_buffer_size(board, 0, 1U << 16U) > 0);
  comedi_close(board);
  const auto device = hal::make_comedi_accelerometers(options(8, 10'000), clock);
  REQUIRE(device->connect());
  REQUIRE(device->start());
  (void)scans_of(*device, clock, 100);
  // This computer has no time for it, for longer than its buffer lasts.
  test::shell("(sleep 3; kill -CONT " + std::to_string(::getpid()) + ") >/dev/null 2>&1 &");
  ::raise(SIGSTOP);
  std::optional<IoError> error;
  for (const double end_s = clock.now_s() + 5; !error && clock.now_s() < end_s;) {
    clock.wait_until(clock.now_s() + 0.01);
    const auto read = device->read();
    if (!read) error = read.error();
  }
  REQUIRE(error);
  INFO(describe(*error));
  CHECK(error->code == IoErrc::overrun);
  REQUIRE(device->start());
  (void)scans_of(*device, clock, 100);
}
