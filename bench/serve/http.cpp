#include "bench/serve/http.hpp"

#include <nlohmann/json.hpp>

#include "bench/json_text.hpp"

namespace rvbench::bench {

HttpAnswer json_answer(int status, const nlohmann::json& json) {
  return {.status = status, .body = json_line(json) + "\n"};
}

HttpAnswer refusal(int status, const std::string& word) {
  return {.status = status, .body = "{\"error\":\"" + word + "\"}\n"};
}

HttpAnswer wrong_field(const std::string& name) {
  return json_answer(400, {{"error", "field"}, {"field", name}});
}

std::string wrong_parameter(const HttpRequest& request, const Parameters& parameters) {
  for (const auto& [name, value] : request.query) {
    const auto known = parameters.find(name);
    if (known == parameters.end() || !(value.empty() || known->second(value))) return name;
  }
  return "";
}

HostAndPort host_and_port(const std::string& text) {
  const std::size_t bracket = text.starts_with('[') ? text.find(']') : std::string::npos;
  const std::size_t colon = text.find(':', bracket == std::string::npos ? 0 : bracket);
  const std::string host = text.substr(0, colon);
  return {bracket == std::string::npos ? host : host.substr(1, bracket - 1),
          colon == std::string::npos ? "" : text.substr(colon + 1)};
}

}  // namespace rvbench::bench
