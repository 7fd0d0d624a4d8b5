#include "bench/commands/table_words.hpp"

#include <array>
#include <utility>

namespace rvbench::bench {
namespace {

using hal::formats::DateOrder;

constexpr std::array<std::pair<const char*, char>, 4> separators = {
    {{"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}, {"blank", ' '}}};

}  // namespace

void TableWords::add_to(std::vector<Option>& options) {
  constexpr std::uint64_t last_line = 4000;  // that a head is looked for in
  options.push_back({"--head-line",
                     "line of a table's names; default: found",
                     &head_line_,
                     false,
                     {},
                     last_line,
                     1});
  Option separator{"--separator", "what parts a table's cells; default: found", &separator_};
  for (const auto& [word, mark] : separators) separator.choices.emplace_back(word);
  options.push_back(std::move(separator));
  options.push_back({"--decimal",
                     "decimal mark of a table; default: found",
                     &decimal_,
                     false,
                     {"point", "comma"}});
  options.push_back({"--dates",
                     "order in 01/02/2026; default: found",
                     &dates_,
                     false,
                     {"day-month", "month-day"}});
}

hal::formats::TableHints TableWords::hints() const {
  hal::formats::TableHints hints;
  hints.head_line = static_cast<std::size_t>(head_line_.value_or(0));
  for (const auto& [word, mark] : separators) {
    if (separator_ == word) hints.separator = mark;
  }
  if (!decimal_.empty()) hints.decimal = decimal_ == "point" ? '.' : ',';
  if (!dates_.empty()) {
    hints.dates = dates_ == "day-month" ? DateOrder::day_month : DateOrder::month_day;
  }
  return hints;
}

}  // namespace rvbench::bench
