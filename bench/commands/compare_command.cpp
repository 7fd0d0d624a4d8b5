#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "analysis/compare/comparison.hpp"
#include "bench/commands/commands.hpp"
#include "bench/compare_json.hpp"
#include "bench/compare_page.hpp"
#include "bench/compare_side.hpp"
#include "bench/compare_text.hpp"
#include "bench/file_kind.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/kinematics_files.hpp"
#include "bench/out_folder.hpp"
#include "bench/progress_bar.hpp"
#include "bench/software_version.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/text_file.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

using analysis::Comparison;
using analysis::RecordLevels;

struct TwoNames {
  std::string a, b;
};

// "X105_DE_time=X209_DE_time"
std::optional<TwoNames> split(const std::string& names) {
  const auto at = names.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == names.size()) return std::nullopt;
  return TwoNames{names.substr(0, at), names.substr(at + 1)};
}

class CompareCommand final : public Command {
 public:
  std::string name() const override { return "compare"; }
  std::string summary() const override { return "before and after, point by point"; }
  std::string examples() const override {
    return "  rvbench compare runs/A17/20260102T030405Z runs/A17/20260202T030405Z\n"
           "  rvbench compare runs/golden/20251203T080000Z runs/A18/20260102T030405Z --out "
           "compared\n"
           "  rvbench compare IR007_0.mat IR021_0.mat --kinematics cwru_6205 --rate 12000 \\\n"
           "      --same X105_DE_time=X209_DE_time\n";
  }
  std::vector<Option> options() override {
    return {
        {"A", "before: run folder, recording, or folder of recordings", &a_, true},
        {"B", "after: likewise", &b_, true},
        {"--kinematics",
         "machine: " + hal::listed(names_of(kinematics_files())) +
             ", or a kinematics file; a run folder has its own",
         &kinematics_file_},
        {"--speed", "speed of the input shaft [rpm]; default: what the files state", &speed_rpm_},
        {"--rate", "sample rate [Hz]; default: what the files state", &rate_Hz_},
        {"--same", "sensors that B calls by another name: NAME_IN_A=NAME_IN_B", &same_},
        {"--least", "a change that matters [dB]; default: 1", &least_dB_},
        {"--out", "folder for compare.json and compare.html; default: none are written", &out_},
        {"--json", "one JSON document on standard output", &json_}};
  }
  int run(Console& console) override;

 private:
  struct Answer {
    Comparison comparison;
    CompareFacts facts;
  };
  std::variant<Answer, int> compared(Console& console);
  std::variant<Answer, int> held_against(Console& console, OutFolder& folder);
  int check_options(Console& console, OutFolder& folder);
  int open_sides(Console& console);
  int join_names(Console& console);
  int find_kinematics(Console& console);
  std::optional<std::vector<RecordLevels>> measured(Console& console, CompareSide& side,
                                                    const std::string& name) const;
  int refuse_nothing_in_common(Console& console, const Comparison& comparison) const;
  void write_out(const Answer& answer);

  std::string a_, b_;
  std::vector<std::string> same_;
  std::string kinematics_file_;
  std::optional<double> speed_rpm_, rate_Hz_, least_dB_;
  std::string out_;
  bool json_ = false;
  std::vector<CompareSide> sides_;  // A, B
  analysis::Kinematics kinematics_;
  analysis::CompareOptions options_;
  std::stop_token stop_;
};

int CompareCommand::run(Console& console) {
  options_.least_dB = least_dB_.value_or(options_.least_dB);
  const auto found = compared(console);
  if (const int* refused = std::get_if<int>(&found)) return *refused;
  const auto& [comparison, facts] = std::get<Answer>(found);
  if (json_) {
    console.out << comparison_to_json(comparison, facts);
  } else {
    print_comparison(console, comparison, kinematics_);
    if (!out_.empty()) console.out << "\nReport: " << out_ << "/compare.html\n";
  }
  return exit_codes::done;
}

// Compared, and written where it is to be; or the exit code that says why not. Signals wait for the
// next step only until then: who reads the answer may go away.
std::variant<CompareCommand::Answer, int> CompareCommand::compared(Console& console) {
  const StopOnSignal signals;
  OutFolder folder;
  stop_ = signals.token();
  try {
    return held_against(console, folder);
  } catch (const Interrupted&) {
    return tell_interrupted(console, name());
  }
}

