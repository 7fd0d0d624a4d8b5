#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <optional>
#include <system_error>

#include "bench/campaign_points.hpp"
#include "bench/channel_fault.hpp"
#include "bench/commands/commands.hpp"
#include "bench/explanation_json.hpp"
#include "bench/explanation_text.hpp"
#include "bench/file_kind.hpp"
#include "bench/on_disk.hpp"
#include "bench/out_folder.hpp"
#include "bench/planned_inputs.hpp"
#include "bench/progress_bar.hpp"
#include "bench/report/explanation_page.hpp"
#include "bench/rig_file.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "bench/software_version.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/text_file.hpp"
#include "bench/twin.hpp"
#include "hal/did_you_mean.hpp"
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
    return "  rvbench explain runs/A17/20260102T030405Z    a run beside its simulated bench\n"
           "  rvbench explain --plant emps --rec emps_campaign.json --out explained\n"
           "  rvbench explain --plant my_axis.json --rec run1.csv run2.csv --rate 1000\n";
  }
  std::vector<Option> options() override {
    return {{"RUN", "run folder; or --rec", &run_},
            {"--plant",
             "plant: " + hal::listed(names_of(sim::plant_files())) +
                 ", or a plant file; default for RUN: that of its rig",
             &plant_},
            {"--rec", "a campaign file, or recordings", &files_},
            {"--rate", "sample rate [Hz]; default: what the file states", &rate_Hz_},
            {"--effects",
             fmt::format("effects to look for, 1 to 20 at most; default: {}",
                         analysis::SelectionOptions().most_effects),
             &effects_,
             false,
             {},
             20,
             1},
            {"--out",
             "folder for explain.json, explain.html and plant_updated.json; default for RUN: RUN",
             &out_},
            {"--json", "one JSON document on standard output", &json_}};
  }
  int run(Console& console) override;

 private:
  bool names_campaign() const {
    return files_.size() == 1 && std::filesystem::path(files_[0]).extension() == ".json";
  }
  std::string usage_fault() const;
  std::string make_out(OutFolder& folder) const;
  int look_into_run(Console& console);
  CampaignOrRefusal campaign(const sim::PlantSpec& plant) const;
  struct Answer {
    analysis::Explanation explanation;
    ExplainFacts facts;
  };
  std::variant<Answer, int> answered(Console& console, const Campaign& campaign, Twin& twin) const;
  analysis::Explanation explained(Console& console, const Twin& twin) const;
  Answer told_in_files(const Campaign& campaign, const Twin& twin,
                       analysis::Explanation explanation) const;
  int tell(Console& console, const Answer& answer) const;
  void write_out(const Twin& twin, const analysis::Explanation& explanation,
                 const Comparisons& comparisons, ExplainFacts& facts) const;

  std::string run_;
  std::string plant_;
  std::vector<std::string> files_;
  std::optional<double> rate_Hz_;
  std::optional<std::uint64_t> effects_;
  std::string out_;
  bool json_ = false;
};

void tell_notes(Console& console, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) console.err << "note: " << note << '\n';
}

void ExplainCommand::write_out(const Twin& twin, const analysis::Explanation& explanation,
                               const Comparisons& comparisons, ExplainFacts& facts) const {
  const std::filesystem::path folder = out_;
  const analysis::Fit& fit = explanation.selection.fit;
  std::string plant;
  if (explanation.verdict != analysis::ExplainVerdict::not_resolvable) {
    facts.plant_updated = (folder / "plant_updated.json").string();
    plant = sim::write_plant(twin.plant_with(fit.effects, fit.values));
  }
  const std::string page = make_explanation_page(explanation, facts, comparisons);
  std::error_code apart;
  const bool is_of_run = !run_.empty() && std::filesystem::equivalent(folder, run_, apart);
  std::optional<FileLock> alone;
  if (is_of_run && !(alone = lock_run(folder))) throw_error(EBUSY, folder);
  if (!facts.plant_updated.empty()) write_file(facts.plant_updated, plant);
  write_file(folder / "explain.html", page);
  write_file(folder / "explain.json", explanation_to_json(explanation, facts));
  if (!is_of_run) return;
  std::vector<std::string> names = {"explain.html", "explain.json"};
  if (!plant.empty()) names.emplace_back("plant_updated.json");
  renew_sums(folder, names);
}

// @throws Interrupted
analysis::Explanation ExplainCommand::explained(Console& console, const Twin& twin) const {
  ProgressBar bar(console, progress_style(console, json_));
  analysis::SelectionOptions options;
  options.most_effects = effects_.value_or(options.most_effects);
  std::mutex one_at_a_time;
  options.progress = [&](const std::string& stage, double share, const std::string& doing) {
    const std::scoped_lock locked(one_at_a_time);
    bar.show(stage, share, doing);
  };
  return analysis::explain(twin, options);
}

// @throws Interrupted, and std::system_error of what cannot be written
ExplainCommand::Answer ExplainCommand::told_in_files(const Campaign& campaign, const Twin& twin,
                                                     analysis::Explanation explanation) const {
  Located located = locate(twin, explanation.selection);
  weigh_what_stays(located, explanation);
  const Comparisons comparisons = compare(twin, explanation.selection);
  ExplainFacts facts{plant_,
                     software_version(),
                     "",
                     record_errors(twin, explanation.selection, comparisons),
                     std::move(located),
                     campaign.notes,
                     campaign.hashes};
  std::ranges::move(twin.notes(), std::back_inserter(facts.notes));
  if (!out_.empty()) write_out(twin, explanation, comparisons, facts);
  return {std::move(explanation), std::move(facts)};
}

