#include "bench/limits_file.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "bench/json_text.hpp"
#include "bench/sha256.hpp"
#include "hal/json_object.hpp"
#include "sequences/limits_json.hpp"

namespace rvbench::bench {

std::variant<LimitsFile, std::vector<hal::ConfigFault>> read_limits_file(
    const std::filesystem::path& file) {
  hal::ConfigReader root = hal::ConfigReader::from_file(file);
  LimitsFile limits;
  limits.version = root.text("limits_version");
  limits.plan = root.text("plan");
  for (hal::ConfigReader& json : root.objects("steps", false)) {
    LimitsStep step;
    step.step = json.choice("step", {"proposed", "approved", "activated"});
    step.utc = json.text("utc");
    step.by = json.text("by");
    step.limits_sha256 = json.text("limits_sha256");
    limits.steps.push_back(std::move(step));
  }
  limits.limits = sequences::parse_limits(root);
  root.finish();
  if (root.faults().empty() && limits.limits.empty()) root.fault("limits", "it limits nothing");
  if (!root.faults().empty()) return root.faults();
  return limits;
}

std::string limits_file_to_json(const LimitsFile& file) {
  auto steps = nlohmann::ordered_json::array();
  for (const LimitsStep& step : file.steps) {
    steps.push_back(hal::json_object({{"step", step.step},
                                      {"utc", step.utc},
                                      {"by", step.by},
                                      {"limits_sha256", step.limits_sha256}}));
  }
  const nlohmann::ordered_json json =
      hal::json_object({{"limits_version", file.version},
                        {"plan", file.plan},
                        {"steps", steps},
                        {"limits", parse_ordered_json(sequences::limits_to_json(file.limits))}});
  return json_text(json);
}

std::string limits_hash(const std::vector<sequences::Limit>& limits) {
  return sha256_of_text(sequences::limits_to_json(limits));
}

}  // namespace rvbench::bench