std::variant<CompareCommand::Answer, int> CompareCommand::held_against(Console& console,
                                                                       OutFolder& folder) {
  if (const int refused = check_options(console, folder); refused != exit_codes::done)
    return refused;
  if (const int refused = open_sides(console); refused != exit_codes::done) return refused;
  if (const int refused = find_kinematics(console); refused != exit_codes::done) return refused;
  const auto a = measured(console, sides_[0], "A");
  const auto b = a ? measured(console, sides_[1], "B") : std::nullopt;
  if (!b) return exit_codes::data_refused;
  Answer answer{analysis::compare(*a, *b, analysis::quantities_to_compare(kinematics_), options_),
                {a_, b_, kinematics_, software_version(), {}}};
  for (const CompareSide& side : sides_) {
    std::ranges::copy(side.left_out(), std::back_inserter(answer.comparison.left_out));
    std::ranges::copy(side.hashes(), std::back_inserter(answer.facts.hashes));
  }
  if (answer.comparison.changes.empty()) {
    return refuse_nothing_in_common(console, answer.comparison);
  }
  try {
    if (!out_.empty()) write_out(answer);
  } catch (const std::system_error& error) {
    return refuse_usage(console, std::string("compare: --out: ") + error.what());
  }
  return answer;
}

// What can be known to be wrong before anything is read.
int CompareCommand::check_options(Console& console, OutFolder& folder) {
  if (!is_positive(console, "--speed", speed_rpm_) || !is_rate(console, rate_Hz_)) {
    return exit_codes::usage;
  }
  if (!(options_.least_dB >= 0 && options_.least_dB < options_.blind_dB)) {
    return refuse_usage(console, "compare: --least must be 0 or above, and below " +
                                     fmt::format("{:g} dB", options_.blind_dB));
  }
  for (const std::string& names : same_) {
    if (split(names)) continue;
    return refuse_usage(console, "compare: --same " + names + ": give a name in A, =, one in B");
  }
  if (out_.empty()) return exit_codes::done;
  const std::string why = folder.make(out_, {"plan.json", "compare.json", "compare.html"});
  return why.empty() ? exit_codes::done
                     : refuse_usage(console, "compare: --out " + out_ + ": " + why);
}

int CompareCommand::open_sides(Console& console) {
  const hal::RecordingHints hints{.rate_Hz = rate_Hz_.value_or(not_known),
                                  .speed_rpm = speed_rpm_.value_or(not_known)};
  for (const std::string& path : {a_, b_}) {
    auto opened = CompareSide::open(path, hints, stop_);
    if (const auto* refusal = std::get_if<JudgeRefusal>(&opened)) {
      complain(console, "rvbench: compare: " + refusal->reason);
      return refusal->exit_code;
    }
    sides_.push_back(std::get<0>(std::move(opened)));
    if (sides_.back().is_run() && (speed_rpm_ || rate_Hz_)) {
      console.err << "rvbench: note: " << path
                  << " is a run folder, which states its own speeds and rates: --speed and --rate "
                     "are not used\n";
    }
  }
  return join_names(console);
}

// Each name is that of one sensor.
int CompareCommand::join_names(Console& console) {
  std::set<std::string> of_a, of_b;
  for (const std::string& names : same_) {
    const auto [a, b] = *split(names);
    const auto refuse = [&](const std::string& why) {
      return refuse_usage(console, "compare: --same " + names + ": " + why);
    };
    const Result<bool> in_a = sides_[0].has_channel(a), in_b = sides_[1].has_channel(b);
    for (const auto* known : {&in_a, &in_b}) {
      if (!*known) return refuse_data(console, "compare: " + known->error().where);
    }
    if (!in_a.value()) return refuse(a_ + " has no channel " + a);
    if (!in_b.value()) return refuse(b_ + " has no channel " + b);
    if (!of_a.insert(a).second) return refuse(a + " is given twice");
    if (!of_b.insert(b).second) return refuse(b + " is given twice");
  }
  for (const std::string& names : same_) {
    const auto [a, b] = *split(names);
    if (of_b.contains(a)) continue;  // it gets another name itself
    const Result<bool> merged = sides_[1].has_channel(a);
    if (!merged) return refuse_data(console, "compare: " + merged.error().where);
    if (!merged.value()) continue;
    return refuse_usage(console, "compare: --same " + names + ": " + b_ + " has both " + a +
                                     " and " + b +
                                     ": say with --same which one of A the former is");
  }
  for (const std::string& names : same_) sides_[1].rename(split(names)->b, split(names)->a);
  return exit_codes::done;
}

