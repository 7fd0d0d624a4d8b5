#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "analysis/table4.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/sound_words.hpp"
#include "bench/commands/table_words.hpp"
#include "bench/file_kind.hpp"
#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/kinematics_files.hpp"
#include "bench/out_folder.hpp"
#include "bench/progress_bar.hpp"
#include "bench/published_catalogue.hpp"
#include "bench/recordings_to_judge.hpp"
#include "bench/report/report.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_results.hpp"
#include "bench/same_recording.hpp"
#include "bench/sha256.hpp"
#include "bench/software_version.hpp"
#include "bench/sound_units.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/summary.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t most_notes = 8;  // told before the analysis

class JudgeCommand final : public Command {
 public:
  std::string name() const override { return "judge"; }
  std::string summary() const override { return "diagnoses stored recordings of one machine"; }
  std::string examples() const override {
    return "  rvbench judge IR007_0.mat --kinematics cwru_6205 --rate 12000 --speed 1797\n"
           "  rvbench judge suspect.h5 --kinematics two_stage --sound good/\n"
           "  rvbench judge runs/A17/20260102T030405Z/recording.h5 --kinematics rv20e --json\n";
  }
  std::vector<Option> options() override {
    std::vector<Option> options{
        {"REC", "recordings; several are points of one judgement", &files_, true},
        {"--kinematics",
         "machine: " + hal::listed(names_of(kinematics_files())) + ", or a kinematics file",
         &kinematics_, true},
        {"--speed", "speed of the input shaft [rpm]; default: what the file states", &speed_rpm_},
        {"--rate", "sample rate [Hz]; default: what the file states", &rate_Hz_},
        {"--channel", "judge this channel only; default: all accelerations", &channel_},
        {"--catalogue",
         "orders to match: derived, or Table 4 of the RV-20E as published; default: derived",
         &catalogue_,
         false,
         {"derived", "published"}},
        {"--sound",
         "sound units of the same kind, whose scatter sets the limits: recordings, folders of "
         "runs, of answers of --out or of recordings, or serials",
         &sound_},
        {"--runs", "folder of run folders, where serials are looked for; default: " + runs_,
         &runs_},
        {"--out", "folder for verdict.json and report.html; default: none are written", &out_},
        {"--json", "one JSON document on standard output", &json_}};
    table_.add_to(options);
    return options;
  }
  int run(Console& console) override;

 private:
  int read_machine(Console& console);
  int check_options(Console& console, OutFolder& folder) const;
  int load(Console& console);
  std::variant<std::vector<Recording>, JudgeRefusal> read_files(
      const std::vector<std::string>& files) const;
  int check_points(Console& console, const Judgement& judgement) const;
  int learn_from_sound(Console& console);
  void tell_notes(Console& console) const;
  std::variant<Judgement, int> judged(Console& console);
  bool is_published() const { return catalogue_ == "published"; }
  analysis::Kinematics published_for(const Recording& record) const;
  Judgement judge(Console& console, const std::vector<Recording>& records, bool published,
                  const char* doing = "judge") const;
  Judgement judge_by_catalogue(Console& console) const;
  // The machine by whose lines it was judged.
  analysis::Kinematics used() const {
    return is_published() ? published_for(records_.front()) : derived_;
  }
  std::vector<std::string> write_out(const Judgement& judgement) const;

  std::vector<std::string> files_;
  std::string kinematics_;
  std::optional<double> speed_rpm_;
  std::optional<double> rate_Hz_;
  std::string channel_;
  std::string catalogue_ = "derived";
  std::vector<std::string> sound_;
  TableWords table_;
  std::string runs_ = "runs";
  std::string out_;
  bool json_ = false;
  analysis::Kinematics derived_;
  SoundUnits baseline_;
  std::vector<Recording> records_;
  std::stop_token stop_;
};

int JudgeCommand::run(Console& console) {
  const auto answer = judged(console);
  if (const int* refused = std::get_if<int>(&answer)) return *refused;
  const auto& judgement = std::get<Judgement>(answer);
  print_unwritten(console, judgement);
  if (json_) {
    console.out << judgement_to_json(judgement);
  } else {
    print_summary(console, judgement, used(), out_);
  }
  return exit_code(judgement.ending);
}

