#pragma once

#include <catch2/catch.hpp>
#include <cmath>

#include "hal/safety_inputs.hpp"

namespace rvbench::test {

/// What all SafetyInputs promise (see hal/safety_inputs.hpp). Call it within a test case of its
/// own, with inputs not yet connected, of a bench that is ready to run.
inline void check_safety_inputs_contract(hal::SafetyInputs& inputs) {
  SECTION("before connect, read reports a dead link instead of a safe state") {
    const auto status = inputs.read();
    REQUIRE_FALSE(status);
    CHECK(status.error().code == IoErrc::disconnected);
    CHECK_FALSE(status.error().where.empty());
  }
  SECTION("a bench that is ready says so") {
    REQUIRE(inputs.connect());
    const auto status = inputs.read();
    REQUIRE(status);
    CHECK_FALSE(status.value().estop_pressed);
    CHECK_FALSE(status.value().guard_open);
  }
  SECTION("unless told otherwise, the chain is open") {
    CHECK(hal::SafetyStatus{}.estop_pressed);
    CHECK(hal::SafetyStatus{}.guard_open);
    CHECK(std::isnan(hal::SafetyStatus{}.housing_temp_degC));
  }
}

}  // namespace rvbench::test
