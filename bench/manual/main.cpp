// Writes what is made of the commands while rvbench is built:
//   rvbench_manual man 2026-11-26 >rvbench.1
//   rvbench_manual bash >rvbench

#include <iostream>
#include <string>

#include "bench/command.hpp"
#include "bench/file_kind.hpp"
#include "bench/kinematics_files.hpp"
#include "bench/manual/bash_completion.hpp"
#include "bench/manual/man_page.hpp"
#include "bench/plan_files.hpp"
#include "bench/rig_factory.hpp"
#include "bench/software_version.hpp"

namespace {

using namespace rvbench::bench;

BuiltInValues built_in_values() {
  return {{"PLAN", names_of(plan_files())},
          {"--plan", names_of(plan_files())},
          {"--kinematics", names_of(kinematics_files())},
          {"--preset", preset_names()},
          {"--rig", {"sim"}}};
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "man" && argc == 3) {
    std::cout << man_page(make_commands(), software_version(), argv[2]);
  } else if (what == "bash" && argc == 2) {
    std::cout << bash_completion(make_commands(), built_in_values());
  } else {
    std::cerr << "usage: rvbench_manual man DATE | rvbench_manual bash\n";
    return exit_codes::usage;
  }
  return std::cout.flush() ? exit_codes::done : exit_codes::internal_error;
}
