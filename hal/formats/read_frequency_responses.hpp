#pragma once

#include <filesystem>
#include <vector>

#include "hal/types/frequency_response.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

/// Reads the frequency responses that another program measured: universal files (UFF, data sets 58
/// and 58b of function type 4, with the coherences of type 6 that belong to them), and what LMS
/// Test.Lab exports as text.
///
/// Units    SI, whatever the file's: a note says what the values were multiplied by. Empty, with
///          a note, where the file does not state them or they are not known here
/// Values   NaN where the file has no number
/// Errors   "<file>: <place>: <what>": no frequency response in it (and what is instead), one that
///          is cut off, without phase, or whose frequencies rise unevenly; one at least otherwise
Result<std::vector<FrequencyResponse>> read_frequency_responses(const std::filesystem::path& file);

}  // namespace rvbench::hal
