#include <signal.h>

#include <catch2/catch.hpp>
#include <thread>

#include "hal/steady_clock.hpp"
#include "tests/contracts/accelerometers_contract.hpp"
#include "tests/peers/iio_peer.hpp"

using namespace rvbench;

namespace {

IoError next_error(hal::Accelerometers& accelerometers) {
  for (;;) {
    const auto block = accelerometers.read();
    if (!block) return block.error();
    std::this_thread::yield();
  }
}

}  // namespace

TEST_CASE("Debian's iiod hands over every scan of the inputs asked for", "[peers][daq]") {
  test::Iiod iiod(10'000, 8);
  hal::SteadyClock clock;
  hal::IioOptions options = test::options_of(iiod, 10'000, 8);
  options.inputs.erase(options.inputs.begin() + 2, options.inputs.begin() + 7);  // 0, 1 and 7
  options.inputs[1].info.sensitivity *= 2;
  const auto accelerometers = make_iio_accelerometers(options, clock);
  const Status connected = accelerometers->connect();
  INFO((connected ? "" : describe(connected.error())));
  REQUIRE(connected);
  CHECK(accelerometers->rate_Hz() == 10'000);
  CHECK(accelerometers->range_m_s2() == Approx(0.125 * 2147483647));  // of the second
  REQUIRE(accelerometers->start());
  long scan = 0;
  while (scan < 20'000) {
    const auto block = accelerometers->read();
    INFO((block ? "" : describe(block.error())));
    REQUIRE(block);
    for (Eigen::Index i = 0; i < block.value().scans.rows(); ++i, ++scan) {
      REQUIRE(block.value().scans(i, 0) == test::standin_m_s2(scan, 0));
      REQUIRE(block.value().scans(i, 1) == test::standin_m_s2(scan, 1) / 2);
      REQUIRE(block.value().scans(i, 2) == test::standin_m_s2(scan, 7));
    }
    std::this_thread::yield();
  }
}

TEST_CASE("samples of other formats come as they are", "[peers][daq]") {
  test::Iiod iiod(10'000, 2, "be:s24/32>>8");
  hal::SteadyClock clock;
  const auto accelerometers = make_iio_accelerometers(test::options_of(iiod, 10'000, 2), clock);
  REQUIRE(accelerometers->connect());
  CHECK(accelerometers->range_m_s2() == 0.25 * 8388607);
  REQUIRE(accelerometers->start());
  for (long scan = 0; scan < 5000;) {
    const auto block = accelerometers->read();
    REQUIRE(block);
    for (Eigen::Index i = 0; i < block.value().scans.rows(); ++i, ++scan) {
      REQUIRE(block.value().scans(i, 0) == test::standin_m_s2(scan, 0));
      REQUIRE(block.value().scans(i, 1) == test::standin_m_s2(scan, 1));
    }
    std::this_thread::yield();
  }
}

TEST_CASE("accelerometers behind iiod keep the accelerometers contract", "[peers][daq][contract]") {
  test::Iiod iiod(5000, 3);
  hal::SteadyClock clock;
  const auto accelerometers = make_iio_accelerometers(test::options_of(iiod, 5000, 3), clock);
  test::check_accelerometers_contract(*accelerometers, clock, 0.2);
}

TEST_CASE("of a name that iiod does not have is told what there is", "[peers][daq]") {
  test::Iiod iiod(5000, 3);
  hal::SteadyClock clock;
  hal::IioOptions options = test::options_of(iiod, 5000, 3);
  SECTION("a device") {
    options.device = "standout";
    const auto connected = make_iio_accelerometers(options, clock)->connect();
    REQUIRE_FALSE(connected);
    CHECK(connected.error().code == IoErrc::refused);
    CHECK_THAT(connected.error().where, Catch::Contains("there is: standin"));
  }
  SECTION("an input") {
    options.inputs[1].device_channel = "voltage7";
    const auto connected = make_iio_accelerometers(options, clock)->connect();
    REQUIRE_FALSE(connected);
    CHECK(connected.error().code == IoErrc::refused);
    CHECK_THAT(connected.error().where, Catch::Contains("voltage0, voltage1, voltage2"));
  }
}

TEST_CASE("a device that falls silent under iiod is late, and is found again", "[peers][daq]") {
  test::Iiod iiod(10'000, 2);
  hal::SteadyClock clock;
  const auto accelerometers = make_iio_accelerometers(test::options_of(iiod, 10'000, 2), clock);
  REQUIRE(accelerometers->connect());
  REQUIRE(accelerometers->start());
  REQUIRE(iiod.program().send(SIGUSR1));
  CHECK(next_error(*accelerometers).code == IoErrc::timeout);
  REQUIRE(iiod.program().send(SIGUSR1));
  const Status again = accelerometers->connect();
  INFO((again ? "" : describe(again.error())));
  REQUIRE(again);
  REQUIRE(accelerometers->start());
  clock.wait_until(clock.now_s() + 0.1);
  CHECK(accelerometers->read());
}

TEST_CASE("an iiod that is killed is a lost device", "[peers][daq]") {
  test::Iiod iiod(10'000, 2);
  hal::SteadyClock clock;
  const auto accelerometers = make_iio_accelerometers(test::options_of(iiod, 10'000, 2), clock);
  REQUIRE(accelerometers->connect());
  REQUIRE(accelerometers->start());
  REQUIRE(iiod.program().send(SIGUSR2));
  CHECK(next_error(*accelerometers).code == IoErrc::disconnected);
  CHECK_FALSE(accelerometers->connect());
}
