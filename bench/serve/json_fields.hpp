#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rvbench::bench {

/// The text under a key of a JSON object from outside; empty where there is none.
std::string text_at(const nlohmann::json& json, const char* key);

/// The truth under a key of a JSON object from outside; false where there is none.
bool flag_at(const nlohmann::json& json, const char* key);

}  // namespace rvbench::bench
