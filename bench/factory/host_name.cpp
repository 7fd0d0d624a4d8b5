#include "bench/factory/host_name.hpp"

#include <unistd.h>

#include <array>

namespace rvbench::bench {

std::string host_name() {
  std::array<char, 256> name{};
  const bool has_one = ::gethostname(name.data(), name.size() - 1) == 0 && name.front() != '\0';
  return has_one ? name.data() : "bench";
}

}  // namespace rvbench::bench
