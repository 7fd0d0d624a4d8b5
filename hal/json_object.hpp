#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

namespace rvbench::hal {

/// A key of a JSON object with its value.
struct JsonField {
  std::string_view key;
  nlohmann::ordered_json value;
};

/// The object of these fields, which it moves from.
nlohmann::ordered_json json_object(std::span<JsonField> fields);

/// json_object({{"speed_rpm", 1500}, {"torque_Nm", nullptr}}): a list of nlohmann's own takes ten
/// times as long to compile, for there each length of a key is a type of its own.
template <std::size_t count>
nlohmann::ordered_json json_object(JsonField (&&fields)[count]) {
  return json_object(std::span<JsonField>(fields));
}

}  // namespace rvbench::hal
