#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "hal/can/canopen_torque_sensor.hpp"
#include "hal/can/in_process_transport.hpp"

using namespace rvbench;

namespace {

constexpr int node_id = 5;

// Time, and a node that beats its heart and sends its torque when somebody changes it.
class Node final : public hal::Clock {
 public:
  double now_s() const override { return time_s_; }
  bool is_virtual() const override { return true; }
  void wait_until(double time_s) override {
    while (time_s_ < time_s - 1e-9) {
      time_s_ = static_cast<double>(++steps_) * 0.001;
      listen();
      if (beats && steps_ % 50 == 0) say(0x700, {state});
    }
  }

  void torque(std::int32_t counts) {
    const auto bits = static_cast<std::uint32_t>(counts);
    say(0x180, {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U),
                static_cast<std::uint8_t>(bits >> 16U), static_cast<std::uint8_t>(bits >> 24U)});
  }

  void say(std::uint32_t base, const std::vector<std::uint8_t>& bytes) {
    hal::CanFrame frame{.id = base + node_id, .length = static_cast<std::uint8_t>(bytes.size())};
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
    REQUIRE(bus.nodes->send(frame));
  }

  hal::InProcessBus bus = hal::make_in_process_bus([this] { return time_s_; });
  bool beats = true;
  std::uint8_t state = 0x7F;  // pre-operational
  std::int32_t first_counts = 1500;
  std::uint8_t first_status = 0;

 private:
  void listen() {
    while (const auto told = bus.nodes->receive()) {
      const bool is_start = told.value().id == 0 && told.value().data[0] == 1;
      if (!is_start || told.value().data[1] != node_id) continue;
      state = 0x05;
      say(0x280, {first_status});
      torque(first_counts);
    }
  }

  long steps_ = 0;
  double time_s_ = 0;
};

struct Bench {
  Bench() { REQUIRE(node.bus.nodes->open()); }

  Node node;
  hal::CanopenTorqueSensor sensor{
      std::move(node.bus.bench), {.node = node_id, .rate_Hz = 1000, .Nm_per_count = 1e-3}, node};
};

}  // namespace

SCENARIO("a torque that stays is sent once, and read all the time", "[hal][can]") {
  Bench bench;
  REQUIRE(bench.sensor.connect());
  bench.node.wait_until(bench.node.now_s() + 1);
  const auto held = bench.sensor.read();
  REQUIRE(held);
  CHECK(held.value().samples.size() == 1000);
  CHECK(held.value().lost == 0);
  for (const auto& sample : held.value().samples) CHECK(sample.torque_Nm == Approx(1.5));
  WHEN("it changes in the middle of the next 100 ms") {
    const double start_s = bench.node.now_s();
    bench.node.wait_until(start_s + 0.05);
    bench.node.torque(-2000);
    bench.node.wait_until(start_s + 0.1);
    const auto block = bench.sensor.read();
    REQUIRE(block);
    REQUIRE(block.value().samples.size() == 100);
    THEN("the samples change where the frame came") {
      CHECK(block.value().samples[48].torque_Nm == Approx(1.5));
      CHECK(block.value().samples[51].torque_Nm == Approx(-2));
      CHECK(block.value().t0_s == Approx(start_s).margin(0.0011));
    }
  }
}

SCENARIO("a node that is not heard is lost, though its last value is known", "[hal][can]") {
  Bench bench;
  REQUIRE(bench.sensor.connect());
  bench.node.beats = false;
  bench.node.wait_until(bench.node.now_s() + 0.15);
  CHECK(bench.sensor.read());
  bench.node.wait_until(bench.node.now_s() + 0.15);
  const auto lost = bench.sensor.read();
  REQUIRE_FALSE(lost);
  CHECK(lost.error().code == IoErrc::timeout);
}

