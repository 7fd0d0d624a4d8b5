#include "hal/formats/uff_datasets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "hal/formats/fixed_columns.hpp"
#include "hal/formats/si_unit.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr int header_lines = 11;  // of data set 58

bool is_delimiter(std::string_view line) {
  return line.starts_with("    -1") && said_in(line.substr(6)).empty();
}

// "   151", "    58b     1     2 ..."; nothing else in the first six columns.
bool read_heading(std::string_view line, UffDataset& dataset) {
  const std::optional<int> number = columns(line, 0, 6).integer();
  if (!number || *number < 1) return false;
  dataset.number = *number;
  dataset.is_binary = line.size() > 6 && (line[6] == 'b' || line[6] == 'B');
  dataset.heading = line;
  return true;
}

// The bytes of header lines and binary data, as the heading declares, that are there.
std::size_t binary_length(const UffDataset& dataset, std::string_view rest) {
  const std::string_view all = rest;
  for (int i = 0; i < header_lines && !rest.empty(); ++i) take_line(rest);
  const auto declared = columns(dataset.heading, 31, 12).integer().value_or(0);
  const std::size_t header = all.size() - rest.size();
  return header + std::min(rest.size(), static_cast<std::size_t>(std::max(declared, 0)));
}

std::string_view kind_of(int number) {
  static const std::map<int, std::string_view> kinds = {
      {15, "geometry"},           {18, "geometry"},   {82, "geometry"},   {781, "geometry"},
      {780, "geometry"},          {2400, "geometry"}, {2411, "geometry"}, {2412, "geometry"},
      {2420, "geometry"},         {2467, "geometry"}, {2477, "geometry"}, {55, "results at nodes"},
      {2414, "results at nodes"}, {58, "functions"},  {151, "header"},    {164, "units"}};
  const auto found = kinds.find(number);
  return found == kinds.end() ? "others" : found->second;
}

}  // namespace

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool is_uff(std::string_view head) {
  while (!head.empty()) {
    const std::string_view line = take_line(head);
    if (said_in(line).empty()) continue;
    UffDataset dataset;
    return is_delimiter(line) && read_heading(take_line(head), dataset);
  }
  return false;
}

std::vector<UffDataset> uff_datasets(std::string_view bytes) {
  std::vector<UffDataset> datasets;
  std::size_t lines = 0;
  const auto next_line = [&] {
    ++lines;
    return take_line(bytes);
  };
  while (!bytes.empty()) {
    if (!is_delimiter(next_line())) continue;
    UffDataset dataset;
    const std::string_view heading = next_line();
    dataset.line = lines;
    if (!read_heading(heading, dataset)) continue;
    const std::string_view body = bytes;
    if (dataset.is_binary) {
      const std::string_view skipped = bytes.substr(0, binary_length(dataset, bytes));
      lines += static_cast<std::size_t>(std::count(skipped.begin(), skipped.end(), '\n'));
      bytes.remove_prefix(skipped.size());
    }
    std::size_t length = body.size() - bytes.size();
    while (!bytes.empty() && !dataset.is_closed) {
      dataset.is_closed = is_delimiter(next_line());
      if (!dataset.is_closed) length = body.size() - bytes.size();
    }
    dataset.body = body.substr(0, length);
    datasets.push_back(dataset);
  }
  return datasets;
}

std::string contents_of(const std::vector<UffDataset>& datasets) {
  std::map<std::string_view, std::set<int>> numbers;
  for (const UffDataset& dataset : datasets) {
    numbers[kind_of(dataset.number)].insert(dataset.number);
  }
  std::string text;
  for (const auto& [kind, of_kind] : numbers) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", kind, fmt::join(of_kind, ", "));
  }
  return text;
}

}  // namespace rvbench::hal::formats
