#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "sequences/plan.hpp"

namespace rvbench::test {

/// The plan of a text without faults.
inline sequences::TestPlan plan_of(const std::string& text) {
  auto read = sequences::parse_plan(hal::ConfigReader::from_text(text, "plan.json"));
  if (auto* faults = std::get_if<std::vector<hal::ConfigFault>>(&read)) {
    for (const auto& fault : *faults) UNSCOPED_INFO(describe("plan.json", fault));
    FAIL("the plan has faults");
  }
  return std::get<sequences::TestPlan>(std::move(read));
}

}  // namespace rvbench::test
