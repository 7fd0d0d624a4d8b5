#include "hal/formats/table/clock_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>

#include "hal/formats/table/text.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {
namespace {

using namespace std::chrono;

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t day_ns = 86400 * second_ns;
constexpr std::array<std::string_view, 12> month_names = {"jan", "feb", "mar", "apr", "may", "jun",
                                                          "jul", "aug", "sep", "oct", "nov", "dec"};

// Takes one to `most` digits off the text.
std::optional<int> take_number(std::string_view& text, std::size_t most) {
  std::size_t count = 0;
  int value = 0;
  while (count < std::min(most, text.size()) &&
         std::isdigit(static_cast<unsigned char>(text[count])) != 0) {
    value = 10 * value + (text[count] - '0');
    ++count;
  }
  if (count == 0) return std::nullopt;
  text.remove_prefix(count);
  return value;
}

std::optional<int> take_month(std::string_view& text) {
  const std::string name = lower_case(text.substr(0, 3));
  const auto found = std::ranges::find(month_names, name);
  if (found == month_names.end()) return std::nullopt;
  text.remove_prefix(3);
  return static_cast<int>(found - month_names.begin()) + 1;
}

bool take_mark(std::string_view& text, char mark) {
  if (!text.starts_with(mark)) return false;
  text.remove_prefix(1);
  return true;
}

// Takes a date off the text; leaves both as they are if there is none.
void take_date(std::string_view& text, ClockReading& reading) {
  std::string_view rest = text;
  const auto first = take_number(rest, 4);
  if (!first || rest.empty()) return;
  const char mark = rest.front();
  if (mark != '-' && mark != '.' && mark != '/' && mark != ' ') return;
  rest.remove_prefix(1);
  const auto named = take_month(rest);  // of "31-Dec-2026"
  const auto second = named ? named : take_number(rest, 2);
  if (!second || !take_mark(rest, mark) || (mark == ' ' && !named)) return;
  const auto third = take_number(rest, 4);
  const bool is_year_first = *first > 31;
  if (!third) return;
  reading.date = {*first, *second, *third};
  reading.year_first = is_year_first;
  reading.month_named = named.has_value();
  text = rest;
}

// The decimals of a second, to the nanosecond.
std::int64_t take_decimals(std::string_view& text) {
  std::int64_t ns = 0, scale = second_ns / 10;
  while (!text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) != 0) {
    ns += scale * (text.front() - '0');
    scale /= 10;
    text.remove_prefix(1);
  }
  return ns;
}

// Takes a time of day off the text.
std::optional<std::int64_t> take_time(std::string_view& text) {
  std::string_view rest = text;
  auto hours = take_number(rest, 2);
  if (!hours || !take_mark(rest, ':')) return std::nullopt;
  const auto minutes = take_number(rest, 2);
  if (!minutes) return std::nullopt;
  std::optional<int> seconds = 0;
  std::int64_t ns = 0;
  if (take_mark(rest, ':')) {
    seconds = take_number(rest, 2);
    if (seconds && (take_mark(rest, '.') || take_mark(rest, ','))) ns = take_decimals(rest);
  }
  if (!seconds || *hours > 24 || *minutes > 59 || *seconds > 60) return std::nullopt;
  std::string_view half = rest;
  take_mark(half, ' ');
  const auto is = [&](char a, char b) {
    return half.size() >= 2 && (half[0] == a || half[0] == b) && (half[1] == 'M' || half[1] == 'm');
  };
  const bool before_noon = is('A', 'a'), after_noon = is('P', 'p');
  if (before_noon || after_noon) {
    hours = *hours % 12 + (after_noon ? 12 : 0);
    rest = half.substr(2);
  }
  text = rest;
  return (*hours * 3600 + *minutes * 60 + *seconds) * second_ns + ns;
}

// "Z", "+01:00", "-0500", " UTC"
bool is_zone(std::string_view text) {
  if (text.empty() || text == "Z" || text == " UTC" || text == " GMT") return true;
  if (text.size() < 3 || (text.front() != '+' && text.front() != '-')) return false;
  return std::ranges::all_of(text.substr(1),
                             [](unsigned char c) { return std::isdigit(c) != 0 || c == ':'; });
}

