#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <mutex>
#include <system_error>

#include "bench/campaign.hpp"
#include "bench/commands/commands.hpp"
#include "bench/explanation_json.hpp"
#include "bench/file_kind.hpp"
#include "bench/progress_bar.hpp"
#include "bench/report/explanation_page.hpp"
#include "bench/run_folder.hpp"
#include "bench/software_version.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/twin.hpp"
#include "sim/plant_files.hpp"
#include "sim/plant_json.hpp"

namespace rvbench::bench {
namespace {

class ExplainCommand final : public Command {
 public:
  std::string name() const override { return "explain"; }
  std::string summary() const override {
    return "says which physics a plant model leaves out of recordings, and models it";
  }
  std::string examples() const override {
    return "  rvbench explain --plant emps --rec emps_campaign.json --out explained\n"
           "  rvbench explain --plant my_axis.json --rec run1.csv run2.csv --rate 1000\n";
  }
  std::vector<Option> options() override {
    return {{"--plant", "plant: " + listed(names_of(sim::plant_files())) + ", or a plant file",
             &plant_, true},
            {"--rec", "a campaign file, or recordings", &files_, true},
            {"--rate", "sample rate [Hz]; default: what the file states", &rate_Hz_},
            {"--out", "folder for explain.json, explain.html and plant_updated.json", &out_},
            {"--json", "one JSON document on standard output", &json_}};
  }
  int run(Console& console) override;

 private:
  bool names_campaign() const {
    return files_.size() == 1 && std::filesystem::path(files_[0]).extension() == ".json";
  }
  CampaignOrRefusal campaign() const {
    return names_campaign() ? read_campaign(files_[0])
                            : campaign_of(files_, rate_Hz_.value_or(not_known));
  }
  analysis::Explanation explained(Console& console, Twin& twin) const;
  int tell(Console& console, const Campaign& campaign, const Twin& twin,
           const analysis::Explanation& explanation) const;
  void print(Console& console, const analysis::Explanation& explanation) const;
  void print_records(Console& console, const std::vector<RecordError>& records) const;
  void print_self_null(Console& console, const analysis::SelfNull& self_null) const;
  void write_out(const Twin& twin, const analysis::Explanation& explanation,
                 const Comparisons& comparisons, ExplainFacts& facts) const;

