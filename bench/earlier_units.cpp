#include "bench/earlier_units.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "bench/result_database.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

// The runs below the root as their database has them. Without one that can be used the folders tell
// where they are and when they began; what they came to is in their verdicts.
std::vector<RunRow> runs_below(const std::filesystem::path& root) {
  std::error_code unknown;
  if (std::filesystem::exists(root / result_database_name, unknown)) {
    const auto database = caught_up(ResultDatabase::open(root));
    auto rows = database ? database.value().runs() : Result<std::vector<RunRow>>(database.error());
    if (rows) return std::move(rows).value();
  }
  std::vector<RunRow> rows;
  for (const std::filesystem::path& folder : run_folders(root)) {
    RunRow row;
    row.folder = folder.lexically_relative(root).string();
    row.started_utc = read_run_begin(folder).started_utc;
    row.plan = plan_name_in(folder);
    row.rig_kind = rig_of(folder).kind;
    rows.push_back(std::move(row));
  }
  return rows;
}

// Others' runs of that plan on that kind of rig before this one that may have come to PASS or FAIL,
// the latest first.
std::vector<RunRow> runs_before(const std::filesystem::path& run, const Judgement& judgement) {
  const std::filesystem::path own = run.parent_path();
  const std::string kind = rig_of(run).kind;
  std::vector<RunRow> rows = runs_below(own.parent_path());
  std::erase_if(rows, [&](const RunRow& row) {
    const bool may_be_judged = row.verdict.empty() || row.verdict == to_string(Outcome::pass) ||
                               row.verdict == to_string(Outcome::fail);
    return !may_be_judged || row.plan != judgement.facts.plan || row.rig_kind != kind ||
           row.started_utc >= judgement.facts.started_utc ||
           std::filesystem::path(row.folder).parent_path() == own.filename();
  });
  const auto when = [](const RunRow& row) { return std::tie(row.started_utc, row.folder); };
  std::ranges::sort(rows, [&](const RunRow& a, const RunRow& b) { return when(a) > when(b); });
  return rows;
}

bool is_comparable(const Judgement& other, const Judgement& judgement) {
  return (other.ending.outcome == Outcome::pass || other.ending.outcome == Outcome::fail) &&
         other.facts.plan == judgement.facts.plan && other.machine == judgement.machine;
}

std::optional<EarlierUnit> unit_in(const std::filesystem::path& run, const Judgement& judgement,
                                   const std::vector<UnitNumber>& numbers) {
  if (!has_sums(run)) return std::nullopt;
  const auto other = judgement_from_json(read_file(run / "verdict.json").value_or(""));
  if (!other || !is_comparable(*other, judgement)) return std::nullopt;
  EarlierUnit unit{other->facts.serial, other->ending.outcome == Outcome::pass, {}};
  for (const UnitNumber& number : numbers) unit.values.push_back(value_in(*other, number));
  return unit;
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
  std::vector<EarlierUnit> earlier;
  std::set<std::filesystem::path> known;  // folders of the units that are told
  for (const RunRow& row : runs_before(folder, judgement)) {
    if (earlier.size() == most_earlier_units) break;
    const std::filesystem::path name = std::filesystem::path(row.folder).parent_path();
    if (known.contains(name)) continue;
    auto unit = unit_in(own.parent_path() / row.folder, judgement, numbers);
    if (!unit) continue;
    known.insert(name);
    earlier.push_back(std::move(*unit));
  }
  return earlier;
}

}  // namespace rvbench::bench
