#include "bench/run_results.hpp"

#include <exception>
#include <memory>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include "bench/earlier_units.hpp"
#include "bench/junit.hpp"
#include "bench/population.hpp"
#include "bench/run_recordings.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/unit_numbers.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

// `grep -v '  report[.]' SHA256SUMS | sha256sum`
std::optional<std::string> hash_of_sums(const std::filesystem::path& folder) {
  const std::optional<std::string> sums = read_file(folder / "SHA256SUMS");
  if (!sums) return std::nullopt;
  std::string kept;
  std::istringstream lines(*sums);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("  report.") == std::string::npos) kept += line + "\n";
  }
  return sha256_of_text(kept);
}

std::vector<std::pair<std::string, std::string>> hashes_of(const std::filesystem::path& folder) {
  std::vector<std::string> names = recording_names(folder);
  names.insert(names.begin(), {"plan.json", "rig.json", "kinematics.json"});
  names.insert(names.end(), {"verdict.json", "junit.xml"});
  std::vector<std::pair<std::string, std::string>> hashes;
  for (const std::string& name : names) {
    const std::optional<std::string> hash = sha256_of_file(folder / name);
    if (hash) hashes.emplace_back(name, *hash);
  }
  if (const auto sums = hash_of_sums(folder)) hashes.emplace_back(sums_in_report, *sums);
  return hashes;
}

}  // namespace

ReportInput report_input(const std::filesystem::path& folder, const Judgement& judgement,
                         const analysis::Kinematics& kinematics) {
  ReportInput input;
  input.judgement = judgement;
  input.kinematics = kinematics;
  input.plan_json = read_file(folder / "plan.json").value_or("");
  input.rig_json = read_file(folder / "rig.json").value_or("");
  input.hashes = hashes_of(folder);
  const std::vector<UnitNumber> numbers = numbers_of(judgement);
  input.population = population_of(numbers, earlier_units(folder, judgement, numbers));
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
  return input;
}

std::vector<std::string> unwritten_files(const std::filesystem::path& folder,
                                         const std::vector<ResultFile>& files) {
  std::vector<std::string> missing;
  const auto give_up = [&](const std::string& name, const std::string& why) {
    missing.push_back(name + ": " + why);
    std::error_code ignored;
    std::filesystem::remove(folder / name, ignored);
  };
  for (const ResultFile& file : files) {
    try {
      file.write();
    } catch (const std::system_error& error) {
      // The sums come to grief over another file's: then that one is named.
      const std::string what = error.what();
      const bool is_its_own = what.starts_with((folder / file.name).string());
      give_up(file.name, is_its_own ? error.code().message() : what);
    } catch (const std::exception& bug) {  // of the one text, not of the run
      give_up(file.name, std::string("internal: ") + bug.what());
    }
  }
  return missing;
}

void tell_in_files(Judgement& judgement,
                   const std::function<std::vector<std::string>(const Judgement&)>& write) {
  judgement.unwritten = write(judgement);
  if (judgement.unwritten.empty()) return;
  std::string reason = "the results cannot be written";
  for (const std::string& file : judgement.unwritten) reason += "; " + file;
  judgement.ending = graver(judgement.ending, {Outcome::error, ErrorKind::none, reason});
  judgement.unwritten = write(judgement);
}

std::vector<std::string> write_results(const std::filesystem::path& folder,
                                       const Judgement& judgement,
                                       const analysis::Kinematics& kinematics, bool with_report) {
  const auto put = [&folder](const char* name, const std::function<std::string()>& text) {
    return ResultFile{name, [&folder, name, text] { write_file(folder / name, text()); }};
  };
  const auto report = [&] {
    std::filesystem::remove(folder / "report.pdf");  // made when it is asked for
    if (!with_report) {
      std::filesystem::remove(folder / "report.html");
      return;
    }
    write_file(folder / "report.html", make_report(report_input(folder, judgement, kinematics)));
  };
  return unwritten_files(folder, {put("verdict.json", [&] { return judgement_to_json(judgement); }),
                                  put("junit.xml", [&] { return junit_xml(judgement); }),
                                  {"report.html", report},
                                  {"SHA256SUMS", [&] { write_sums(folder); }}});
}

}  // namespace rvbench::bench
