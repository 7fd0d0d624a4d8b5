#include "bench/earlier_units.hpp"

#include <algorithm>
#include <optional>
#include <system_error>

#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

struct DatedRun {
  std::string started_utc;
  std::filesystem::path folder;

  auto operator<=>(const DatedRun&) const = default;
};

using Runs = std::vector<DatedRun>;  // of one unit, the latest first

Runs runs_before(const std::filesystem::path& unit, const std::string& started_utc) {
  Runs runs;
  for (const std::filesystem::path& folder : folders_in(unit)) {
    DatedRun run{read_run_begin(folder).started_utc, folder};
    if (run.started_utc < started_utc && has_sums(folder)) runs.push_back(std::move(run));
  }
  std::ranges::sort(runs, std::greater{});
  return runs;
}

bool is_comparable(const Judgement& other, const Judgement& judgement) {
  return (other.ending.outcome == Outcome::pass || other.ending.outcome == Outcome::fail) &&
         other.facts.plan == judgement.facts.plan && other.machine == judgement.machine;
}

std::optional<EarlierUnit> last_of(const Runs& runs, const Judgement& judgement,
                                   const std::vector<UnitNumber>& numbers) {
  for (const DatedRun& run : runs) {
    // A look at the small file spares reading a large one.
    if (plan_name_in(run.folder) != judgement.facts.plan) continue;
    const auto other = judgement_from_json(read_file(run.folder / "verdict.json").value_or(""));
    if (!other || !is_comparable(*other, judgement)) continue;
    EarlierUnit unit{other->facts.serial, other->ending.outcome == Outcome::pass, {}};
    for (const UnitNumber& number : numbers) unit.values.push_back(value_in(*other, number));
    return unit;
  }
  return std::nullopt;
}

}  // namespace

std::vector<EarlierUnit> earlier_units(const std::filesystem::path& run, const Judgement& judgement,
                                       const std::vector<UnitNumber>& numbers) {
  std::error_code unknown;
  const std::filesystem::path folder = std::filesystem::weakly_canonical(run, unknown);
  const std::filesystem::path own = folder.parent_path();
  const std::string& serial = judgement.facts.serial;
  // Anywhere else the folders beside it are nobody's runs.
  if (unknown || serial.empty() || own.filename() != folder_name_of(serial)) return {};
  std::vector<Runs> units;
  for (const std::filesystem::path& other : folders_in(own.parent_path())) {
    if (other == own) continue;
    Runs runs = runs_before(other, judgement.facts.started_utc);
    if (!runs.empty()) units.push_back(std::move(runs));
  }
  std::ranges::sort(units, std::greater{});
  std::vector<EarlierUnit> earlier;
  for (const Runs& runs : units) {
    if (earlier.size() == most_earlier_units) break;
    if (auto unit = last_of(runs, judgement, numbers)) earlier.push_back(std::move(*unit));
  }
  return earlier;
}

}  // namespace rvbench::bench
