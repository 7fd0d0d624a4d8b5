#pragma once

#include <exception>
#include <string>

#include "hal/types/outcome.hpp"

namespace rvbench::sequences {

/// What went wrong may be that there is no memory left.
inline Ending internal_error(const char* what) noexcept {
  try {
    return {Outcome::error, ErrorKind::none, std::string("internal error: ") + what};
  } catch (...) {
    // A text as short as this one needs no memory of its own.
    return {Outcome::error, ErrorKind::none, "no memory left"};
  }
}

/// The only place on the run path where exceptions end. None comes out, and none comes before: a
/// std::function would ask for memory.
/// @param work  returns an Ending
template <typename Work>
Ending guarded(const Work& work) noexcept {
  try {
    return work();
  } catch (const std::exception& exception) {
    return internal_error(exception.what());
  } catch (...) {
    return internal_error("of unknown kind");
  }
}

}  // namespace rvbench::sequences
