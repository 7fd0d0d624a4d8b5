#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "bench/command.hpp"
#include "bench/file_kind.hpp"
#include "bench/rig_factory.hpp"

namespace rvbench::bench {

/// Which unit is on the simulated bench, for the commands that run one.
class SimChoice {
 public:
  Option preset() {
    return {"--preset", "simulated unit: " + listed(preset_names()) + "; default: " + preset_,
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
  RigOptions rig_options() const {
    return {.preset = preset_, .seed = seed_.value_or(RigOptions().seed)};
  }

 private:
  std::string preset_ = RigOptions().preset;
  std::optional<std::uint64_t> seed_;
};

}  // namespace rvbench::bench
