#include "bench/cli.hpp"

int main(int argc, char** argv) {
  rvbench::bench::Console console = rvbench::bench::system_console();
  return rvbench::bench::run_cli({argv + 1, argv + argc}, rvbench::bench::make_commands(), console);
}
