#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <system_error>
#include <utility>

#include "bench/acceptance.hpp"
#include "bench/bench_lock.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/sim_choice.hpp"
#include "bench/file_kind.hpp"
#include "bench/find_plan.hpp"
#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/limits_in_force.hpp"
#include "bench/plan_files.hpp"
#include "bench/progress_bar.hpp"
#include "bench/qualification/golden_runs.hpp"
#include "bench/qualification/qualification.hpp"
#include "bench/results/result_entry.hpp"
#include "bench/rig_factory.hpp"
#include "bench/rig_file.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_start.hpp"
#include "bench/serve/tell_live.hpp"
#include "bench/sha256.hpp"
#include "bench/software_version.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/summary.hpp"
#include "bench/text_file.hpp"
#include "bench/timeline_table.hpp"
#include "bench/try_for.hpp"
#include "bench/verdict_json.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/formats/printable.hpp"
#include "sequences/plan_on_rig.hpp"

namespace rvbench::bench {
namespace {

constexpr std::chrono::seconds longest_entry{10};  // results.db may be locked for a while
constexpr std::chrono::seconds longest_wait_for_page{2};
constexpr const char* untold_entry =
    "rvbench: the results do not answer; the run will be entered by the next one\n";

class RunCommand final : public Command {
 public:
  explicit RunCommand(std::filesystem::path lock_folder) : lock_folder_(std::move(lock_folder)) {}
  std::string name() const override { return "run"; }
  std::string summary() const override {
    return "runs an acceptance test: measure, record, judge, report";
  }
  std::string examples() const override {
    return "  rvbench run quick --rig sim --serial A17\n"
           "  rvbench run quick --rig sim --preset input_shaft --seed 7 --serial A18 --json\n"
           "  rvbench run rv20e_acceptance --rig sim --serial A17 --dry-run\n"
           "  rvbench run plans/mine.json --rig bench_a.json --serial A17 --resume\n";
  }
  std::vector<Option> options() override {
    return {
        {"PLAN", "plan: " + hal::listed(names_of(plan_files())) + ", or a plan file", &plan_, true},
        {"--rig", "rig: sim, or a rig file", &rig_, true},
        {"--serial", "serial number of the unit; no default", &serial_},
        unit_.preset(),
        unit_.seed(),
        unit_.severity(),
        {"--dry-run", "print the timeline and its envelope; touch nothing", &dry_run_},
        {"--out", "folder for run folders; default: " + out_, &out_},
        {"--resume", "go on with the newest unfinished run of this serial", &resume_},
        {"--live", "tell how the run goes to this socket, which serve listens at", &live_},
        {"--no-report", "no report.html: rvbench report makes it later", &no_report_},
        {"--brief", "print verdict, reason, the nearest limits and where the report is", &brief_},
        {"--json", "one JSON document on standard output", &json_}};
  }
  int run(Console& console) override;

 private:
  std::string option_fault(bool is_rig_read) const;
  int run_plan(Console& console, sequences::TestPlan& plan, hal::Rig& rig);
  int prepare_folder(Console& console, const sequences::TestPlan& plan);
  RunFacts facts(const sequences::TestPlan& plan) const;
  int measure(Console& console, const sequences::TestPlan& plan,
              const analysis::Kinematics& kinematics, hal::Rig& rig,
              const std::vector<hal::ConfigFault>& warnings);
  void hold_against_station(Console& console, Acceptance& acceptance) const;
  std::string enter_golden_result() const;
  void tell(Console& console, const Judgement& judgement, const analysis::Kinematics& kinematics,
            const std::string& not_entered) const;

