#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/config_reader.hpp"

namespace rvbench::hal {

/// One value of a JSON text that remembers the line it starts on.
struct JsonNode {
  enum class Kind { null, boolean, number, text, array, object };

  Kind kind = Kind::null;
  int line = 0;
  double number = 0;  ///< a number's value; 1 or 0 of a boolean
  std::string text;
  std::vector<JsonNode> items;    ///< of an array or object, in order of the text
  std::vector<std::string> keys;  ///< of an object: keys[i] names items[i], each once

  const JsonNode* find(std::string_view key) const;  ///< nullptr if there is none
};

struct JsonTree {
  JsonNode root;
  bool complete = false;            ///< false: the text is no JSON, or beyond the limits below
  std::vector<ConfigFault> faults;  ///< duplicate keys, and at most one that ended the reading
};

/// Limits  4 MiB of text, 64 levels, 10000 keys per object, 200 bytes per key
JsonTree parse_json_lines(std::string_view text);

/// "/main/0" and "a/b" → "/main/0/a~1b" (RFC 6901)
std::string json_pointer(const std::string& parent, std::string_view key);

inline constexpr std::size_t max_config_bytes = 4 << 20;

}  // namespace rvbench::hal
