#include "bench/misfit.hpp"

#include <string>

namespace rvbench::bench {

void note_misfit(hal::ConfigReader& section, std::string_view key,
                 const std::invalid_argument& error) {
  const std::string told = error.what();
  const auto colon = told.find(": ");
  const bool is_named = colon != std::string::npos && told.find(' ') > colon;
  std::string text = is_named ? told.substr(colon + 2) : told;
  const std::string again = std::string(key) + " is ";  // the pointer ends with it
  if (text.starts_with(again)) text.erase(0, again.size());
  section.fault(key, text);
}

}  // namespace rvbench::bench
