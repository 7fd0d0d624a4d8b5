#include "hal/types/outcome.hpp"

#include <utility>

namespace rvbench {
namespace {

int gravity(const Ending& ending) noexcept {
  switch (exit_code(ending)) {
    case 40: return 6;
    case 60: return 5;
    case 50: return 4;
    case 30: return 3;
    case 20: return 2;
    case 10: return 1;
    default: return 0;
  }
}

}  // namespace

const char* to_string(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::pass: return "PASS";
    case Outcome::fail: return "FAIL";
    case Outcome::invalid: return "INVALID";
    case Outcome::error: return "ERROR";
    case Outcome::aborted: return "ABORTED";
  }
  return "ERROR";
}

const char* to_string(ErrorKind kind) noexcept {
  switch (kind) {
    case ErrorKind::none: return "none";
    case ErrorKind::device_lost: return "device_lost";
    case ErrorKind::safety_trip: return "safety_trip";
    case ErrorKind::not_qualified: return "not_qualified";
  }
  return "none";
}

int exit_code(const Ending& ending) noexcept {
  switch (ending.outcome) {
    case Outcome::pass: return 0;
    case Outcome::fail: return 10;
    case Outcome::invalid: return 20;
    case Outcome::aborted: return 50;
    case Outcome::error: break;
  }
  if (ending.error_kind == ErrorKind::safety_trip) return 40;
  if (ending.error_kind == ErrorKind::not_qualified) return 60;
  return 30;
}

Ending graver(Ending a, Ending b) noexcept {
  return gravity(b) > gravity(a) ? std::move(b) : std::move(a);
}

}  // namespace rvbench
