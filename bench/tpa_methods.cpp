#include "bench/tpa_methods.hpp"

#include <algorithm>

#include "hal/types/require.hpp"

namespace rvbench::bench {

const std::vector<NamedTpaMethod>& tpa_methods() {
  static const std::vector<NamedTpaMethod> all{inverse_method(), blocked_forces_method(),
                                               mounts_method(), operational_method()};
  return all;
}

const NamedTpaMethod& tpa_method(std::string_view name) {
  constexpr Require require{"tpa_method"};
  const auto found = std::ranges::find(tpa_methods(), name, &NamedTpaMethod::name);
  require(found != tpa_methods().end(), "no method " + std::string(name));
  return *found;
}

}  // namespace rvbench::bench
