#include "bench/hash_chain.hpp"

#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "bench/json_text.hpp"
#include "bench/sha256.hpp"

namespace rvbench::bench {
namespace {

constexpr std::string_view hash_key = ",\"hash\":\"";
constexpr std::string_view line_tail = "\"}";
constexpr std::size_t hash_digits = 64;
constexpr std::size_t tail_bytes = hash_key.size() + hash_digits + line_tail.size();

}  // namespace

const std::string chain_begin(hash_digits, '0');

std::string chained_line(nlohmann::ordered_json object, const std::string& previous) {
  object["previous"] = previous;
  std::string text = ascii_json_line(object);
  text.pop_back();  // its }
  const std::string hash = sha256_of_text(text);
  return std::move(text).append(hash_key).append(hash).append(line_tail);
}

std::string hash_of_line(const std::string& line) {
  const bool has_one = line.size() >= tail_bytes && line.ends_with(line_tail) &&
                       line.compare(line.size() - tail_bytes, hash_key.size(), hash_key) == 0;
  return has_one ? line.substr(line.size() - line_tail.size() - hash_digits, hash_digits) : "";
}

std::string chain_fault(const std::string& line, const std::string& previous) {
  const auto json = json_or_discarded(line);
  if (!json.is_object() || !json.contains("previous")) return "is no line of such a log";
  const std::string hash = hash_of_line(line);
  if (hash.empty()) return "has no hash at its end";
  if (sha256_of_text(line.substr(0, line.size() - tail_bytes)) != hash) {
    return "was changed: it does not match its hash";
  }
  if (json["previous"] != previous) {
    return "does not follow the line before: one was taken out, put in or moved";
  }
  return "";
}

}  // namespace rvbench::bench