SCENARIO("what is measured while something else is going on is not a torque", "[hal][can]") {
  Bench bench;
  REQUIRE(bench.sensor.connect());
  WHEN("its shunt goes on, which it says once") {
    const double start_s = bench.node.now_s();
    bench.node.say(0x280, {0x04});
    THEN("no read is good until it has said that it is off, and those samples are lost") {
      for (int i = 1; i <= 3; ++i) {
        bench.node.wait_until(start_s + 0.05 * i);
        const auto read = bench.sensor.read();
        REQUIRE_FALSE(read);
        CHECK_THAT(read.error().where, Catch::Contains("shunt calibration is on"));
      }
      bench.node.say(0x280, {0x00});
      bench.node.wait_until(start_s + 0.2);
      CHECK_FALSE(bench.sensor.read());  // it was on in the first part of it
      bench.node.wait_until(start_s + 0.25);
      const auto after = bench.sensor.read();
      REQUIRE(after);
      CHECK(after.value().lost == Approx(200).margin(1));
    }
  }
  WHEN("it zeroes between two reads, and has a new zero before the second") {
    const double start_s = bench.node.now_s();
    bench.node.say(0x280, {0x01});
    bench.node.wait_until(start_s + 0.02);
    bench.node.torque(0);
    bench.node.say(0x280, {0x00});
    bench.node.wait_until(start_s + 0.05);
    const auto read = bench.sensor.read();
    REQUIRE_FALSE(read);
    CHECK_THAT(read.error().where, Catch::Contains("zeroing"));
    THEN("it is told once") {
      const auto after = bench.sensor.read();
      REQUIRE(after);
      CHECK(after.value().lost == Approx(50).margin(1));
    }
  }
  WHEN("it zeroes as it is connected") {
    bench.node.first_status = 0x01;
    CHECK(bench.sensor.connect().error().code == IoErrc::bad_reply);
    bench.node.first_status = 0x00;
    CHECK(bench.sensor.connect());
    CHECK(bench.sensor.read());
  }
  WHEN("a status says nothing") {
    bench.node.say(0x280, {});
    CHECK(bench.sensor.read().error().code == IoErrc::bad_reply);
    CHECK(bench.sensor.read());
  }
  WHEN("its shunt is on, or it zeroes") {
    bench.node.say(0x280, {0x04});
    CHECK(bench.sensor.read().error().code == IoErrc::bad_reply);
    bench.node.say(0x280, {0x01});
    CHECK(bench.sensor.read().error().code == IoErrc::bad_reply);
    THEN("it measures again once that is over") {
      bench.node.say(0x280, {0x00});
      CHECK_FALSE(bench.sensor.read());
      const double start_s = bench.node.now_s();
      bench.node.wait_until(start_s + 0.1);
      CHECK_FALSE(bench.sensor.read().value().samples.empty());
      bench.node.say(0x280, {0x04});
      bench.node.say(0x280, {0x00});
      bench.node.wait_until(start_s + 0.15);
      CHECK_FALSE(bench.sensor.read());
      bench.node.wait_until(start_s + 0.2);
      const auto after = bench.sensor.read();
      REQUIRE(after);
      CHECK(after.value().lost == Approx(50).margin(1));
      CHECK(std::isnan(after.value().samples[10].torque_Nm));
      CHECK(after.value().samples.back().torque_Nm == Approx(1.5));
      CHECK(after.value().samples.size() == Approx(100).margin(1));
    }
  }
  WHEN("it restarts") {
    bench.node.say(0x700, {0x00});
    const auto restarted = bench.sensor.read();
    REQUIRE_FALSE(restarted);
    CHECK(restarted.error().code == IoErrc::disconnected);
    THEN("nothing resumes by itself") {
      bench.node.torque(100);
      CHECK(bench.sensor.read().error().code == IoErrc::disconnected);
      CHECK(bench.sensor.connect());
      CHECK(bench.sensor.read());
    }
  }
  WHEN("a frame is cut short") {
    bench.node.say(0x180, {1, 2});
    CHECK(bench.sensor.read().error().code == IoErrc::bad_reply);
  }
}

TEST_CASE("a node that does not answer the start is not connected", "[hal][can]") {
  Node silent;
  silent.state = 0;
  auto bus = hal::make_in_process_bus([&] { return silent.now_s(); });
  hal::CanopenTorqueSensor sensor(std::move(bus.bench), {.node = node_id}, silent);
  const double start_s = silent.now_s();
  const auto connected = sensor.connect();
  REQUIRE_FALSE(connected);
  CHECK(connected.error().code == IoErrc::timeout);
  CHECK(silent.now_s() - start_s < 0.25);
  CHECK_FALSE(sensor.read());
}

TEST_CASE("nodes have numbers from 1 to 127", "[hal][can]") {
  Node node;
  const auto make = [&](hal::CanopenTorqueOptions options) {
    return hal::CanopenTorqueSensor(hal::make_in_process_bus([] { return 0.0; }).bench, options,
                                    node);
  };
  CHECK_THROWS_AS(make({.node = 0}), std::invalid_argument);
  CHECK_THROWS_AS(make({.node = 128}), std::invalid_argument);
  CHECK_THROWS_AS(make({.Nm_per_count = 0}), std::invalid_argument);
  CHECK(hal::CanopenTorqueSensor::ids(5) == std::vector<std::uint32_t>{0x185, 0x285, 0x705});
}
