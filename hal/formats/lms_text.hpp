#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "hal/types/frequency_response.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal::formats {

/// Whether bytes that begin so are a function that LMS Test.Lab wrote as text: lines of a key, a
/// tabulator and a value, among them "X axis quantity" or "Number of lines".
bool is_lms_text(std::string_view head);

/// The frequency response of such a file. Needs "Function class" FRF, or a "Y axis quantity" that
/// is one over another, and complex values.
Result<std::vector<FrequencyResponse>> read_lms_frequency_response(
    const std::filesystem::path& file, std::string_view bytes);

}  // namespace rvbench::hal::formats
