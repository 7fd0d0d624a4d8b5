#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace rvbench::bench {

/// A JSON document as files and standard output have it: indented by two, with a line's end. Names
/// out of foreign files need not be UTF-8: what is not is replaced, not thrown.
std::string json_text(const nlohmann::ordered_json& json);

/// The same in one line, without its end.
std::string json_line(const nlohmann::json& json);
std::string json_line(const nlohmann::ordered_json& json);

/// The same of ASCII alone, as where each byte counts for a hash.
std::string ascii_json_line(const nlohmann::json& json);
std::string ascii_json_line(const nlohmann::ordered_json& json);

/// Of an empty text, or no number, null: there is none.
nlohmann::ordered_json json_or_null(const std::string& text);
nlohmann::ordered_json json_or_null(const std::optional<double>& number);

}  // namespace rvbench::bench
