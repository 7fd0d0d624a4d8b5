#include "hal/formats/start_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>

namespace rvbench::hal::formats {
namespace {

using namespace std::chrono;

constexpr std::string_view prefix = "started ";
constexpr std::array<std::string_view, 12> months = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                     "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
constexpr double earliest_s = -62135596800.0, latest_s = 253402300799.0;  // years 1 to 9999
constexpr double day_s = 86400;

struct Date {
  int year = 0;
  unsigned month = 0, day = 0;
  double of_day_s = 0;
};

std::optional<Date> date_of(double utc_s) {
  if (!(utc_s >= earliest_s && utc_s <= latest_s)) return std::nullopt;
  const double rounded_s = std::round(utc_s * 1e6) / 1e6;
  const double days_since = std::floor(rounded_s / day_s);
  const year_month_day day(sys_days(days(static_cast<int>(days_since))));
  return Date{int(day.year()), unsigned(day.month()), unsigned(day.day()),
              rounded_s - days_since * day_s};
}

double utc_of(const Date& date) {
  const year_month_day day{year(date.year), month(date.month), std::chrono::day(date.day)};
  if (!day.ok() || !(date.of_day_s >= 0 && date.of_day_s < day_s + 1)) return not_known;
  return static_cast<double>(sys_days(day).time_since_epoch().count()) * day_s + date.of_day_s;
}

// Takes a number of `digits` digits, and `behind` after it, off the text.
std::optional<int> take(std::string_view& text, std::size_t digits, std::string_view behind) {
  int value = 0;
  const std::string_view own = text.substr(0, digits);
  const auto [end, error] = std::from_chars(own.data(), own.data() + own.size(), value);
  if (own.size() != digits || error != std::errc() || end != own.data() + own.size() || value < 0) {
    return std::nullopt;
  }
  text.remove_prefix(digits);
  if (!text.starts_with(behind)) return std::nullopt;
  text.remove_prefix(behind.size());
  return value;
}

// "10:51:17.25"; nothing may follow.
std::optional<double> of_day_s(std::string_view text) {
  const auto hours = take(text, 2, ":"), minutes = take(text, 2, ":");
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  if (!hours || !minutes || !is_whole || *hours > 23 || *minutes > 59 || !(seconds >= 0) ||
      !(seconds < 61)) {
    return std::nullopt;
  }
  return *hours * 3600.0 + *minutes * 60.0 + seconds;
}

std::string clock_text(double of_day_s, int decimals) {
  const auto whole_s = static_cast<int>(of_day_s);
  const double seconds = of_day_s - whole_s + whole_s % 60;
  return fmt::format("{:02}:{:02}:{:0{}.{}f}", whole_s / 3600, whole_s / 60 % 60, seconds,
                     decimals > 0 ? decimals + 3 : 2, decimals);
}

}  // namespace

std::string utc_text(double utc_s) {
  const auto date = date_of(utc_s);
  if (!date) return "";
  return fmt::format("{:04}-{:02}-{:02}T{}Z", date->year, date->month, date->day,
                     clock_text(date->of_day_s, 6));
}

double utc_of_text(std::string_view text) {
  const auto year = take(text, 4, "-"), month = take(text, 2, "-"), day = take(text, 2, "T");
  if (!year || !month || !day || !text.ends_with('Z')) return not_known;
  text.remove_suffix(1);
  const auto of_day = of_day_s(text);
  if (!of_day) return not_known;
  return utc_of({*year, static_cast<unsigned>(*month), static_cast<unsigned>(*day), *of_day});
}

std::string uff_date(double utc_s) {
  const auto date = date_of(utc_s);
  if (!date) return "";
  const int decimals = date->of_day_s == std::floor(date->of_day_s) ? 0 : 6;
  return fmt::format("{:02}-{}-{:02} {}", date->day, months[date->month - 1], date->year % 100,
                     clock_text(date->of_day_s, decimals));
}

double utc_of_uff_date(std::string_view text) {
  const auto day = take(text, 2, "-");
  const auto month = std::ranges::find(months, text.substr(0, 3));
  if (!day || month == months.end()) return not_known;
  text.remove_prefix(std::min<std::size_t>(text.size(), 3));
  if (!text.starts_with('-')) return not_known;
  text.remove_prefix(1);
  const auto year = take(text, 2, " ");
  const auto of_day = of_day_s(text);
  if (!year || !of_day) return not_known;
  return utc_of({*year + (*year < 70 ? 2000 : 1900),
                 static_cast<unsigned>(month - months.begin()) + 1, static_cast<unsigned>(*day),
                 *of_day});
}

void note_start(double utc_s, Recording& recording) {
  const std::string text = utc_text(utc_s);
  if (!text.empty()) recording.notes.push_back(std::string(prefix) + text);
}

bool is_start_note(std::string_view note) { return note.starts_with(prefix); }

double noted_start_s(const Recording& recording) {
  for (const std::string& note : recording.notes) {
    if (is_start_note(note)) return utc_of_text(std::string_view(note).substr(prefix.size()));
  }
  return not_known;
}

}  // namespace rvbench::hal::formats
