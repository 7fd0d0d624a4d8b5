#include "hal/did_you_mean.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

namespace rvbench::hal {
namespace {

constexpr std::size_t longest_shown = 60;

// Levenshtein's distance: single-letter changes that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string did_you_mean(std::string_view wrong, const std::vector<std::string>& words) {
  std::string nearest;
  std::size_t best = std::max<std::size_t>(2, wrong.size() / 3) + 1;
  for (const std::string& word : words) {
    const std::size_t distance = edit_distance(wrong, word);
    if (distance < best && distance < wrong.size()) {
      best = distance;
      nearest = word;
    }
  }
  return nearest.empty() ? "" : ", did you mean " + in_quotes(nearest) + "?";
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string what_there_is(std::string_view wrong, const std::vector<std::string>& names) {
  if (names.empty()) return " (there is none)";
  return " (there are: " + listed(names) + ")" + did_you_mean(wrong, names);
}

std::string in_quotes(std::string_view text) {
  std::string cut(text.substr(0, longest_shown));
  if (text.size() > longest_shown) cut += "...";
  return nlohmann::json(cut).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace rvbench::hal
