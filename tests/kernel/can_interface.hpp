#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "hal/steady_clock.hpp"
#include "tests/support/can_frames.hpp"

namespace rvbench::test {

inline void shell(const std::string& command) {
  INFO(command);
  REQUIRE(std::system(command.c_str()) == 0);
}

}  // namespace rvbench::test
