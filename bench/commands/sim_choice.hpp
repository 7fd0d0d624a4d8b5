#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "bench/command.hpp"
#include "bench/rig_factory.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {

/// Which unit is on the simulated bench, for the commands that run one.
class SimChoice {
 public:
  Option preset() {
    return {"--preset",
            "simulated unit: " + hal::listed(preset_names()) + "; default: " + RigOptions().preset,
            &preset_};
  }
  Option seed() {
    return {"--seed",
            fmt::format("of everything that the simulation draws; default: {}", RigOptions().seed),
            &seed_,
            false,
            {},
            max_seed};
  }
  Option severity() {
    return {"--severity", "of the preset's fault: 1 is the preset's own; default: drawn, 0.5 to 2",
            &severity_};
  }
  /// The options that were given, as they were typed; "" if none was.
  std::string stated() const {
    std::vector<std::string> names;
    if (!preset_.empty()) names.emplace_back("--preset");
    if (seed_) names.emplace_back("--seed");
    if (severity_) names.emplace_back("--severity");
    return hal::listed(names);
  }
  RigOptions rig_options() const {
    return {.preset = preset_.empty() ? RigOptions().preset : preset_,
            .seed = seed_.value_or(RigOptions().seed),
            .severity = severity_};
  }

 private:
  std::string preset_;
  std::optional<std::uint64_t> seed_;
  std::optional<double> severity_;
};

}  // namespace rvbench::bench
