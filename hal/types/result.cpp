#include "hal/types/result.hpp"

namespace rvbench {

const char* to_string(IoErrc code) noexcept {
  switch (code) {
    case IoErrc::timeout: return "timeout";
    case IoErrc::disconnected: return "disconnected";
    case IoErrc::bad_reply: return "bad reply";
    case IoErrc::refused: return "refused";
    case IoErrc::stale: return "stale value";
    case IoErrc::overrun: return "overrun";
    case IoErrc::bad_data: return "bad data";
  }
  return "unknown";
}

std::string describe(const IoError& error) { return error.where + ": " + to_string(error.code); }

}  // namespace rvbench
