#include "bench/results/rejudgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "bench/json_text.hpp"
#include "bench/verdict_json.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

constexpr std::string_view prefix = "rejudged-";
constexpr std::string_view suffix = ".json";

// 0 if it is the name of something else.
int number_in(std::string_view name) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return 0;
  name.remove_prefix(prefix.size());
  name.remove_suffix(suffix.size());
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? std::max(number, 0) : 0;
}

std::string name_of(int number) { return fmt::format("{}{}{}", prefix, number, suffix); }

std::vector<int> numbers_in(const std::filesystem::path& folder) {
  std::vector<int> numbers;
  std::error_code error;  // what cannot be read holds none
  using Entries = std::filesystem::directory_iterator;
  for (Entries entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const int number = number_in(entry->path().filename().string());
    if (number > 0) numbers.push_back(number);
  }
  std::ranges::sort(numbers);
  return numbers;
}

}  // namespace

std::string rejudgement_to_json(const Rejudgement& rejudgement) {
  auto json = parse_ordered_json(judgement_to_json(rejudgement.judgement));
  json["rejudged"] = hal::json_object({{"utc", rejudgement.judged_utc},
                                       {"limits_version", rejudgement.limits_version},
                                       {"limits_sha256", rejudgement.limits_sha256}});
  return json_text(json);
}

std::optional<Rejudgement> rejudgement_from_json(const std::string& text) {
  auto judgement = judgement_from_json(text);
  if (!judgement) return std::nullopt;
  try {
    const auto json = parse_json(text).at("rejudged");
    return Rejudgement{*std::move(judgement), json.at("utc"), json.at("limits_version"),
                       json.at("limits_sha256")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

std::vector<std::string> rejudgement_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const int number : numbers_in(folder)) names.push_back(name_of(number));
  return names;
}

std::string next_rejudgement_name(const std::filesystem::path& folder) {
  const std::vector<int> numbers = numbers_in(folder);
  return name_of(numbers.empty() ? 1 : numbers.back() + 1);
}

}  // namespace rvbench::bench
