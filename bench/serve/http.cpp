#include "bench/serve/http.hpp"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

namespace rvbench::bench {

HttpAnswer json_answer(int status, const nlohmann::json& json) {
  return {.status = status,
          .body = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"};
}

HttpAnswer refusal(int status, const std::string& word) {
  return {.status = status, .body = "{\"error\":\"" + word + "\"}\n"};
}

HttpAnswer wrong_field(const std::string& name) {
  return json_answer(400, {{"error", "field"}, {"field", name}});
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

HostAndPort host_and_port(const std::string& text) {
  const std::size_t bracket = text.starts_with('[') ? text.find(']') : std::string::npos;
  const std::size_t colon = text.find(':', bracket == std::string::npos ? 0 : bracket);
  const std::string host = text.substr(0, colon);
  return {bracket == std::string::npos ? host : host.substr(1, bracket - 1),
          colon == std::string::npos ? "" : text.substr(colon + 1)};
}

}  // namespace rvbench::bench