  std::string plant_;
  std::vector<std::string> files_;
  std::optional<double> rate_Hz_;
  std::string out_;
  bool json_ = false;
};

void tell_notes(Console& console, const Campaign& campaign) {
  for (const std::string& note : campaign.notes) console.err << "note: " << note << '\n';
}

std::string estimate_text(const analysis::Estimate& e) {
  return fmt::format("{} {:.4g} {} (90 %: {:.4g} to {:.4g})", e.name, e.value, e.unit, e.low,
                     e.high);
}

std::string predicted_text(const PredictedMean& mean, const std::string& unit) {
  return fmt::format("      mean {:.6g}, predicted {:.6g} ± {:.2g} {} (90 %){}\n", mean.measured,
                     mean.predicted, mean.half_width, unit,
                     mean.is_inside()
                         ? ""
                         : ": outside, so the law ends before, or an input is not what it is said "
                           "to be (see the notes)");
}

void ExplainCommand::print(Console& console, const analysis::Explanation& e) const {
  const bool quiet = e.verdict == analysis::ExplainVerdict::null;
  console.out << paint(console, quiet ? Tone::good : Tone::strong, to_string(e.verdict)) << "  "
              << e.reason << '\n';
  for (const analysis::ExplainedEffect& effect : e.effects) {
    console.out << fmt::format("\n  {}: {} ({})\n", to_string(effect.verdict), effect.name,
                               effect.where);
    for (const analysis::Estimate& p : effect.parameters) {
      console.out << "    " << estimate_text(p) << '\n';
    }
    console.out << fmt::format(
        "    held-out error {:.3g} -> {:.3g} %; log density {:+.1f} ± {:.1f}; best in {:.0f} % of "
        "bootstraps\n",
        100 * effect.error_before, 100 * effect.error_after, effect.over_before.delta,
        effect.over_before.se, 100 * effect.share_won);
    for (const analysis::RivalEffect& rival : effect.rivals) {
      console.out << fmt::format("    rival {}: worse by {:.1f} ± {:.1f}\n", rival.name,
                                 rival.behind.delta, rival.behind.se);
    }
    if (!effect.next_experiment.empty()) {
      console.out << "    would decide: " << effect.next_experiment << '\n';
    }
  }
  if (e.ceiling_after.known) {
    console.out << fmt::format("\n  a law of any shape would reach {:.3g} % held out\n",
                               100 * e.ceiling_after.error);
  }
  for (const analysis::Estimate& p : e.nuisances) {
    console.out << "  nuisance " << estimate_text(p) << '\n';
  }
}

void ExplainCommand::print_records(Console& console,
                                   const std::vector<RecordError>& records) const {
  console.out << "\n  error by record, as the plant was -> with what was left out\n";
  for (const RecordError& r : records) {
    console.out << fmt::format("    {:31} {:9} {:.4g} -> {:.4g} {} ({:.3g} -> {:.3g} %){}\n",
                               r.record, r.channel, r.before, r.after, r.unit,
                               100 * r.relative_before, 100 * r.relative_after,
                               r.learned_from ? "" : ", only predicted");
    if (r.mean) console.out << predicted_text(*r.mean, r.unit);
  }
}

void ExplainCommand::print_self_null(Console& console, const analysis::SelfNull& self_null) const {
  if (!self_null.known) return;
  console.out << fmt::format("\n  one repeat as the model of another: {} ({:.3g} % apart)\n",
                             self_null.found.empty() ? "NULL" : "something changed",
                             100 * self_null.error);
  for (const analysis::Estimate& p : self_null.found) {
    console.out << "    " << estimate_text(p) << '\n';
  }
}

void ExplainCommand::write_out(const Twin& twin, const analysis::Explanation& explanation,
                               const Comparisons& comparisons, ExplainFacts& facts) const {
  const std::filesystem::path folder = out_;
  const analysis::Fit& fit = explanation.selection.fit;
  if (fit.residuals.size() > 0) {
    facts.plant_updated = (folder / "plant_updated.json").string();
    write_file(facts.plant_updated, sim::write_plant(twin.plant_with(fit.effects, fit.values)));
  }
  write_file(folder / "explain.json", explanation_to_json(explanation, facts));
  write_file(folder / "explain.html", make_explanation_page(explanation, facts, comparisons));
}

// @throws Twin::Interrupted
analysis::Explanation ExplainCommand::explained(Console& console, Twin& twin) const {
  const StopOnSignal signals;
  twin.stop_on(signals.token());
  ProgressBar bar(console, progress_style(console, json_));
  analysis::SelectionOptions options;
  std::mutex one_at_a_time;
  options.progress = [&](const std::string& stage, double share, const std::string& doing) {
    const std::scoped_lock locked(one_at_a_time);
    bar.show(stage, share, doing);
  };
  return analysis::explain(twin, options);
}

int ExplainCommand::tell(Console& console, const Campaign& campaign, const Twin& twin,
                         const analysis::Explanation& explanation) const {
  const Comparisons comparisons = compare(twin, explanation.selection);
  ExplainFacts facts{plant_,
                     software_version(),
                     "",
                     record_errors(twin, explanation.selection, comparisons),
                     campaign.notes,
                     campaign.hashes};
  try {
    if (!out_.empty()) write_out(twin, explanation, comparisons, facts);
  } catch (const std::system_error& error) {
    return refuse_usage(console, std::string("explain: --out: ") + error.what());
  }
  if (json_) {
    console.out << explanation_to_json(explanation, facts);
  } else {
    tell_notes(console, campaign);
    print(console, explanation);
    print_records(console, facts.records);
    print_self_null(console, explanation.self_null);
    if (!out_.empty()) console.out << "\nReport: " << out_ << "/explain.html" << '\n';
  }
  const bool refused = explanation.verdict == analysis::ExplainVerdict::not_resolvable;
  return refused ? exit_codes::data_refused : exit_codes::done;
}

int ExplainCommand::run(Console& console) {
  if (!is_positive(console, "--rate", rate_Hz_)) return exit_codes::usage;
  if (rate_Hz_ && names_campaign()) {
    return refuse_usage(console, "explain: a campaign file states its rates: leave --rate out");
  }
  auto plant = sim::read_plant(plant_);
  if (plant.index() == 1) return refuse_file(console, plant_, std::get<1>(plant));
  auto read = campaign();
  if (const auto* refusal = std::get_if<Refusal>(&read)) {
    if (!refusal->of_recordings) return refuse_file(console, files_.front(), refusal->faults);
    for (const hal::ConfigFault& fault : refusal->faults) complain(console, fault.message);
    return exit_codes::data_refused;
  }
  const Campaign& campaign = std::get<0>(read);
  auto made = make_twin(std::get<0>(std::move(plant)), campaign);
  if (const auto* refusal = std::get_if<Refusal>(&made)) {
    refuse_file(console, plant_, refusal->faults);
    tell_notes(console, campaign);
    return refusal->of_recordings ? exit_codes::data_refused : exit_codes::bad_file;
  }
  Twin& twin = *std::get<0>(made);
  std::error_code unusable;
  if (!out_.empty()) std::filesystem::create_directories(out_, unusable);
  if (!unusable && !out_.empty() && access(out_.c_str(), W_OK) != 0) {
    unusable.assign(errno, std::generic_category());
  }
  if (unusable) return refuse_usage(console, "explain: --out " + out_ + ": " + unusable.message());
  try {
    return tell(console, campaign, twin, explained(console, twin));
  } catch (const Twin::Interrupted&) {
    complain(console, "rvbench: explain: interrupted; nothing was written");
    return exit_codes::aborted;
  }
}

}  // namespace

std::unique_ptr<Command> make_explain_command() { return std::make_unique<ExplainCommand>(); }

}  // namespace rvbench::bench
