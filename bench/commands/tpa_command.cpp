#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "bench/commands/commands.hpp"
#include "bench/out_folder.hpp"
#include "bench/progress_bar.hpp"
#include "bench/report/tpa_page.hpp"
#include "bench/rig_factory.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/text_file.hpp"
#include "bench/tpa_json.hpp"
#include "bench/tpa_project.hpp"
#include "bench/tpa_simulation.hpp"
#include "bench/tpa_study.hpp"
#include "bench/tpa_text.hpp"

namespace rvbench::bench {
namespace {

class TpaCommand final : public Command {
 public:
  std::string name() const override { return "tpa"; }
  std::string summary() const override { return "finds the joint and path that shake the arm"; }
  std::string examples() const override {
    return "  rvbench tpa robot7/project.json --out robot7/paths\n"
           "  rvbench tpa robot7/project.json --out robot7/paths --histories\n"
           "  rvbench tpa robot7/project.json --json\n"
           "  rvbench tpa --simulate virtual --seed 7 --out virtual/paths\n"
           "                                     the whole story, on a virtual robot\n";
  }
  std::vector<Option> options() override {
    return {{"PROJECT", "project file: FRFs or hits, motions, sensors", &project_},
            {"--out", "folder for tpa.json and tpa.html; default: none are written", &out_},
            {"--histories",
             "writes forces and contributions over time as well, into histories/ of that folder",
             &histories_},
            {"--json", "one JSON document on standard output", &json_},
            {"--simulate",
             "measure a virtual robot first, and write hits, motions, its reducers' recordings "
             "and project.json into this folder; with --out or --json, PROJECT is that one",
             &simulate_},
            {"--seed", "of the virtual robot; default: 1", &seed_, false, {}, max_seed}};
  }
  int run(Console& console) override;

 private:
  int check_options(Console& console);
  int simulate(Console& console) const;
  int study(Console& console);
  std::variant<TpaStudy, int> studied(Console& console);
  void write_out(const TpaStudy& study) const;
  Status write_all_histories(const TpaStudy& study, const std::stop_token& stop) const;

