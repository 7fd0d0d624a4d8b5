#include "sim/can_bridge.hpp"

#include <catch2/catch.hpp>
#include <optional>

#include "hal/can/in_process_transport.hpp"
#include "tests/support/can_frames.hpp"

using namespace rvbench;

namespace {

hal::InProcessBus make_bus() {
  return hal::make_in_process_bus([] { return 0.0; });
}

// The next frame, that comes from another thread; nothing if none does.
std::optional<std::uint32_t> next_id(hal::CanTransport& bus) {
  const auto frame = test::next(bus);
  return frame ? std::optional(frame.value().id) : std::nullopt;
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
