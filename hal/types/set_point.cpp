#include "hal/types/set_point.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rvbench {
namespace {

// Plans and recordings state the same decimal; a file of another program may hold it as a float.
constexpr double same_share = 1e-6;

bool is_same(double a, double b) {
  return std::abs(a - b) <= same_share * std::fmax(1, std::abs(b));
}

bool meets(const std::optional<double>& wanted, double is) {
  return !wanted || is_same(is, *wanted);
}

bool can_meet(const std::optional<double>& a, const std::optional<double>& b) {
  return !a || !b || is_same(*a, *b);
}

}  // namespace

bool SetPoint::includes(double planned_speed_rpm, double planned_load_pct) const {
  return meets(speed_rpm, planned_speed_rpm) && meets(load_pct, planned_load_pct);
}

bool covers(const SetPoint& whole, const SetPoint& part) {
  return overlap(whole, part) && (!whole.speed_rpm || part.speed_rpm) &&
         (!whole.load_pct || part.load_pct);
}

bool overlap(const SetPoint& a, const SetPoint& b) {
  return can_meet(a.speed_rpm, b.speed_rpm) && can_meet(a.load_pct, b.load_pct);
}

std::string text_of(const SetPoint& at) {
  std::string text;
  if (at.speed_rpm) text = fmt::format("{:g} rpm", *at.speed_rpm);
  if (at.load_pct) text += fmt::format("{}{:g} % load", text.empty() ? "" : ", ", *at.load_pct);
  return text;
}

std::string at_text(const SetPoint& at) { return at.is_any() ? "" : " at " + text_of(at); }

}  // namespace rvbench
