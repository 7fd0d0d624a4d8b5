#include "bench/find_plan.hpp"

#include "bench/plan_files.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {

std::variant<sequences::TestPlan, std::vector<hal::ConfigFault>> find_plan(
    const std::string& name_or_path) {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : plan_files()) {
    if (file.name == name_or_path) {
      return sequences::parse_plan(hal::ConfigReader::from_text(file.text, file.name + ".json"));
    }
    names.push_back(file.name);
  }
  if (!std::filesystem::exists(name_or_path)) {
    return std::vector<hal::ConfigFault>{
        {0, "", "no such file or built-in plan" + hal::did_you_mean(name_or_path, names)}};
  }
  return sequences::read_plan(name_or_path);
}

}  // namespace rvbench::bench