// Judged, and written where it is to be; or the exit code that says why not. Signals wait for the
// next step only until then: who reads the answer may go away.
std::variant<Judgement, int> JudgeCommand::judged(Console& console) {
  const StopOnSignal signals;
  OutFolder folder;
  stop_ = signals.token();
  try {
    if (const int refused = check_options(console, folder); refused != exit_codes::done)
      return refused;
    if (const int refused = read_machine(console); refused != exit_codes::done) return refused;
    if (const int refused = load(console); refused != exit_codes::done) return refused;
    if (const int refused = learn_from_sound(console); refused != exit_codes::done) return refused;
    Judgement judgement = judge_by_catalogue(console);
    if (const int refused = check_points(console, judgement); refused != exit_codes::done) {
      return refused;
    }
    if (const std::string file = baseline_.file_with_samples_of(judgement); !file.empty()) {
      return refuse_data(console, "--sound: " + file + " has the samples that are judged");
    }
    if (!out_.empty()) {
      tell_in_files(judgement, [this](const Judgement& told) { return write_out(told); });
    }
    return judgement;
  } catch (const Interrupted&) {
    return tell_interrupted(console, name());
  }
}

int JudgeCommand::read_machine(Console& console) {
  auto kinematics = read_kinematics(kinematics_);
  if (kinematics.index() == 1) return refuse_file(console, kinematics_, std::get<1>(kinematics));
  derived_ = std::get<0>(std::move(kinematics));
  if (is_published() && !is_of_table4(derived_)) {
    return refuse_usage(console, "judge: --catalogue published is Table 4 of the RV-20E, and " +
                                     derived_.machine + " is none");
  }
  return exit_codes::done;
}

// What can be known to be wrong before anything is read.
int JudgeCommand::check_options(Console& console, OutFolder& folder) const {
  if (!is_positive(console, "--speed", speed_rpm_) || !is_rate(console, rate_Hz_)) {
    return exit_codes::usage;
  }
  if (out_.empty()) return exit_codes::done;
  const std::string why = folder.make(out_, {"verdict.json", "report.html"});
  return why.empty() ? exit_codes::done
                     : refuse_usage(console, "judge: --out " + out_ + ": " + why);
}

// Sets the limits by sound units. @return why not, or done
int JudgeCommand::learn_from_sound(Console& console) {
  if (sound_.empty()) return exit_codes::done;
  const auto judge_unit =
      [&](const std::filesystem::path& file) -> std::variant<Judgement, std::string> {
    auto read = read_files({file.string()});
    if (auto* refusal = std::get_if<JudgeRefusal>(&read)) return std::move(refusal->reason);
    return judge(console, std::get<0>(read), false, "sound unit");
  };
  auto units = sound_units(console, {sound_, runs_, derived_.machine, judge_unit});
  if (const int* refused = std::get_if<int>(&units)) return *refused;
  baseline_ = std::get<SoundUnits>(std::move(units));
  derived_ = with_sound_units(derived_, baseline_.diagnoses());
  return exit_codes::done;
}

std::variant<std::vector<Recording>, JudgeRefusal> JudgeCommand::read_files(
    const std::vector<std::string>& files) const {
  return recordings_to_judge({.files = files,
                              .hints = {.rate_Hz = rate_Hz_.value_or(not_known),
                                        .speed_rpm = speed_rpm_.value_or(not_known),
                                        .table = table_.hints()},
                              .channel = channel_,
                              .stop = stop_});
}

// Reads every file, and tells what was not obvious about them. @return why not, or done
int JudgeCommand::load(Console& console) {
  auto read = read_files(files_);
  if (const auto* refusal = std::get_if<JudgeRefusal>(&read)) {
    return refusal->exit_code == exit_codes::usage ? refuse_usage(console, refusal->reason)
                                                   : refuse_data(console, refusal->reason);
  }
  records_ = std::get<0>(std::move(read));
  tell_notes(console);
  for (const Recording& record : records_) {
    if (is_published() && !std::isfinite(record.speed_rpm)) {
      return refuse_usage(console, record.source +
                                       " states no mean speed, by which a column of Table 4 could "
                                       "be chosen: give it with --speed RPM");
    }
  }
  return exit_codes::done;
}

