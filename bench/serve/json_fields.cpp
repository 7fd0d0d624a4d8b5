#include "bench/serve/json_fields.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

namespace rvbench::bench {
namespace {

bool is_of(FieldKind kind, const nlohmann::json& value) {
  switch (kind) {
    case FieldKind::text: return value.is_string();
    case FieldKind::truth: return value.is_boolean();
    case FieldKind::object: return value.is_object();
    case FieldKind::version: return value.is_string() || value.is_number_integer();
  }
  return false;
}

}  // namespace

nlohmann::json fields_of(const std::string& body) {
  if (body.empty()) return nlohmann::json::object();
  bool is_twice = false;
  std::vector<std::set<std::string>> names;  // of each object that is not at its end
  const auto note = [&](int, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    using Event = nlohmann::json::parse_event_t;
    if (event == Event::object_start) names.emplace_back();
    if (event == Event::object_end) names.pop_back();
    if (event == Event::key && !names.back().insert(parsed.get<std::string>()).second) {
      is_twice = true;
    }
    return true;
  };
  auto json = nlohmann::json::parse(body, note, false);
  return is_twice ? nlohmann::json(nullptr) : json;
}

std::string misplaced_field(const nlohmann::json& body, const Fields& fields) {
  for (const auto& [key, value] : body.items()) {
    const auto field = fields.find(key);
    if (field == fields.end() || !is_of(field->second, value)) return key;
  }
  return "";
}

std::string text_at(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

bool flag_at(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_boolean() && found->get<bool>();
}

}  // namespace rvbench::bench