// Explained, and written where it is to be; or the exit code that says why not. Signals wait for
// the next step only until then: who reads the answer may go away.
std::variant<ExplainCommand::Answer, int> ExplainCommand::answered(Console& console,
                                                                   const Campaign& campaign,
                                                                   Twin& twin) const {
  const StopOnSignal signals;
  OutFolder folder;
  if (const std::string fault = make_out(folder); !fault.empty()) {
    return refuse_usage(console, "explain: --out " + out_ + ": " + fault);
  }
  twin.stop_on(signals.token());
  try {
    return told_in_files(campaign, twin, explained(console, twin));
  } catch (const Interrupted&) {
    return tell_interrupted(console, name());
  } catch (const std::system_error& error) {
    return refuse_usage(console, std::string("explain: --out: ") + error.what());
  }
}

int ExplainCommand::tell(Console& console, const Answer& answer) const {
  const auto& [explanation, facts] = answer;
  if (json_) {
    console.out << explanation_to_json(explanation, facts);
  } else {
    tell_notes(console, facts.notes);
    print_explanation(console, explanation, facts);
    if (!out_.empty()) console.out << "\nReport: " << out_ << "/explain.html" << '\n';
  }
  const bool refused = explanation.verdict == analysis::ExplainVerdict::not_resolvable;
  return refused ? exit_codes::data_refused : exit_codes::done;
}

// What the command line lacks, or has too much of.
std::string ExplainCommand::usage_fault() const {
  if (run_.empty() && files_.empty()) return "RUN or --rec is required";
  if (!run_.empty() && !files_.empty()) return "a run folder needs no --rec";
  if (run_.empty() && plant_.empty()) return "--plant is required";
  if (!rate_Hz_) return {};
  if (!run_.empty()) return "a run states its rates: leave --rate out";
  return names_campaign() ? "a campaign file states its rates: leave --rate out" : "";
}

// What a run folder says where the command line does not.
int ExplainCommand::look_into_run(Console& console) {
  if (run_.empty()) return exit_codes::done;
  const std::vector<std::string> faults = run_faults(run_);
  for (const std::string& fault : faults) complain(console, "rvbench: " + run_ + ": " + fault);
  if (!faults.empty()) return exit_codes::data_refused;
  if (out_.empty()) out_ = run_;
  if (!plant_.empty()) return exit_codes::done;
  const std::string file = std::filesystem::path(run_) / "rig.json";
  const auto rig = read_rig(file, {});
  if (rig.index() == 1) return refuse_file(console, file, std::get<1>(rig));
  plant_ = plant_of(std::get<0>(rig));
  return exit_codes::done;
}

CampaignOrRefusal ExplainCommand::campaign(const sim::PlantSpec& plant) const {
  const std::vector<std::string> wanted = channels_of(plant);
  CampaignOrRefusal made = !run_.empty() ? campaign_of_run(run_, wanted)
                           : names_campaign()
                               ? read_campaign(files_[0], wanted)
                               : campaign_of(files_, rate_Hz_.value_or(not_known), wanted);
  if (auto* read = std::get_if<Campaign>(&made)) {
    note_clipped_inputs(plant, *read);
    add_planned_inputs(plant, *read);
  }
  return made;
}

// @return why --out cannot be used; empty if it can
std::string ExplainCommand::make_out(OutFolder& folder) const {
  if (out_.empty()) return "";
  if (std::string why = folder.make(out_, {}); !why.empty()) return why;
  const std::filesystem::path updated = std::filesystem::path(out_) / "plant_updated.json";
  std::error_code none;
  const bool replaces = std::filesystem::equivalent(updated, plant_, none);
  return replaces ? "would replace the plant it is given" : "";
}

int ExplainCommand::run(Console& console) {
  if (!is_rate(console, rate_Hz_)) return exit_codes::usage;
  if (const std::string fault = usage_fault(); !fault.empty()) {
    return refuse_usage(console, "explain: " + fault);
  }
  if (const int refused = look_into_run(console); refused != exit_codes::done) return refused;
  auto plant = sim::read_plant(plant_);
  if (plant.index() == 1) return refuse_file(console, plant_, std::get<1>(plant));
  auto read = campaign(std::get<0>(plant));
  if (const auto* refusal = std::get_if<Refusal>(&read)) {
    if (!refusal->of_recordings) return refuse_file(console, files_.front(), refusal->faults);
    for (const hal::ConfigFault& fault : refusal->faults) refuse_data(console, fault.message);
    return exit_codes::data_refused;
  }
  const Campaign& campaign = std::get<0>(read);
  auto made = make_twin(std::get<0>(std::move(plant)), campaign);
  if (const auto* refusal = std::get_if<Refusal>(&made)) {
    if (!refusal->of_recordings) return refuse_file(console, plant_, refusal->faults);
    for (const hal::ConfigFault& fault : refusal->faults) {
      const std::string at = fault.pointer.empty() ? "" : plant_ + ": " + fault.pointer + ": ";
      refuse_data(console, at + fault.message);
    }
    tell_notes(console, campaign.notes);
    return exit_codes::data_refused;
  }
  Twin& twin = *std::get<0>(made);
  const auto answer = answered(console, campaign, twin);
  if (const int* refused = std::get_if<int>(&answer)) return *refused;
  return tell(console, std::get<Answer>(answer));
}

}  // namespace

std::unique_ptr<Command> make_explain_command() { return std::make_unique<ExplainCommand>(); }

}  // namespace rvbench::bench