// The same of several points of one file is told once; all are among the quality notes.
void JudgeCommand::tell_notes(Console& console) const {
  std::set<std::string> told;
  for (const Recording& record : records_) {
    const std::string file = record.source.substr(0, record.source.find('#'));
    for (const std::string& note : record.notes) {
      const bool is_new = told.insert(file + ": " + note).second;
      if (!is_new || told.size() > most_notes) continue;
      console.err << "rvbench: note: " << file << ": " << note << '\n';
    }
  }
  if (told.size() > most_notes) {
    console.err << "rvbench: and " << told.size() - most_notes << " more notes\n";
  }
}

// A recording that is given twice would confirm itself. @return why not, or done
int JudgeCommand::check_points(Console& console, const Judgement& judgement) const {
  for (auto point = judgement.points.begin(); point != judgement.points.end(); ++point) {
    const auto same = std::find_if(judgement.points.begin(), point, [&](const JudgedPoint& other) {
      return are_of_one_recording(*point, other);
    });
    if (same == point) continue;
    return refuse_data(console, point->examination.source + " has the samples of " +
                                    same->examination.source + ": give each recording once");
  }
  return exit_codes::done;
}

analysis::Kinematics JudgeCommand::published_for(const Recording& record) const {
  return analysis::published_table4(std::abs(record.speed_rpm));
}

Judgement JudgeCommand::judge(Console& console, const std::vector<Recording>& records,
                              bool published, const char* doing) const {
  ProgressBar bar(console, progress_style(console, json_));
  Judgement judgement;
  judgement.facts.software = software_version();
  judgement.facts.started_utc = utc_now();
  for (std::size_t i = 0; i < records.size(); ++i) {
    end_if_stopped(stop_);
    const Recording& record = records[i];
    bar.show(doing, double(i) / double(records.size()), record.source);
    JudgedPoint point = judge_point(record, published ? published_for(record) : derived_,
                                    {.channels_may_fail = std::numeric_limits<int>::max()});
    for (const std::string& note : record.notes) {
      point.examination.quality.push_back({record.source, note, false});
    }
    judgement.points.push_back(std::move(point));
  }
  bar.clear();
  conclude(judgement, published ? published_for(records.front()) : derived_, {},
           {Outcome::pass, ErrorKind::none, "every recording was read"});
  return judgement;
}

Judgement JudgeCommand::judge_by_catalogue(Console& console) const {
  Judgement derived = judge(console, records_, false);
  demand_confirmation(derived, derived_);
  if (!is_published()) return derived;
  Judgement published = judge(console, records_, true);
  hold_against_derived(published, derived);
  return published;
}

// The verdict comes last: a folder that has one is whole.
std::vector<std::string> JudgeCommand::write_out(const Judgement& judgement) const {
  const std::filesystem::path folder = out_;
  ReportInput input;
  input.judgement = judgement;
  input.kinematics = used();
  input.load = [this](std::size_t point) {
    end_if_stopped(stop_);
    return std::optional<Recording>(records_.at(point));
  };
  const auto add_hash = [&](const std::string& file, const char* what) {
    const std::optional<std::string> hash = sha256_of_file(file);
    if (hash) input.hashes.emplace_back(file + what, *hash);
  };
  for (const std::string& file : files_) add_hash(file, "");
  for (const std::string& file : baseline_.files()) add_hash(file, " (sound unit)");
  const auto verdict = folder / "verdict.json";
  const auto report = folder / "report.html";
  return unwritten_files(
      folder, {{"report.html", [&] { write_file(report, make_report(input)); }},
               {"verdict.json", [&] { write_file(verdict, judgement_to_json(judgement)); }}});
}

}  // namespace

std::unique_ptr<Command> make_judge_command() { return std::make_unique<JudgeCommand>(); }

}  // namespace rvbench::bench
