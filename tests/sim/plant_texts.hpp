#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "sim/plant_json.hpp"
#include "sim/simulate.hpp"

namespace rvbench::test {

/// The plant of a text without faults.
inline sim::PlantSpec plant_of(const std::string& text,
                               const sim::TermLibrary& library = sim::standard_terms()) {
  auto read = sim::parse_plant(hal::ConfigReader::from_text(text, "plant.json"), library);
  if (auto* faults = std::get_if<std::vector<hal::ConfigFault>>(&read)) {
    for (const auto& fault : *faults) UNSCOPED_INFO(describe("plant.json", fault));
    FAIL("the plant has faults");
  }
  return std::get<sim::PlantSpec>(std::move(read));
}

/// A mass of 2 kg on given terms, pushed by channel "u" in N, its position and speed seen.
inline std::string mass_on(const std::string& terms, const std::string& body = "",
                           const std::string& between = "hold") {
  return R"({"plant": "mass", "bodies": [{"name": "m", "motion": "translation", )" + body +
         R"("mass": {"value": 2, "unit": "kg"}}], "terms": [)" + terms +
         R"(], "inputs": [{"channel": "u", "unit": "N", "is": "force", "body": "m",
            "between_samples": ")" +
         between + R"("}],
          "outputs": [{"channel": "x", "unit": "m", "is": "position", "body": "m"},
                      {"channel": "v", "unit": "m/s", "is": "speed", "body": "m"}]})";
}

inline Channel channel_of(const std::string& name, const std::string& unit, double rate_Hz,
                          Eigen::VectorXd samples) {
  return {{name, unit, "", not_known}, rate_Hz, 0, std::move(samples)};
}

/// The outputs of a run that has no fault.
inline std::vector<Channel> run_of(const sim::PlantSpec& plant, const std::vector<Channel>& inputs,
                                   const sim::TermLibrary& library = sim::standard_terms()) {
  auto result = sim::simulate(plant, inputs, library);
  if (auto* fault = std::get_if<hal::ConfigFault>(&result)) {
    FAIL(fault->pointer << ": " << fault->message);
  }
  return std::get<sim::Simulated>(std::move(result)).channels;
}

}  // namespace rvbench::test
