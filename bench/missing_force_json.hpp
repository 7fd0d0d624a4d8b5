#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bench/missing_force.hpp"

namespace rvbench::bench {

/// As in explain.json; see README.md.
nlohmann::ordered_json missing_force_to_json(const MissingForce& missing);

}  // namespace rvbench::bench
