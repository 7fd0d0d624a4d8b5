#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/formats/read_recordings.hpp"
#include "tests/fuzz/scratch_file.hpp"

namespace rvbench::test {

/// Reads the bytes as a file: it is refused with a reason, or each recording has a status and
/// channels.
inline void read_file_of(const ScratchFile& file, const std::uint8_t* data, std::size_t size) {
  const auto recordings = hal::read_recordings(file.holding(data, size));
  if (!recordings) {
    must(!recordings.error().where.empty());
    return;
  }
  for (const Recording& recording : recordings.value()) {
    must(!recording.status.empty() && !recording.channels.empty());
  }
}

}  // namespace rvbench::test
