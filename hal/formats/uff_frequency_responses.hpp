#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "hal/types/frequency_response.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal::formats {

/// The frequency responses of a universal file, each with the coherence of its degrees of freedom.
Result<std::vector<FrequencyResponse>> read_uff_frequency_responses(
    const std::filesystem::path& file, std::string_view bytes);

}  // namespace rvbench::hal::formats
