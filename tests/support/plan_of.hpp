#pragma once

#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "sequences/plan.hpp"

namespace rvbench::test {

/// The plan of a text without faults. @throws std::logic_error that names all that it has
inline sequences::TestPlan plan_of(const std::string& text) {
  auto read = sequences::parse_plan(hal::ConfigReader::from_text(text, "plan.json"));
  if (const auto* faults = std::get_if<std::vector<hal::ConfigFault>>(&read)) {
    std::string all;
    for (const auto& fault : *faults) all += describe("plan.json", fault) + "\n";
    throw std::logic_error(all);
  }
  return std::get<sequences::TestPlan>(std::move(read));
}

}  // namespace rvbench::test
