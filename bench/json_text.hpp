#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace rvbench::bench {

/// A JSON document as files and standard output have it: indented, with a line's end. Names
/// out of foreign files need not be UTF-8: what is not is replaced, not thrown.
///
/// These functions replace json.parse() and json.dump(): the parser takes two seconds to compile in
/// each file that calls it, the printer one. serve/json_fields parses with a callback of its own.
std::string json_text(const nlohmann::ordered_json& json, int indent = 2);

/// The same in one line, without its end.
std::string json_line(const nlohmann::json& json);
std::string json_line(const nlohmann::ordered_json& json);

/// The same of ASCII alone, as where each byte counts for a hash.
std::string ascii_json_line(const nlohmann::json& json);
std::string ascii_json_line(const nlohmann::ordered_json& json);

/// The value that a text holds. An ordered one keeps its keys in the text's order.
/// @throws nlohmann::json::parse_error if the text is not JSON
nlohmann::json parse_json(const std::string& text);
nlohmann::ordered_json parse_ordered_json(const std::string& text);

/// The same, but a discarded value if the text is not JSON.
nlohmann::json json_or_discarded(const std::string& text);
nlohmann::ordered_json ordered_json_or_discarded(const std::string& text);

/// Null if the text is empty or there is no number.
nlohmann::ordered_json json_or_null(const std::string& text);
nlohmann::ordered_json json_or_null(const std::optional<double>& number);

/// Null if the number is NaN or infinite.
nlohmann::ordered_json finite_or_null(double number);

}  // namespace rvbench::bench
