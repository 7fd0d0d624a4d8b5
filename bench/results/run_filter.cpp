#include "bench/results/run_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>

namespace rvbench::bench {
namespace {

constexpr std::size_t date_digits = 8, time_digits = 14;
constexpr double seconds_per_day = 86400;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// "20261121114559" of a row's time; nothing of any other text.
std::optional<std::string> digits_of(std::string_view utc) {
  if (utc.size() < 16 || utc[8] != 'T' || utc[15] != 'Z') return std::nullopt;
  std::string digits(utc.substr(0, date_digits));
  digits += utc.substr(9, 6);
  if (!std::ranges::all_of(digits, is_digit)) return std::nullopt;
  return digits;
}

int number_at(std::string_view digits, std::size_t from, std::size_t count) {
  int number = 0;
  for (const char c : digits.substr(from, count)) number = 10 * number + (c - '0');
  return number;
}

std::optional<double> days_of_digits(std::string_view digits) {
  using namespace std::chrono;
  const year_month_day date{year(number_at(digits, 0, 4)), month(unsigned(number_at(digits, 4, 2))),
                            day(unsigned(number_at(digits, 6, 2)))};
  const int hours = number_at(digits, 8, 2), minutes = number_at(digits, 10, 2);
  const int seconds = number_at(digits, 12, 2);
  if (!date.ok() || hours > 23 || minutes > 59 || seconds > 60) return std::nullopt;
  return double(sys_days(date).time_since_epoch().count()) +
         (3600 * hours + 60 * minutes + seconds) / seconds_per_day;
}

}  // namespace

bool matches(const RunFilter& filter, const RunRow& row) {
  const auto asked = [](const std::string& wanted, const std::string& is) {
    return wanted.empty() || wanted == is;
  };
  const bool in_time = filter.from_utc.empty() && filter.to_utc.empty();
  if (!in_time && !digits_of(row.started_utc)) return false;
  // Of several runs in one second the names go on: "20261121T114559Z-2".
  const std::string started = row.started_utc.substr(0, 16);
  return asked(filter.serial, row.serial) && asked(filter.verdict, row.verdict) &&
         asked(filter.plan, row.plan) && (filter.from_utc.empty() || started >= filter.from_utc) &&
         (filter.to_utc.empty() || started <= filter.to_utc);
}

std::optional<std::string> utc_of_text(const std::string& text, bool last) {
  std::string digits;
  for (const char c : text) {
    if (is_digit(c)) {
      digits += c;
    } else if (std::string_view("-: TZ").find(c) == std::string_view::npos) {
      return std::nullopt;
    }
  }
  const bool is_whole = digits.size() == date_digits || digits.size() == 12;
  if (!is_whole && digits.size() != time_digits) return std::nullopt;
  const std::string_view rest = last ? "235959" : "000000";
  digits += rest.substr(rest.size() - (time_digits - digits.size()));
  if (!days_of_digits(digits)) return std::nullopt;
  return digits.substr(0, date_digits) + "T" + digits.substr(date_digits) + "Z";
}

std::string readable_utc(const std::string& utc) {
  const auto digits = digits_of(utc);
  if (!digits) return utc;
  return fmt::format("{}-{}-{} {}:{}:{}", digits->substr(0, 4), digits->substr(4, 2),
                     digits->substr(6, 2), digits->substr(8, 2), digits->substr(10, 2),
                     digits->substr(12, 2));
}

std::string iso_utc(const std::string& utc) {
  const std::string readable = readable_utc(utc);
  return readable == utc ? "" : readable.substr(0, 10) + "T" + readable.substr(11) + "Z";
}

std::optional<double> days_of_utc(const std::string& utc) {
  const auto digits = digits_of(utc);
  return digits ? days_of_digits(*digits) : std::nullopt;
}

}  // namespace rvbench::bench
