#include "sim/can_bridge.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <optional>
#include <thread>

#include "hal/can/in_process_transport.hpp"

using namespace rvbench;

namespace {

hal::InProcessBus make_bus() {
  return hal::make_in_process_bus([] { return 0.0; });
}

// The next frame, that comes from another thread; nothing after two seconds.
std::optional<std::uint32_t> next_id(hal::CanTransport& bus) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  while (std::chrono::steady_clock::now() < end) {
    if (const auto frame = bus.receive()) return frame.value().id;
    std::this_thread::yield();
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("a bridge hands frames on both ways, in their order", "[sim][can]") {
  const hal::InProcessBus left = make_bus(), right = make_bus();
  {
    const sim::CanBridge bridge(*left.nodes, *right.nodes);
    for (const std::uint32_t id : {0x181U, 0x281U, 0x181U}) REQUIRE(left.bench->send({.id = id}));
    REQUIRE(right.bench->send({.id = 0x201}));
    CHECK(next_id(*right.bench) == 0x181);
    CHECK(next_id(*right.bench) == 0x281);
    CHECK(next_id(*right.bench) == 0x181);
    CHECK(next_id(*left.bench) == 0x201);
  }
  REQUIRE(left.bench->send({.id = 1}));
  CHECK_FALSE(right.bench->receive());  // nobody is there any more
}
