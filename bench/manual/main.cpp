// Writes what is made of the commands while rvbench is built:
//   rvbench_manual man 2026-11-26 >rvbench.1
//   rvbench_manual bash >rvbench

#include <iostream>
#include <string>

#include "bench/command.hpp"
#include "bench/manual/bash_completion.hpp"
#include "bench/manual/man_page.hpp"
#include "bench/software_version.hpp"

int main(int argc, char** argv) {
  using namespace rvbench::bench;
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "man" && argc == 3) {
    std::cout << man_page(make_commands(), software_version(), argv[2]);
  } else if (what == "bash" && argc == 2) {
    std::cout << bash_completion(make_commands());
  } else {
    std::cerr << "usage: rvbench_manual man DATE | rvbench_manual bash\n";
    return exit_codes::usage;
  }
  return std::cout.flush() ? exit_codes::done : exit_codes::internal_error;
}
