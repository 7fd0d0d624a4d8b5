#include "sequences/phase_registry.hpp"

#include <map>

#include "hal/did_you_mean.hpp"
#include "sequences/phases/connect.hpp"
#include "sequences/phases/hysteresis_loop.hpp"
#include "sequences/phases/matrix.hpp"
#include "sequences/phases/warm_up.hpp"

namespace rvbench::sequences {

std::unique_ptr<Phase> parse_phase(hal::ConfigReader& json) {
  using Parse = std::unique_ptr<Phase> (*)(hal::ConfigReader&);
  static const std::map<std::string, Parse> kinds = {
      {"connect", parse_connect},
      {"hysteresis_loop", parse_hysteresis_loop},
      {"matrix", parse_matrix},
      {"warm_up", parse_warm_up},
  };
  const std::string kind = json.text("phase");
  if (const auto found = kinds.find(kind); found != kinds.end()) return found->second(json);
  json.disregard();  // its other keys may be right or wrong: nobody can tell
  if (!json.has("phase")) return nullptr;
  std::vector<std::string> words;
  for (const auto& [word, parse] : kinds) words.push_back(word);
  json.fault("phase", "there is no such phase" + hal::did_you_mean(kind, words));
  return nullptr;
}

}  // namespace rvbench::sequences
