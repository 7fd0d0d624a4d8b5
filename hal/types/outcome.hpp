#pragma once

#include <array>
#include <string>

namespace rvbench {

/// The words of the verdict. FAIL means the unit is bad; ERROR means the bench is at fault.
enum class Outcome { pass, fail, invalid, error, aborted };
inline constexpr std::array all_outcomes{Outcome::pass, Outcome::fail, Outcome::invalid,
                                         Outcome::error, Outcome::aborted};

/// What kind of ERROR: decides the exit code, and what the operator is told to do next.
enum class ErrorKind {
  none,
  device_lost,   ///< a device is silent, frozen or late
  safety_trip,   ///< a fresh value beyond an interlock, E-stop, guard
  not_qualified  ///< the station may not judge (calibration, golden unit)
};

/// How a run ended. An ending that was never set is an error: an absent answer is no PASS.
struct Ending {
  Outcome outcome = Outcome::error;
  ErrorKind error_kind = ErrorKind::device_lost;
  std::string reason = "the run did not end";  ///< one sentence, for the operator
};

const char* to_string(Outcome outcome) noexcept;  ///< "PASS", "FAIL", ...
const char* to_string(ErrorKind kind) noexcept;   ///< "device_lost", "safety_trip", ...

/// 0 PASS, 10 FAIL, 20 INVALID, 30 ERROR, 40 safety trip, 50 aborted, 60 not qualified.
int exit_code(const Ending& ending) noexcept;

/// The graver of two endings, in the order 40 > 60 > 50 > 30 > 20 > 10 > 0.
Ending graver(Ending a, Ending b) noexcept;

}  // namespace rvbench