// One machine for both: its lines are what is compared.
int CompareCommand::find_kinematics(Console& console) {
  std::vector<std::pair<std::string, analysis::Kinematics>> stated;
  if (!kinematics_file_.empty()) {
    auto read = read_kinematics(kinematics_file_);
    if (read.index() == 1) return refuse_file(console, kinematics_file_, std::get<1>(read));
    stated.emplace_back("--kinematics", std::get<0>(std::move(read)));
  }
  for (const CompareSide& side : sides_) {
    if (side.kinematics()) {
      stated.emplace_back(side.path(), *side.kinematics());
    } else if (kinematics_file_.empty()) {
      return refuse_usage(console, "compare: " + side.path() +
                                       " is no run folder: give its machine with --kinematics");
    }
  }
  for (const auto& [who, machine] : stated) {
    if (is_same_machine(machine, stated.front().second)) continue;
    return refuse_data(console, "compare: another machine: " + stated.front().first + " is of " +
                                    stated.front().second.machine + ", " + who + " is of " +
                                    machine.machine + ", and their lines differ");
  }
  kinematics_ = stated.front().second;
  return exit_codes::done;
}

// Record by record: a whole run does not fit into memory.
std::optional<std::vector<RecordLevels>> CompareCommand::measured(Console& console,
                                                                  CompareSide& side,
                                                                  const std::string& name) const {
  ProgressBar bar(console, progress_style(console, json_));
  const std::vector<analysis::Quantity> quantities = analysis::quantities_to_compare(kinematics_);
  std::vector<RecordLevels> levels;
  for (std::size_t i = 0; i < side.size(); ++i) {
    end_if_stopped(stop_);
    const Result<Recording> record = side.read(i);
    if (!record) {
      bar.clear();
      refuse_data(console, "compare: " + record.error().where);
      return std::nullopt;
    }
    bar.show("measure " + name, double(i) / double(side.size()), record.value().source);
    levels.push_back(analysis::measure_levels(record.value(), kinematics_, quantities));
  }
  bar.clear();
  return levels;
}

int CompareCommand::refuse_nothing_in_common(Console& console, const Comparison& comparison) const {
  for (const analysis::NotCompared& out : comparison.left_out) {
    console.err << "rvbench: note: " << out.where << ": " << out.why << '\n';
  }
  return refuse_data(console, comparison.points.empty()
                                  ? "compare: A and B have no point of speed and load in common"
                                  : "compare: A and B have no channel in common that can be "
                                    "compared");
}

// The page asks for more of the records and may be stopped: nothing is written before it is whole.
// A folder that has compare.json has all.
void CompareCommand::write_out(const Answer& answer) {
  const auto& [comparison, facts] = answer;
  const auto spectra = [&](std::size_t point,
                           const std::string& channel) -> std::optional<SpectrumPair> {
    end_if_stopped(stop_);
    const analysis::MatchedPoint& at = answer.comparison.points[point];
    auto a = sides_[0].mean_spectrum(at.a.records, channel, kinematics_);
    auto b = sides_[1].mean_spectrum(at.b.records, channel, kinematics_);
    if (!a || !b) return std::nullopt;
    return SpectrumPair{std::move(*a), std::move(*b)};
  };
  const std::string page = make_compare_page(comparison, facts, spectra);
  const std::filesystem::path folder = out_;
  write_file(folder / "compare.html", page);
  write_file(folder / "compare.json", comparison_to_json(comparison, facts));
}

}  // namespace

std::unique_ptr<Command> make_compare_command() { return std::make_unique<CompareCommand>(); }

}  // namespace rvbench::bench
