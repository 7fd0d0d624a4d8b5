#include "bench/run_results.hpp"

#include <memory>
#include <optional>
#include <utility>

#include "bench/junit.hpp"
#include "bench/report/report.hpp"
#include "bench/run_recordings.hpp"
#include "bench/sha256.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

std::vector<std::pair<std::string, std::string>> hashes_of(const std::filesystem::path& folder) {
  std::vector<std::string> names = recording_names(folder);
  names.insert(names.begin(), {"plan.json", "rig.json"});
  names.insert(names.end(), {"verdict.json", "junit.xml"});
  std::vector<std::pair<std::string, std::string>> hashes;
  for (const std::string& name : names) {
    const std::optional<std::string> hash = sha256_of_file(folder / name);
    if (hash) hashes.emplace_back(name, *hash);
  }
  return hashes;
}

}  // namespace

void write_report(const std::filesystem::path& folder, const Judgement& judgement,
                  const analysis::Kinematics& kinematics) {
  ReportInput input;
  input.judgement = judgement;
  input.kinematics = kinematics;
  input.plan_json = read_file(folder / "plan.json").value_or("");
  input.rig_json = read_file(folder / "rig.json").value_or("");
  input.hashes = hashes_of(folder);
  Result<RunRecordings> recordings = RunRecordings::open(folder);
  if (recordings) {
    auto run = std::make_shared<RunRecordings>(std::move(recordings).value());
    input.load = [run](std::size_t point) -> std::optional<Recording> {
      const int number = static_cast<int>(point);
      if (!run->has(number)) return std::nullopt;
      Result<Recording> record = run->read(number);
      if (!record) return std::nullopt;
      return std::move(record).value();
    };
  }
  write_file(folder / "report.html", make_report(input));
}

void write_results(const std::filesystem::path& folder, const Judgement& judgement,
                   const analysis::Kinematics& kinematics) {
  write_file(folder / "verdict.json", judgement_to_json(judgement));
  write_file(folder / "junit.xml", junit_xml(judgement));
  write_report(folder, judgement, kinematics);
  write_sums(folder);
}

}  // namespace rvbench::bench