  std::string project_, out_, simulate_;
  bool json_ = false, histories_ = false;
  std::optional<std::uint64_t> seed_;
  OutFolder out_folder_;
};

// Which motion filters cannot be made for; empty: none.
std::string no_histories(const TpaStudy& study) {
  for (const MotionAnswer& motion : study.motions) {
    if (motion.over_time) continue;
    return fmt::format(
        "{}: filters need eight lines or more, and a sample rate and first line that are "
        "multiples of their step, {:g} Hz",
        motion.motion.recording, study.frfs.matrix.step_Hz);
  }
  return "";
}

int TpaCommand::run(Console& console) {
  if (const int refused = check_options(console); refused != exit_codes::done) return refused;
  try {
    if (simulate_.empty()) return study(console);
    const int simulated = simulate(console);
    if (simulated != exit_codes::done) return simulated;
    if (json_ || !out_.empty()) return study(console);
    console.out << "A virtual robot was measured. Who shakes its arm:\n  rvbench tpa " << project_
                << '\n';
    return exit_codes::done;
  } catch (const Interrupted&) {
    return tell_interrupted(console, name());
  }
}

// What can be known to be wrong before anything is read.
int TpaCommand::check_options(Console& console) {
  if (project_.empty() == simulate_.empty()) {
    return refuse_usage(console, "tpa: give a PROJECT, or --simulate and a folder");
  }
  if (simulate_.empty() && seed_) {
    return refuse_usage(console, "tpa: --seed is of --simulate");
  }
  if (!simulate_.empty()) {
    project_ = (std::filesystem::path(simulate_) / "project.json").string();
  }
  if (histories_ && out_.empty()) {
    return refuse_usage(console, "tpa: --histories are written into the folder of --out");
  }
  if (out_.empty()) return exit_codes::done;
  const std::string why = out_folder_.make(out_, {"tpa.json", "tpa.html", "histories"});
  return why.empty() ? exit_codes::done : refuse_usage(console, "tpa: --out " + out_ + ": " + why);
}

int TpaCommand::simulate(Console& console) const {
  const StopOnSignal signals;
  OutFolder folder;
  const std::string why = folder.make(simulate_, {"project.json"});
  if (!why.empty()) return refuse_usage(console, "tpa: --simulate " + simulate_ + ": " + why);
  ProgressBar bar(console, progress_style(console, json_));
  try {
    const Status written =
        write_virtual_robot(simulate_, {.seed = seed_.value_or(1)}, bar, signals.token());
    if (!written) return refuse_usage(console, "tpa: --simulate: " + describe(written.error()));
  } catch (const std::system_error& error) {
    return refuse_usage(console, "tpa: --simulate: " + reason_of(error));
  }
  return exit_codes::done;
}

int TpaCommand::study(Console& console) {
  const auto study = studied(console);
  if (const int* refused = std::get_if<int>(&study)) return *refused;
  if (json_) {
    console.out << study_to_json(std::get<0>(study));
  } else {
    print_study(console, std::get<0>(study));
    if (!out_.empty()) console.out << "\nReport: " << out_ << "/tpa.html\n";
  }
  return exit_codes::done;
}

// Studied, and written where it is to be; or the exit code that says why not.
std::variant<TpaStudy, int> TpaCommand::studied(Console& console) {
  const StopOnSignal signals;
  const auto project = read_tpa_project(project_);
  if (project.index() == 1) return refuse_file(console, project_, std::get<1>(project));
  ProgressBar bar(console, progress_style(console, json_));
  auto study = study_paths(std::get<0>(project), !out_.empty(), bar, signals.token());
  bar.clear();
  if (const auto* refusal = std::get_if<TpaRefusal>(&study)) {
    for (const std::string& why : *refusal) refuse_data(console, "tpa: " + why);
    return exit_codes::data_refused;
  }
  if (const std::string why = no_histories(std::get<0>(study)); histories_ && !why.empty()) {
    return refuse_data(console, "tpa: --histories: " + why);
  }
  try {
    if (!out_.empty()) write_out(std::get<0>(study));
    if (histories_) {
      const Status written = write_all_histories(std::get<0>(study), signals.token());
      if (!written) return refuse_data(console, "tpa: " + written.error().where);
    }
  } catch (const std::system_error& error) {
    return refuse_usage(console, "tpa: --out: " + reason_of(error));
  }
  return std::get<0>(std::move(study));
}

void TpaCommand::write_out(const TpaStudy& study) const {
  const std::filesystem::path folder = out_;
  const std::string page = make_tpa_page(study);
  write_file(folder / "tpa.json", study_to_json(study));
  write_file(folder / "tpa.html", page);
}

// A file per motion, in their order.
Status TpaCommand::write_all_histories(const TpaStudy& study, const std::stop_token& stop) const {
  const std::filesystem::path folder = std::filesystem::path(out_) / "histories";
  const analysis::FrfMatrix& frfs = study.frfs.matrix;
  const bool has_forces = tpa_method(study.project.method).needs_frfs;
  const HistoryLabels labels{has_forces ? "force at " : "reference ",
                             has_forces ? frfs.excitation_unit : frfs.response_unit,
                             frfs.response_unit};
  std::filesystem::create_directory(folder);
  for (std::size_t i = 0; i < study.motions.size(); ++i) {
    end_if_stopped(stop);
    const MotionAnswer& motion = study.motions[i];
    const Status written = write_histories(folder / fmt::format("motion_{}.h5", i + 1),
                                           motion.contributions, motion.motion.recording, labels);
    if (!written) return written;
  }
  return Done{};
}

}  // namespace

std::unique_ptr<Command> make_tpa_command() { return std::make_unique<TpaCommand>(); }

}  // namespace rvbench::bench
