#include "bench/commands/sound_words.hpp"

#include <fmt/format.h>

#include <utility>

#include "bench/commands/commands.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

// What a unit came to: as it was judged before, or judged now; or why it cannot be used.
std::variant<Judgement, std::string> judged(const std::filesystem::path& file,
                                            const SoundWords& given) {
  if (file.extension() != ".json") return given.judge(file);
  auto judgement = judgement_from_json(read_file(file).value_or(""));
  if (!judgement) return "is no verdict.json";
  if (judgement->machine != given.machine) return "is of another machine: " + judgement->machine;
  return std::move(*judgement);
}

std::string why_not_counted(const SoundUnits::Added& added, const std::string& reason) {
  if (const auto* repeated = std::get_if<SoundUnits::Repeated>(&added)) {
    return "the same samples as " + repeated->file;
  }
  return reason;
}

}  // namespace

std::variant<SoundUnits, int> sound_units(Console& console, const SoundWords& given) {
  const auto found = sound_files(given.words, given.runs);
  if (const auto* why = std::get_if<std::string>(&found)) {
    return refuse_usage(console, "judge: --sound: " + *why);
  }
  SoundUnits units;
  for (const std::filesystem::path& file : std::get<0>(found)) {
    auto unit = judged(file, given);
    if (const auto* why = std::get_if<std::string>(&unit)) {
      return refuse_data(console, "--sound: " + file.string() + ": " + *why);
    }
    auto& judgement = std::get<Judgement>(unit);
    const std::string reason = judgement.ending.reason;
    const SoundUnits::Added added = units.add(file.string(), std::move(judgement));
    if (std::holds_alternative<SoundUnits::Counted>(added)) continue;
    console.err << "rvbench: note: --sound: " << file.string()
                << ": not counted: " << why_not_counted(added, reason) << '\n';
  }
  if (units.size() >= fewest_sound_units) return units;
  return refuse_data(console, fmt::format("--sound: {} sound units count, and {} are needed to "
                                          "tell how much they scatter",
                                          units.size(), fewest_sound_units));
}

}  // namespace rvbench::bench
