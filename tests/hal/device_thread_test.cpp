#include "hal/device_thread.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "hal/can/serial_line.hpp"
#include "hal/daq/streamed_accelerometers.hpp"
#include "hal/steady_clock.hpp"
#include "tests/support/scarce_memory.hpp"
#include "tests/support/terminal.hpp"
#include "tests/support/wait_until.hpp"

using namespace rvbench;
using test::wait_until;

namespace {

// A DAQ device whose library throws what is no exception of the standard library.
class ThrowingSource final : public hal::ScanSource {
 public:
  Status connect() override { return Done{}; }
  double rate_Hz() const override { return 1000; }
  double range_m_s2() const override { return 10; }
  Status start() override { return Done{}; }
  Status wait(hal::AccelerationBlock::Scans&) override { throw 7; }
  void interrupt() noexcept override {}
  void stop() noexcept override {}
};

}  // namespace

SCENARIO("what is thrown in a device's thread is kept, and does not end the process", "[hal]") {
  hal::DeviceThread thread;
  CHECK_FALSE(thread.is_started());
  CHECK(thread.thrown().empty());
  WHEN("memory runs out") {
    thread.start([](const std::stop_token&) { throw std::bad_alloc(); });
    CHECK(wait_until([&] { return !thread.thrown().empty(); }));
    CHECK(thread.thrown() == "std::bad_alloc");
    THEN("it may be started anew, and has thrown nothing then") {
      thread.start([](const std::stop_token&) {});
      CHECK(thread.thrown().empty());
    }
  }
  WHEN("the message is longer than what is kept of it") {
    thread.start([](const std::stop_token&) { throw std::runtime_error(std::string(1000, 'x')); });
    CHECK(wait_until([&] { return !thread.thrown().empty(); }));
    CHECK(thread.thrown() == std::string(127, 'x'));
  }
  WHEN("it is asked to stop") {
    thread.start([](const std::stop_token& stop) {
      while (!stop.stop_requested()) std::this_thread::yield();
    });
    thread.stop();
    THEN("it ends, and has thrown nothing") { CHECK(thread.thrown().empty()); }
  }
}

TEST_CASE("a serial line for whose bytes there is no memory is a lost one", "[hal][can]") {
  const test::Terminal adapter;
  hal::SerialLine line;
  REQUIRE(line.open(adapter.name(), 115200));
  Result<std::string> read = std::string();
  {
    const test::ScarceMemory scarce;
    adapter.type("more bytes than fit into a short string\n");
    CHECK(wait_until([&] {
      (void)line.wait(std::chrono::milliseconds(1));
      read = line.read();
      return !read || !read.value().empty();
    }));
  }
  REQUIRE_FALSE(read);
  CHECK(read.error().code == IoErrc::disconnected);
  CHECK_THAT(read.error().where, Catch::Contains("std::bad_alloc"));
  REQUIRE(line.open(adapter.name(), 115200));  // and may be opened again
  CHECK(line.read());
}

TEST_CASE("accelerometers whose driver throws are lost ones", "[hal][daq]") {
  hal::SteadyClock clock;
  hal::StreamedAccelerometers accelerometers("accelerometers", std::make_unique<ThrowingSource>(),
                                             {{}}, 60, clock);
  REQUIRE(accelerometers.connect());
  REQUIRE(accelerometers.start());
  REQUIRE(wait_until([&] { return !accelerometers.read(); }));
  const auto read = accelerometers.read();
  CHECK(read.error().code == IoErrc::disconnected);
  CHECK_THAT(read.error().where, Catch::Contains("accelerometers: ") &&
                                     Catch::Contains("an exception of no known kind"));
}
