#include "hal/formats/distinct_names.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <set>

namespace rvbench::hal::formats {

std::vector<std::string> make_names_distinct(Recording& recording) {
  std::multiset<std::string> all;
  for (const Channel& channel : recording.channels) all.insert(channel.info.name);
  std::set<std::string> given;
  std::vector<std::string> told;
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    std::string& name = recording.channels[i].info.name;
    const std::string before = name;
    if (before.empty()) name = fmt::format("channel_{}", i + 1);
    const std::string base = name;
    const auto is_taken = [&] {
      return given.count(name) > 0 || (name != before && all.count(name) > 0);
    };
    for (int n = 2; is_taken(); ++n) name = fmt::format("{}_{}", base, n);
    given.insert(name);
    if (name == before) continue;
    told.push_back(
        before.empty()
            ? fmt::format("channel {} has no name and is called {}", i + 1, name)
            : fmt::format("there is another {}: channel {} is called {}", before, i + 1, name));
  }
  return told;
}

}  // namespace rvbench::hal::formats
