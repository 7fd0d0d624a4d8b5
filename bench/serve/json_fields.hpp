#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rvbench::bench {

/// What may stand under a key of a request's body.
enum class FieldKind { text, truth, object, version };  ///< a version is a text or a whole number

using Fields = std::map<std::string, FieldKind>;

/// The object that a request's body is, {} of an empty one. Where it is no JSON, or holds a key twice,
/// in whatever object, it is no object.
nlohmann::json fields_of(const std::string& body);

/// The first key that is none of these, or holds something else; "" if there is none.
std::string misplaced_field(const nlohmann::json& body, const Fields& fields);

/// The text under a key of a JSON object from outside; empty where there is none.
std::string text_at(const nlohmann::json& json, const char* key);

/// The truth under a key of a JSON object from outside; false where there is none.
bool flag_at(const nlohmann::json& json, const char* key);

}  // namespace rvbench::bench
