#include "bench/fault_lines.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "bench/text_file.hpp"
#include "hal/json_lines.hpp"

namespace rvbench::bench {
namespace {

const hal::JsonNode* child_of(const hal::JsonNode& node, std::string_view key) {
  if (node.kind != hal::JsonNode::Kind::array) return node.find(key);
  std::size_t index = 0;
  const auto [stop, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  const bool is_index = error == std::errc() && stop == key.data() + key.size();
  return is_index && index < node.items.size() ? &node.items[index] : nullptr;
}

// Keys with '/' or '~' in them are no keys of ours: their faults are told at what holds them.
int line_of(const hal::JsonNode& root, std::string_view pointer) {
  const hal::JsonNode* node = &root;
  int line = root.line;
  while (node != nullptr && pointer.starts_with('/')) {
    pointer.remove_prefix(1);
    const std::string_view key = pointer.substr(0, pointer.find('/'));
    pointer.remove_prefix(key.size());
    node = child_of(*node, key);
    if (node != nullptr) line = node->line;
  }
  return line;
}

}  // namespace

std::vector<hal::ConfigFault> with_lines(const std::filesystem::path& file,
                                         std::vector<hal::ConfigFault> faults) {
  std::error_code ignored;
  const auto text =
      std::filesystem::is_regular_file(file, ignored) ? read_file(file) : std::nullopt;
  if (!text) return faults;
  const hal::JsonTree tree = hal::parse_json_lines(*text);
  if (!tree.complete) return faults;
  for (hal::ConfigFault& fault : faults) {
    if (fault.line == 0) fault.line = line_of(tree.root, fault.pointer);
  }
  std::ranges::stable_sort(faults, {}, &hal::ConfigFault::line);
  return faults;
}

}  // namespace rvbench::bench
