#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "bench/bench_lock.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/shaft_question.hpp"
#include "bench/fault_lines.hpp"
#include "bench/ledger.hpp"
#include "bench/progress_bar.hpp"
#include "bench/qualification/ages.hpp"
#include "bench/qualification/calibration_entry.hpp"
#include "bench/qualification/qualification.hpp"
#include "bench/qualification/qualification_text.hpp"
#include "bench/qualification/self_test.hpp"
#include "bench/qualification/self_test_observer.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/rig_factory.hpp"
#include "bench/rig_file.hpp"
#include "bench/run_folder.hpp"
#include "bench/software_version.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/text_file.hpp"
#include "bench/try_for.hpp"

namespace rvbench::bench {
namespace {

constexpr std::chrono::seconds longest_farewell{8};  // the ledger may be another's for five

// As of a run that cannot be written.
int refuse_disk(Console& console, const std::string& why) {
  complain(console, "rvbench: " + why);
  return exit_code({Outcome::error, ErrorKind::none, ""});
}

class QualifyCommand final : public Command {
 public:
  explicit QualifyCommand(std::filesystem::path lock_folder)
      : lock_folder_(std::move(lock_folder)) {}
  std::string name() const override { return "qualify"; }
  std::string summary() const override {
    return "whether the station may judge: self-test, calibrations, golden unit";
  }
  std::string examples() const override {
    return "  rvbench qualify --rig bench_a.json                     self-test, the shaft turns\n"
           "  rvbench qualify status --rig bench_a.json              what is missing, what "
           "expires\n"
           "  rvbench qualify calibrate --rig bench_a.json --channel accel_1x --sensitivity "
           "0.01021\n"
           "      --certificate K-4711 --by \"J. Weber\" --on 2026-11-02 --until 2027-11-01\n"
           "  rvbench qualify records --rig bench_a.json             all calibrations entered\n"
           "  rvbench qualify clock --rig bench_a.json --by \"J. Weber\"   this computer's clock "
           "is right\n"
           "A rig file says in \"qualification\" what is asked of its station. Exit code 0 if the\n"
           "self-test was passed, or status finds the station qualified; else 60, also where\n"
           "ledger or clock let nothing be kept; 30 where the bench does not answer or the disk\n"
           "takes no record.\n";
  }
  std::vector<Option> options() override {
    return {{"STEP",
             "what to do; default: test",
             &step_,
             false,
             {"test", "status", "calibrate", "records", "clock"}},
            {"--rig", "rig file with a \"qualification\"", &rig_, true},
            {"--out", "folder of run folders, which keeps the records; default: " + out_, &out_},
            {"--no-tap", "test: nobody is there to tap on the housing", &no_tap_},
            {"--yes", "test: do not ask whether the shaft may turn", &yes_},
            {"--channel", "calibrate: the sensor's channel", &calibration_.channel},
            {"--sensitivity", "calibrate: V per unit, as certified", &calibration_.sensitivity},
            {"--no-sensitivity", "calibrate: the certificate states none",
             &calibration_.no_sensitivity},
            {"--certificate", "calibrate: number of the certificate", &calibration_.certificate},
            {"--by", "calibrate, clock: who enters or says it", &calibration_.by},
            {"--on", "calibrate: day of the calibration, as 2026-11-02", &calibration_.on},
            {"--until", "calibrate: last day that it is valid", &calibration_.until},
            {"--json", "test, status, records: one JSON document on standard output", &json_}};
  }
  int run(Console& console) override;

 private:
  int test(Console& console);
  int test_on(Console& console, hal::Rig& rig, const StopOnSignal& signals);
  int tell(Console& console, const SelfTest& test, SelfTestRecord record);
  int status(Console& console) const;
  int calibrate(Console& console) const;
  int records(Console& console) const;
  int clock(Console& console) const;
  int refuse_to_keep(Console& console, const std::string& fault) const;
  void warn_of_rest(Console& console) const;