std::optional<std::int64_t> days_since_epoch(int year_number, int month_number, int day_number) {
  const int whole_year =
      year_number >= 100 ? year_number : year_number + (year_number < 70 ? 2000 : 1900);
  const year_month_day date{year(whole_year), month(static_cast<unsigned>(month_number)),
                            day(static_cast<unsigned>(day_number))};
  if (!date.ok()) return std::nullopt;
  return sys_days(date).time_since_epoch().count();
}

}  // namespace

std::optional<ClockReading> clock_in(std::string_view cell) {
  if (cell.size() < 4 || std::isdigit(static_cast<unsigned char>(cell.front())) == 0)
    return std::nullopt;
  ClockReading reading;
  take_date(cell, reading);
  if (reading.date && cell.empty()) return reading;
  if (reading.date) {
    if (!take_mark(cell, 'T') && !take_mark(cell, ' ')) return std::nullopt;
    while (take_mark(cell, ' ')) {
    }
  }
  reading.of_day_ns = take_time(cell);
  if (!reading.of_day_ns || !is_zone(cell)) return std::nullopt;
  return reading;
}

void ClockRows::add(const ClockReading& date, const ClockReading& time) {
  if (date.date) dates_.push_back(*date.date);
  of_day_ns_.push_back(time.of_day_ns.value_or(0));
  year_first_ = year_first_ || date.year_first;
  month_named_ = month_named_ || date.month_named;
}

std::variant<DateOrder, std::string> ClockRows::order(DateOrder stated) const {
  if (year_first_ || month_named_ || stated != DateOrder::not_stated) return stated;
  const auto above_12 = [&](std::size_t i) {
    return std::ranges::any_of(dates_, [i](const auto& date) { return date[i] > 12; });
  };
  if (above_12(0)) return DateOrder::day_month;
  if (above_12(1)) return DateOrder::month_day;
  const auto& [a, b, c] = dates_.front();
  if (a == b && std::ranges::all_of(dates_, [&](const auto& date) { return date == dates_[0]; })) {
    return DateOrder::day_month;
  }
  return fmt::format(
      "the date {:02}/{:02}/{} is {} {} or {} {}: state --dates day-month or --dates month-day", a,
      b, c, a, month_names[static_cast<std::size_t>(b) - 1], b,
      month_names[static_cast<std::size_t>(a) - 1]);
}

std::variant<ClockRows::Times, std::string> ClockRows::times(DateOrder stated) const {
  DateOrder by = stated;
  if (!dates_.empty()) {
    const auto found = order(stated);
    if (const auto* fault = std::get_if<std::string>(&found)) return *fault;
    by = std::get<DateOrder>(found);
  }
  const auto days_of = [&](const std::array<int, 3>& d) {
    if (year_first_) return days_since_epoch(d[0], d[1], d[2]);
    return by == DateOrder::month_day ? days_since_epoch(d[2], d[0], d[1])
                                      : days_since_epoch(d[2], d[1], d[0]);
  };
  Times result{Eigen::VectorXd(std::ssize(of_day_ns_)), not_known};
  std::int64_t first_ns = 0, before_ns = 0, midnights_ns = 0;
  for (std::size_t i = 0; i < of_day_ns_.size(); ++i) {
    std::int64_t at_ns = of_day_ns_[i] + midnights_ns;
    if (!dates_.empty()) {
      const auto days = days_of(dates_[i]);
      if (!days) {
        return fmt::format("there is no date {:02}, {:02}, {}", dates_[i][0], dates_[i][1],
                           dates_[i][2]);
      }
      at_ns = of_day_ns_[i] + *days * day_ns;
    } else if (i > 0 && at_ns + day_ns / 2 < before_ns) {
      midnights_ns += day_ns;
      at_ns += day_ns;
    }
    if (i == 0) first_ns = at_ns;
    before_ns = at_ns;
    result.since_first_s[static_cast<Eigen::Index>(i)] =
        1e-9 * static_cast<double>(at_ns - first_ns);
  }
  if (!dates_.empty()) result.start_utc_s = 1e-9 * static_cast<double>(first_ns);
  return result;
}

}  // namespace rvbench::hal::formats
