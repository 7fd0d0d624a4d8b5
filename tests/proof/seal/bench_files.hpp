#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/proof/seal/bench_campaign.hpp"

namespace seal {

/// The bench as its drawing has it: the plant that rvbench ships, with an error of its meshes that
/// is known to a half and makes their lines the strongest.
nlohmann::json bench_drawing(const std::filesystem::path& plants);

/// Writes recordings as rvbench documents them.
/// @throws std::runtime_error
void write_recording(const std::filesystem::path& file, const std::vector<BenchRecord>& records);

}  // namespace seal