  const std::filesystem::path lock_folder_;
  std::string step_ = "test";
  std::string rig_, out_ = "runs";
  CalibrationEntry calibration_;
  bool no_tap_ = false, yes_ = false, json_ = false;
  RigFile file_;  // what --rig names
};

int QualifyCommand::run(Console& console) {
  auto file = read_rig(rig_, {});
  if (file.index() == 1) return refuse_file(console, rig_, std::get<1>(file));
  file_ = std::get<0>(std::move(file));
  if (step_ == "status") return status(console);
  if (qualification_in(file_) == nullptr) {
    return refuse_file(console, rig_,
                       with_lines(rig_, {{0, "/qualification",
                                          "this section is missing: it says what is asked of the "
                                          "station"}}));
  }
  if (step_ == "calibrate") return calibrate(console);
  if (step_ == "clock") return clock(console);
  return step_ == "records" ? records(console) : test(console);
}

int QualifyCommand::refuse_to_keep(Console& console, const std::string& fault) const {
  complain(console, "rvbench: qualify: no record could be kept: " + fault);
  return exit_code({Outcome::error, ErrorKind::not_qualified, ""});
}

int QualifyCommand::test(Console& console) {
  const auto& spec = qualification_in(file_)->self_test;
  if (!spec) {
    return refuse_file(
        console, rig_,
        with_lines(rig_, {{0, "/qualification/self_test", "no self-test is asked"}}));
  }
  auto rig = make_rig(file_, rig_);
  if (rig.index() == 1) return refuse_file(console, rig_, std::get<1>(rig));
  hal::Rig& made = std::get<0>(rig);
  if (const std::string why = why_not_on(made, *spec); !why.empty()) {
    return refuse_file(console, rig_, with_lines(rig_, {{0, "/qualification/self_test", why}}));
  }
  if (const std::string fault = keeping_fault(out_); !fault.empty()) {
    return refuse_to_keep(console, fault);
  }
  remark(console, "warning", rig_, remarks_on(file_, rig_).warnings);
  const StopOnSignal signals;
  const auto* bench = std::get_if<BenchRig>(&file_);
  if (bench != nullptr && !yes_) {
    const std::string why = why_not_to_turn(console, signals.token());
    if (signals.token().stop_requested()) return exit_codes::aborted;
    if (!why.empty()) return refuse_usage(console, "qualify: " + why);
  }
  const auto devices = bench != nullptr ? devices_of(*bench) : std::vector<std::string>();
  const auto lock = lock_devices(console, name(), devices, lock_folder_);
  if (!lock) return exit_codes::usage;
  return test_on(console, made, signals);
}

int QualifyCommand::test_on(Console& console, hal::Rig& rig, const StopOnSignal& signals) {
  const QualificationSection& section = *qualification_in(file_);
  SelfTestRecord record{.file = "",
                        .station = section.station,
                        .rig_kind = section.rig_kind,
                        .utc = utc_now(),
                        .software = software_version(),
                        .passed = false,
                        .reason = "",
                        .judged_by = limits_of(*section.self_test),
                        .steps = {}};
  try {
    record = keep_begin(out_, std::move(record));
  } catch (const std::system_error& error) {
    return refuse_disk(console, "qualify: no record could be kept: " + reason_of(error));
  }
  ProgressBar bar(console, progress_style(console, json_));
  SelfTestObserver observer(console, bar);
  const SelfTest test = run_self_test(*section.self_test, !no_tap_, rig, observer, signals.token());
  if (!test.must_exit) {
    bar.clear();
    return tell(console, test, std::move(record));
  }
  // With a thread in a call that never returns, no destructor of the rig may run.
  (void)try_for(longest_farewell, [&] { tell(console, test, std::move(record)); });
  std::_Exit(exit_code(test.ending));
}

// Keeps what it came to and tells it. One that somebody stopped before a step failed says nothing
// of the station.
int QualifyCommand::tell(Console& console, const SelfTest& test, SelfTestRecord record) {
  const SelfTestSpec& spec = *qualification_in(file_)->self_test;
  record.passed = test.passed(spec);
  record.reason = test.reason(spec);
  record.steps = test.steps;
  int code = exit_code(test.ending);
  if (test.ending.outcome == Outcome::pass && !record.passed) {
    code = exit_code({Outcome::error, ErrorKind::not_qualified, ""});
  }
  std::string not_kept;
  try {
    if (test.ending.outcome != Outcome::aborted || test.has_failed_step()) {
      keep_end(out_, record);
    } else {
      take_back(out_, record);
    }
  } catch (const std::system_error& error) {
    record.passed = false;
    not_kept =
        "qualify: how it ended cannot be kept, so it counts as not passed: " + reason_of(error);
    if (code == exit_codes::done) code = exit_code({Outcome::error, ErrorKind::none, ""});
  }
  if (!not_kept.empty()) record.reason = not_kept;
  console.out << (json_ ? self_test_to_json(record, test.ending, code)
                        : self_test_text(console, record))
              << std::flush;
  if (!not_kept.empty()) complain(console, "rvbench: " + not_kept);
  if (!test.must_exit && not_kept.empty()) warn_of_rest(console);
  return code;
}

// A self-test alone may not be all.
void QualifyCommand::warn_of_rest(Console& console) const {
  for (const RequirementState& state : qualification_now(file_, out_).requirements) {
    if (!state.blocks || state.requirement == "self_test") continue;
    console.err << "rvbench: note: not qualified yet: " << state.sentence << '\n';
  }
}

int QualifyCommand::status(Console& console) const {
  const Qualification qualification = qualification_now(file_, out_);
  const QualificationSection* section = qualification_in(file_);
  console.out << (json_ ? qualification_to_json(qualification,
                                                section != nullptr ? section->station : "")
                        : qualification_text(console, qualification));
  const auto refusal = qualification.refusal();
  return refusal ? exit_code(*refusal) : exit_codes::done;
}

int QualifyCommand::calibrate(Console& console) const {
  const auto refuse = [&](const std::string& what) {
    return refuse_usage(console, "qualify calibrate: " + what);
  };
  if (!is_positive(console, "qualify calibrate: --sensitivity", calibration_.sensitivity)) {
    return exit_codes::usage;
  }
  std::vector<std::string> channels;
  for (const ChannelInfo& channel : channels_of(file_)) channels.push_back(channel.name);
  const auto read =
      calibration_record(calibration_, qualification_in(file_)->station, channels, utc_now());
  if (read.index() == 1) return refuse(std::get<1>(read));
  const CalibrationRecord& record = std::get<0>(read);
  if (const std::string fault = keeping_fault(out_); !fault.empty()) {
    return refuse_to_keep(console, fault);
  }
  try {
    keep_record(out_, record);
  } catch (const std::system_error& error) {
    return refuse_disk(console,
                       "qualify calibrate: the record cannot be kept: " + reason_of(error));
  }
  console.out << "station " << record.station << ": " << record.channel << " by certificate "
              << record.certificate << ", valid until " << day_of(record.valid_until_utc) << '\n';
  // What the record is worth for this rig: an expired one, or another sensitivity.
  for (const RequirementState& state : qualification_now(file_, out_).requirements) {
    if (state.blocks && state.requirement == calibration_of(record.channel)) {
      console.err << "rvbench: warning: " << state.sentence << '\n';
    }
  }
  return exit_codes::done;
}

// Once it was ahead: nothing is kept before somebody has looked at it.
int QualifyCommand::clock(Console& console) const {
  const std::string& by = calibration_.by;
  if (by.empty()) return refuse_usage(console, "qualify clock: who says so? give --by NAME");
  try {
    keep_clock_record(out_, by);
  } catch (const std::system_error& error) {
    return refuse_disk(console, "qualify clock: that cannot be kept: " + reason_of(error));
  }
  console.out << "by " << by << ", it is " << readable_utc(utc_now()) << " (UTC)\n";
  return exit_codes::done;
}

int QualifyCommand::records(Console& console) const {
  const StationRecords kept = read_station_records(out_);
  console.out << (json_ ? calibrations_to_json(kept.calibrations)
                        : calibrations_text(kept.calibrations));
  for (const DamagedRecord& damaged : kept.damaged) {
    complain(console, "rvbench: " + damaged.sentence);
  }
  return kept.damaged.empty() ? exit_codes::done : exit_codes::bad_file;
}

}  // namespace

std::unique_ptr<Command> make_qualify_command(std::filesystem::path lock_folder) {
  return std::make_unique<QualifyCommand>(std::move(lock_folder));
}

}  // namespace rvbench::bench
