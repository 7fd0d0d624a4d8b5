#include <fcntl.h>
#include <unistd.h>

#include <iostream>

#include "bench/cli.hpp"
#include "bench/exit_on_signal.hpp"

namespace {

// A file opened where standard input, output or error is closed would get its number, and be read
// or written as if it were that. What is written to a closed standard output is lost all the same.
void open_standard_files() {
  if (::fcntl(STDOUT_FILENO, F_GETFD) < 0) std::cout.setstate(std::ios::badbit);
  int file = 0;
  while (file >= 0 && file <= STDERR_FILENO) file = ::open("/dev/null", O_RDWR);
  if (file > STDERR_FILENO) ::close(file);
}

}  // namespace

int main(int argc, char** argv) {
  rvbench::bench::exit_on_signal();
  open_standard_files();
  rvbench::bench::Console console = rvbench::bench::system_console();
  return rvbench::bench::run_cli({argv + 1, argv + argc}, rvbench::bench::make_commands(), console);
}
