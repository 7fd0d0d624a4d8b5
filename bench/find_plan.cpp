#include "bench/find_plan.hpp"

#include "bench/file_kind.hpp"
#include "bench/plan_files.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {

std::variant<sequences::TestPlan, std::vector<hal::ConfigFault>> find_plan(
    const std::string& name_or_path) {
  using Faults = std::vector<hal::ConfigFault>;
  for (const EmbeddedFile& file : plan_files()) {
    if (file.name == name_or_path) {
      return sequences::parse_plan(hal::ConfigReader::from_text(file.text, file.name + ".json"));
    }
  }
  if (is_absent(name_or_path)) {
    return Faults{{0, "",
                   "no such file or built-in plan" +
                       hal::what_there_is(name_or_path, names_of(plan_files()))}};
  }
  hal::ConfigReader root = hal::ConfigReader::from_file(name_or_path);
  if (auto fault = other_kind_fault(root, "plan")) return Faults{*fault};
  return sequences::parse_plan(std::move(root));
}

}  // namespace rvbench::bench