  const std::filesystem::path lock_folder_;
  std::string plan_;
  std::string rig_;
  std::string serial_;
  SimChoice unit_;
  std::string out_ = "runs";
  bool dry_run_ = false;
  bool resume_ = false;
  bool no_report_ = false;
  bool brief_ = false;
  bool json_ = false;
  std::string plan_sha256_;  // of its text, before limits are put in force
  LimitsInForce limits_;
  std::string live_;
  RigFile file_;    // what --rig names, read once
  RunPlace place_;  // locked until the command ends
};

// What the options ask and may not; "" if nothing.
std::string RunCommand::option_fault(bool is_rig_read) const {
  const std::string serial = "--serial " + hal::in_quotes(serial_);
  if (serial_.empty() && !dry_run_) return "--serial is required";
  if (serial_.starts_with(' ') || serial_.ends_with(' ')) {
    return serial + ": no blank may begin or end it";
  }
  // Two of them would be one in every document.
  if (hal::formats::printable(serial_) != serial_) return serial + ": it is not UTF-8";
  if (!is_rig_read) return "";
  if (!std::holds_alternative<SimRig>(file_) && !unit_.stated().empty()) {
    return unit_.stated() + ": " + rig_ + " has a unit of its own, none is simulated";
  }
  return is_almost_golden(qualification_in(file_), serial_)
             ? serial + " differs from the golden unit's only in capitals or blanks"
             : "";
}

int RunCommand::run(Console& console) {
  auto plan = find_plan(plan_);
  auto file = read_rig(rig_, unit_.rig_options());
  const bool is_rig_read = file.index() == 0;
  if (is_rig_read) file_ = std::get<0>(std::move(file));
  if (const std::string fault = option_fault(is_rig_read); !fault.empty()) {
    return refuse_usage(console, "run: " + fault);
  }
  std::variant<hal::Rig, std::vector<hal::ConfigFault>> rig;
  if (is_rig_read) {
    rig = make_rig(file_, rig_);  // opens nothing
  } else {
    rig = std::get<1>(std::move(file));
  }
  if (plan.index() == 1) refuse_file(console, plan_, std::get<1>(plan));
  if (rig.index() == 1) refuse_file(console, rig_, std::get<1>(rig));
  if (plan.index() == 1 || rig.index() == 1) return exit_codes::bad_file;
  return run_plan(console, std::get<0>(plan), std::get<0>(rig));
}

int RunCommand::run_plan(Console& console, sequences::TestPlan& plan, hal::Rig& rig) {
  plan_sha256_ = sha256_of_text(sequences::plan_to_json(plan));
  auto limits = put_in_force(out_, plan_, plan);
  if (limits.index() == 1) return refuse_usage(console, "run: " + std::get<1>(limits));
  limits_ = std::get<0>(std::move(limits));
  if (!limits_.version.empty()) console.err << "rvbench: note: " << note_of(limits_) << '\n';
  auto kinematics = read_kinematics(plan.specimen.kinematics);
  if (kinematics.index() == 1) {
    return refuse_file(console, plan.specimen.kinematics, std::get<1>(kinematics));
  }
  auto faults = limits_on_unknown_parts(plan.limits, std::get<0>(kinematics));
  std::ranges::move(sequences::faults_of_plan_on(rig, plan), std::back_inserter(faults));
  for (const auto& [path, told] : faults_by_file(faults, plan_, limits_))
    refuse_file(console, path, told);
  if (!faults.empty()) return exit_codes::bad_file;
  const auto warnings = remarks_on(file_, rig_).warnings;
  remark(console, "warning", rig_, warnings);
  if (dry_run_) {
    if (const auto refusal = qualification_now(file_, out_, serial_).refusal()) {
      console.err << "rvbench: warning: a run would end with exit 60: " << refusal->reason << '\n';
    }
    console.out << (json_ ? timeline_json(plan) : timeline_table(plan));
    return exit_codes::done;
  }
  return measure(
      console, plan,
      with_limits(of_specimen(std::get<0>(std::move(kinematics)), plan.specimen), plan.limits), rig,
      warnings);
}

// A new run folder with the resolved plan, rig and machine, or the one to go on with.
int RunCommand::prepare_folder(Console& console, const sequences::TestPlan& plan) {
  const ResolvedFiles resolved{{"rig.json", rig_to_json(file_)},
                               {"kinematics.json", kinematics_text(plan.specimen.kinematics)},
                               {"plan.json", sequences::plan_to_json(plan)}};
  if (!resume_) {
    place_ = begin_run(out_, serial_, resolved);
    return exit_codes::done;
  }
  auto found = resume_run(out_, serial_, resolved);
  if (found.index() == 1) return refuse_usage(console, "run: " + std::get<1>(found));
  place_ = std::get<0>(std::move(found));
  return exit_codes::done;
}

RunFacts RunCommand::facts(const sequences::TestPlan& plan) const {
  RunFacts facts;
  facts.serial = serial_;
  facts.started_utc = read_run_begin(place_.folder).started_utc;
  facts.plan = plan.name;
  facts.limits_version = limits_.version;
  facts.rig = rig_;
  // A rig file goes before the command line, and a replayed recording has no preset and no seed.
  if (const auto* sim = std::get_if<SimRig>(&file_)) {
    facts.preset = sim->preset;
    facts.seed = sim->seed;
  }
  facts.software = software_version();
  return facts;
}

// The plant that a run is held against; "" for a simulated rig, which is its own twin.
std::string twin_of(const RigFile& rig) {
  return std::holds_alternative<SimRig>(rig) ? "" : plant_of(rig);
}

int RunCommand::measure(Console& console, const sequences::TestPlan& plan,
                        const analysis::Kinematics& kinematics, hal::Rig& rig,
                        const std::vector<hal::ConfigFault>& warnings) {
  StopOnSignal signals;
  const auto* bench = std::get_if<BenchRig>(&file_);
  const auto devices = bench != nullptr ? devices_of(*bench) : std::vector<std::string>();
  const auto lock = lock_devices(console, name(), devices, lock_folder_);
  if (!lock) return exit_codes::usage;
  try {
    if (const int refused = prepare_folder(console, plan); refused != exit_codes::done)
      return refused;
  } catch (const std::system_error& error) {
    return refuse_usage(console, "run: no run folder in --out " + out_ + ": " + reason_of(error));
  }
  ProgressBar bar(console, progress_style(console, json_));
  Acceptance acceptance{plan, kinematics, place_.folder, facts(plan), twin_of(file_)};
  acceptance.with_report = !no_report_;
  if (!limits_.version.empty()) acceptance.warnings.push_back(note_of(limits_));
  for (const hal::ConfigFault& warning : warnings) {
    acceptance.warnings.push_back(hal::describe(rig_, warning));
  }
  hold_against_station(console, acceptance);
  if (!live_.empty()) tell_live(live_, rig, acceptance, bar);
  const Judgement judgement = run_acceptance(std::move(acceptance), rig, bar, signals.token());
  std::string not_entered;
  const auto enter = [&] {
    not_entered = enter_golden_result() + enter_result(out_, place_.folder, judgement);
  };
  if (judgement.facts.must_exit) {
    // With a thread in a call that never returns, no destructor of the rig may run.
    const bool answers = try_for(longest_entry, enter);  // else it may still write the text
    (void)try_for(longest_wait_for_page, [&] {
      tell(console, judgement, kinematics, answers ? not_entered : untold_entry);
    });
    std::_Exit(exit_code(judgement.ending));
  }
  enter();
  tell(console, judgement, kinematics, not_entered);
  return exit_code(judgement.ending);
}

// No run goes on where the station may not judge, nor a golden unit's that nobody would know of.
void RunCommand::hold_against_station(Console& console, Acceptance& acceptance) const {
  const Qualification qualification = qualification_now(file_, out_, serial_);
  for (const std::string& warning : qualification.warnings()) {
    console.err << "rvbench: warning: " << warning << '\n';
    acceptance.warnings.push_back(warning);
  }
  acceptance.refusal = qualification.refusal();
  // One that is gone on with ends anew, whatever keeps it from going on.
  if (acceptance.refusal && !resume_) return;
  const std::string why =
      enter_golden_begin(out_, qualification_in(file_), place_.folder, plan_sha256_);
  if (!why.empty() && !acceptance.refusal) {
    acceptance.refusal = Ending{Outcome::error, ErrorKind::none, why};
  }
}

// Standard output first: the other may be what hangs.
void RunCommand::tell(Console& console, const Judgement& judgement,
                      const analysis::Kinematics& kinematics,
                      const std::string& not_entered) const {
  if (json_) {
    console.out << judgement_to_json(judgement);
  } else if (brief_) {
    print_brief(console, judgement, place_.folder);
  } else {
    print_summary(console, judgement, kinematics, place_.folder);
  }
  console.out.flush();
  print_unwritten(console, judgement);
  console.err << not_entered << std::flush;
}

// @return what to say if that cannot be
std::string RunCommand::enter_golden_result() const {
  const std::string why = enter_golden_end(out_, qualification_in(file_), place_.folder);
  return why.empty() ? "" : "rvbench: run: " + why + "; it counts as one that did not end\n";
}

}  // namespace

std::unique_ptr<Command> make_run_command(std::filesystem::path lock_folder) {
  return std::make_unique<RunCommand>(std::move(lock_folder));
}

}  // namespace rvbench::bench
