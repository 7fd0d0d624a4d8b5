#include "hal/json_object.hpp"

#include <string>
#include <utility>

namespace rvbench::hal {

nlohmann::ordered_json json_object(std::span<JsonField> fields) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (JsonField& field : fields) object.emplace(std::string(field.key), std::move(field.value));
  return object;
}

}  // namespace rvbench::hal
