#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "bench/campaign.hpp"
#include "bench/commands/commands.hpp"
#include "bench/factory/broker_file.hpp"
#include "bench/fault_lines.hpp"
#include "bench/file_kind.hpp"
#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/kinematics_files.hpp"
#include "bench/ledger.hpp"
#include "bench/limits_file.hpp"
#include "bench/part_limits.hpp"
#include "bench/recording_facts.hpp"
#include "bench/results/audit_index.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/rig_factory.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_start.hpp"
#include "bench/serve/audit_log.hpp"
#include "bench/serve/station_file.hpp"
#include "bench/sha256.hpp"
#include "bench/tpa_project.hpp"
#include "hal/formats/printable.hpp"
#include "hal/formats/strange_file.hpp"
#include "sequences/plan.hpp"
#include "sim/plant_json.hpp"

namespace rvbench::bench {
namespace {

using Faults = std::vector<hal::ConfigFault>;

Faults plan_faults(const std::string& file) {
  auto plan = sequences::read_plan(file);
  if (plan.index() == 1) return std::get<1>(std::move(plan));
  const sequences::TestPlan& test = std::get<0>(plan);
  const auto kinematics = read_kinematics(test.specimen.kinematics);
  if (kinematics.index() == 1) {
    const auto& first = std::get<1>(kinematics).front();
    return {{0, "/specimen/kinematics", hal::describe(test.specimen.kinematics, first)}};
  }
  return limits_on_unknown_parts(test.limits, std::get<0>(kinematics));
}

Faults plant_faults(const std::string& file) {
  auto plant = sim::read_plant(file);
  return plant.index() == 1 ? std::get<1>(std::move(plant)) : Faults{};
}

Faults campaign_faults(const std::string& file) {
  auto campaign = read_campaign(file);
  return campaign.index() == 1 ? std::get<1>(std::move(campaign)).faults : Faults{};
}

Faults tpa_faults(const std::string& file) {
  auto project = read_tpa_project(file);
  return project.index() == 1 ? std::get<1>(std::move(project)) : Faults{};
}

Faults limits_faults(const std::string& file) {
  auto limits = read_limits_file(file);
  return limits.index() == 1 ? std::get<1>(std::move(limits)) : Faults{};
}

Faults station_faults(const std::string& file) {
  auto station = read_station(file);
  return station.index() == 1 ? std::get<1>(std::move(station)) : Faults{};
}

Faults broker_faults(const std::string& file) {
  auto broker = read_broker(file);
  return broker.index() == 1 ? std::get<1>(std::move(broker)) : Faults{};
}

Faults faults_of(const std::string& kind, const std::string& file) {
  if (kind == "plan") return plan_faults(file);
  if (kind == "rig") return check_rig(file);
  if (kind == "plant") return plant_faults(file);
  if (kind == "campaign") return campaign_faults(file);
  if (kind == "tpa") return tpa_faults(file);
  if (kind == "limits") return limits_faults(file);
  if (kind == "station") return station_faults(file);
  if (kind == "broker") return broker_faults(file);
  return {{1, "",
           "neither plan (\"main\"), rig (\"rig\"), kinematics (\"machine\"), plant (\"plant\"), "
           "campaign (\"campaign\"), tpa project (\"tpa\"), limits (\"limits_version\"), station "
           "(\"station\") nor broker (\"host\")"}};
}

int check_run(Console& console, const std::filesystem::path& folder) {
  if (is_absent(folder / "plan.json")) {
    return refuse_file(console, folder, {{0, "", "no run folder: it holds no plan.json"}});
  }
  if (is_at_work(folder)) return refuse_file(console, folder, {{0, "", still_at_work}});
  const std::vector<std::string> faults = verify_sums(folder);
  for (const std::string& fault : faults) {
    complain(console, "rvbench: " + (folder / fault).string());
  }
  if (!faults.empty()) return exit_codes::bad_file;
  console.out << folder.string() << ": run folder, every file matches its hash\n";
  return exit_codes::done;
}

// Of the file as a whole.
Faults as_faults(const std::vector<std::string>& texts) {
  Faults faults;
  for (const std::string& text : texts) faults.push_back({0, "", text});
  return faults;
}

int check_recording(Console& console, const std::string& file) {
  const auto checked = recording_facts(file);
  if (const auto* fault = std::get_if<std::string>(&checked)) {
    complain(console, "rvbench: " + *fault);
    return exit_codes::data_refused;
  }
  const RecordingFacts& facts = std::get<RecordingFacts>(checked);
  console.out << hal::formats::printable(file) << ": " << facts.summary << '\n';
  remark(console, "note", file, as_faults(facts.notes));
  remark(console, "warning", file, as_faults(facts.warnings));
  return exit_codes::done;
}

// What results.db knows of a station's log and that has no more.
Result<LostAuditLines> lost_lines(const std::filesystem::path& results,
                                  const std::filesystem::path& log) {
  const auto file = SqliteFile::open(results, results);
  if (!file) return file.error();
  return lost_audit_lines(file.value(), log);
}

// The results beside a station's log; nothing where it lies alone.
std::optional<std::filesystem::path> results_of(const std::filesystem::path& log) {
  std::error_code unknown;
  const auto whole = std::filesystem::weakly_canonical(log, unknown);
  const std::filesystem::path runs = whole.parent_path().parent_path();
  if (unknown || whole != audit_log_of(runs)) return std::nullopt;
  if (!std::filesystem::exists(runs / result_database_name, unknown)) return std::nullopt;
  return runs / result_database_name;
}

// What was taken from its end shows by results.db alone: hence the last hash, to be kept elsewhere.
int check_audit_log(Console& console, const std::string& file) {
  const auto checked = check_audit(file);
  if (!checked) return refuse_file(console, file, {{0, "", "cannot be read"}});
  if (checked->broken_line > 0) {
    return refuse_file(console, file, {{int(checked->broken_line), "", checked->fault}});
  }
  if (const auto results = results_of(file)) {
    const auto lost = lost_lines(*results, file);
    if (!lost) {
      remark(console, "warning", file,
             as_faults({"it cannot be held against results.db: " + describe(lost.error())}));
    } else if (lost.value().count > 0) {
      return refuse_file(
          console, file,
          as_faults({fmt::format("lines from {} on ({}) are in {} and not in the log: they were "
                                 "taken away",
                                 readable_utc(lost.value().first_utc), lost.value().count,
                                 results->string())}));
    }
  }
  console.out << file << ": audit log, " << checked->lines
              << " lines, each follows the one before; the last has the hash " << checked->last_hash
              << '\n';
  return exit_codes::done;
}

// Of the files that it lists those that are not as they were kept.
int check_ledger(Console& console, const std::filesystem::path& file) {
  if (is_absent(file)) return refuse_file(console, file, {{0, "", "there is none"}});
  const std::vector<std::string> faults = ledger_faults(file.parent_path());
  for (const std::string& fault : faults) complain(console, "rvbench: " + fault);
  if (!faults.empty()) return exit_codes::bad_file;
  const Ledger ledger = read_ledger(file.parent_path());
  console.out << file.string() << ": ledger, " << ledger.lines.size()
              << " lines, every file is as it was kept\n";
  if (ledger.is_cut_short) {
    remark(console, "warning", file,
           as_faults({"its last line was cut short, as by a power failure: what it was of was not "
                      "kept"}));
  }
  return exit_codes::done;
}

int check_machine(Console& console, const std::string& file) {
  const auto read = read_machine(file);
  if (const auto* faults = std::get_if<Faults>(&read)) {
    return refuse_file(console, file, with_lines(file, *faults));
  }
  const DoubtedMachine& machine = std::get<DoubtedMachine>(read);
  console.out << file << ": kinematics, no fault\n" << part_limits_text(machine.kinematics);
  remark(console, "warning", file, with_lines(file, machine.doubts));
  return exit_codes::done;
}

int check_file(Console& console, const std::string& file) {
  if (std::filesystem::path(file).filename() == ledger_name) return check_ledger(console, file);
  if (is_audit_log(file)) return check_audit_log(console, file);
  if (const auto strange = hal::formats::what_it_looks_like(file)) {
    return refuse_file(console, file, as_faults({hal::formats::not_read(*strange)}));
  }
  if (is_recording(file)) return check_recording(console, file);
  const bool is_shipped = std::ranges::count(names_of(kinematics_files()), file) > 0;
  if (is_shipped && is_absent(file)) return check_machine(console, file);
  const hal::ConfigReader root = hal::ConfigReader::from_file(file);
  const std::string kind = file_kind(root);
  if (kind == "kinematics") return check_machine(console, file);
  const Faults faults =
      kind.empty() && !root.faults().empty() ? root.faults() : faults_of(kind, file);
  if (!faults.empty()) return refuse_file(console, file, with_lines(file, faults));
  console.out << file << ": " << kind << ", no fault";
  const RigRemarks remarks = kind == "rig" ? remarks_on(file) : RigRemarks{};
  console.out << (remarks.unfit_for_runs.empty() ? "\n" : "; fit for probe, not for a run\n");
  remark(console, "note", file, remarks.unfit_for_runs);
  remark(console, "warning", file, remarks.warnings);
  return exit_codes::done;
}

class CheckCommand final : public Command {
 public:
  std::string name() const override { return "check"; }
  std::string summary() const override {
    return "validates plan, rig, kinematics, plant, campaign, tpa, limits, station and broker "
           "files, recordings, run folders, ledgers and audit logs";
  }
  std::string examples() const override {
    return "  rvbench check plans/mine.json bench_a.json\n"
           "  rvbench check gear.csv                     its channels, rate and length\n"
           "  rvbench check rv20e                        a machine's parts, with their limits\n"
           "  rvbench check runs/A17/20260102T030405Z    verifies the hashes of a run\n"
           "  rvbench check runs/ledger.jsonl            what stations have kept\n"
           "  rvbench check runs/.station/audit.jsonl    verifies the chain of hashes\n";
  }
  std::vector<Option> options() override {
    return {{"FILE", "files or run folders", &files_, true, {}}};
  }

  int run(Console& console) override {
    int worst = exit_codes::done;
    for (const std::string& file : files_) {
      std::error_code unknown;  // then reading the file tells why
      const bool folder = std::filesystem::is_directory(file, unknown);
      worst = std::max(worst, folder ? check_run(console, file) : check_file(console, file));
    }
    return worst;
  }

 private:
  std::vector<std::string> files_;
};

}  // namespace

std::unique_ptr<Command> make_check_command() { return std::make_unique<CheckCommand>(); }

}  // namespace rvbench::bench
