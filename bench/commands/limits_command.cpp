#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

#include "bench/commands/commands.hpp"
#include "bench/fault_lines.hpp"
#include "bench/find_plan.hpp"
#include "bench/json_text.hpp"
#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/limits_effect.hpp"
#include "bench/limits_in_force.hpp"
#include "bench/limits_learning.hpp"
#include "bench/limits_list.hpp"
#include "bench/limits_on_runs.hpp"
#include "bench/limits_versions.hpp"
#include "bench/progress_bar.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

class LimitsCommand final : public Command {
 public:
  std::string name() const override { return "limits"; }
  std::string summary() const override {
    return "versions of limits: proposed, approved by somebody, activated";
  }
  std::string examples() const override {
    return "  rvbench limits list\n"
           "  rvbench limits propose --from limits.json --by \"J. Weber\"\n"
           "  rvbench limits learn 2026-11 --plan quick --by \"J. Weber\"      from good units\n"
           "  rvbench limits learn 2026-11 --plan quick --per-point --by \"J. Weber\"\n"
           "  rvbench limits effect 2026-11               which past verdicts would change\n"
           "  rvbench limits effect 2026-11 --json | jq .effect.changes\n"
           "  rvbench limits approve 2026-11 --by \"A. Sato\" --yes\n"
           "  rvbench limits activate 2026-11 --by \"A. Sato\"\n"
           "Without --yes, approve shows the effect and approves nothing. From its activation on,\n"
           "rvbench run takes a version in place of the limits of its plan.\n";
  }
  std::vector<Option> options() override {
    return {{"STEP",
             "what to do",
             &step_,
             true,
             {"list", "propose", "learn", "effect", "approve", "activate"}},
            {"VERSION", "version of the limits", &version_},
            {"--from", "limits file to propose", &from_},
            {"--plan", "learn: plan whose runs teach; else the limits' plan, where no run tells it",
             &plan_},
            {"--measure", "learn: this indicator alone; default: those limited now", &measures_},
            {"--per-point", "learn: a limit for each speed and load of the plan", &per_point_},
            {"--serials", "learn: file of good serials, one a line; default: all that passed",
             &serials_},
            {"--rig-kind",
             "learn: from runs on bench, replay or sim; default: the first that there is",
             &rig_kind_,
             false,
             {"bench", "replay", "sim"}},
            {"--content", "learn: share of good units within; default: 0.999", &content_},
            {"--confidence", "learn: of it; default: 0.95", &confidence_},
            {"--by", "who proposes, approves or activates", &by_},
            {"--yes", "approve, the effect having been seen", &yes_},
            {"--out", "folder of run folders; default: " + out_, &out_},
            {"--json", "list, effect: one JSON document on standard output", &json_}};
  }

  int run(Console& console) override {
    if (json_ && step_ != "list" && step_ != "effect") {
      return refuse_usage(console, "limits: --json is for list and effect");
    }
    if (step_ == "list") return list(console);
    if (step_ == "propose") return propose(console);
    if (version_.empty()) return refuse_usage(console, "limits: which VERSION?");
    if (step_ == "learn") return learn(console);
    const std::filesystem::path path = limits_path(out_, version_);
    if (!is_limits_version(version_) || !std::filesystem::exists(path)) {
      if (was_kept(out_, version_)) {
        return refuse_usage(console, "limits: " + path.string() + " is missing: put back a copy");
      }
      return refuse_usage(console, "limits: no version " + hal::in_quotes(version_) + " in " +
                                       out_ + hal::what_there_is(version_, names()));
    }
    read_sha256_ = sha256_of_file(path);
    auto read = read_limits_file(path);
    if (read.index() == 1) return refuse_file(console, path, std::get<1>(read));
    LimitsFile file = std::get<0>(std::move(read));
    if (step_ == "activate") return activate(console, std::move(file));
    return approve(console, std::move(file));
  }

 private:
  std::vector<std::string> names() const;
  int list(Console& console) const;
  int propose(Console& console) const;
  std::variant<LearningTask, int> learning_task(Console& console) const;
  int learn(Console& console) const;
  int approve(Console& console, LimitsFile file) const;
  int activate(Console& console, LimitsFile file) const;
  int check_on_runs(Console& console, const LimitsFile& file) const;
  int record(Console& console, LimitsFile file, const std::string& step) const;
  int show_effect(Console& console, const LimitsFile& file) const;

  std::string step_;
  std::string version_;
  std::string from_;
  std::string by_;
  std::string plan_;
  std::vector<std::string> measures_;
  std::string serials_;
  std::string rig_kind_;
  bool per_point_ = false;
  std::optional<double> content_, confidence_;
  std::string out_ = "runs";
  bool yes_ = false;
  bool json_ = false;
  std::optional<std::string> read_sha256_;  // of the version that is to come further; none: new
};

std::vector<std::string> LimitsCommand::names() const {
  std::vector<std::string> names;
  for (const LimitsVersion& one : limits_versions(out_)) {
    if (one.status != "missing") names.push_back(one.version);
  }
  return names;
}

int LimitsCommand::list(Console& console) const {
  const std::vector<LimitsVersion> versions = limits_versions(out_);
  if (json_) {
    console.out << json_text(limits_json(versions));
  } else {
    console.out << limits_text(versions);
    if (versions.empty()) console.out << "no limits in " << out_ << ": plans state their own\n";
  }
  return exit_codes::done;
}

int LimitsCommand::propose(Console& console) const {
  if (from_.empty()) return refuse_usage(console, "limits: propose which limits? give --from FILE");
  auto read = read_limits_file(from_);
  if (read.index() == 1) return refuse_file(console, from_, with_lines(from_, std::get<1>(read)));
  LimitsFile file = std::get<0>(std::move(read));
  if (!is_limits_version(file.version)) {
    return refuse_file(console, from_,
                       {{0, "/limits_version",
                         hal::in_quotes(file.version) + ": letters, digits, '.', '_' and '-'"}});
  }
  file.steps.clear();  // whatever was done with it elsewhere
  return record(console, std::move(file), "proposed");
}

std::variant<LearningTask, int> LimitsCommand::learning_task(Console& console) const {
  for (const std::string& measure : measures_) {
    if (find_measure(measure) == nullptr) return refuse_measure(console, "limits", measure);
  }
  LearningTask task;
  task.version = version_;
  task.measures = measures_;
  task.per_point = per_point_;
  task.coverage = {content_.value_or(task.coverage.content),
                   confidence_.value_or(task.coverage.confidence)};
  for (const double share : {task.coverage.content, task.coverage.confidence}) {
    if (share > 0.5 && share < 1) continue;
    return refuse_usage(console, "limits: --content and --confidence lie between 0.5 and 1");
  }
  auto plan = find_plan(plan_);
  auto of_runs = plan.index() == 1 ? plan_of_runs(out_, plan_) : std::nullopt;
  if (plan.index() == 1 && !of_runs) return refuse_file(console, plan_, std::get<1>(plan));
  task.plan = of_runs ? std::move(*of_runs) : std::get<0>(std::move(plan));
  const auto limits = put_in_force(out_, plan_, task.plan);
  if (limits.index() == 1) return refuse_usage(console, "limits: " + std::get<1>(limits));
  const auto machine = read_kinematics(task.plan.specimen.kinematics);
  if (machine.index() == 0) task.parts = parts_of(std::get<0>(machine));
  if (serials_.empty()) return task;
  const auto text = read_file(serials_);
  if (!text) return refuse_usage(console, "limits: --serials " + serials_ + " cannot be read");
  task.serials = serials_in(*text);
  if (task.serials.empty()) return refuse_usage(console, "limits: no serial in " + serials_);
  return task;
}

int LimitsCommand::learn(Console& console) const {
  if (plan_.empty()) return refuse_usage(console, "limits: learn from runs of which plan? --plan");
  if (by_.empty()) return refuse_usage(console, "limits: by whom? give --by NAME");
  if (!is_limits_version(version_)) {
    return refuse_usage(console, "limits: " + hal::in_quotes(version_) +
                                     " is no name of a version: up to 64 letters, digits, '.', '_' "
                                     "and '-', the first no '.'");
  }
  if (std::filesystem::exists(limits_path(out_, version_))) {
    return refuse_usage(console, "limits: " + version_ + " is there already");
  }
  auto task = learning_task(console);
  if (task.index() == 1) return std::get<1>(task);
  const auto database = caught_up(ResultDatabase::open(out_));
  if (!database) return refuse_data(console, "limits: " + describe(database.error()));
  const auto kinds = rig_kinds_of(database.value(), std::get<0>(task).plan.name);
  if (!kinds) return refuse_data(console, "limits: " + describe(kinds.error()));
  std::get<0>(task).rig_kind = rig_kind_.empty() ? kind_to_learn_from(kinds.value()) : rig_kind_;
  auto learnt = learn_limits(database.value(), std::get<0>(task), utc_now());
  if (!learnt) return refuse_data(console, "limits: " + describe(learnt.error()));
  if (kinds.value().size() > 1) {
    console.out << "from runs on rigs of kind " << std::get<0>(task).rig_kind << " alone\n";
  }
  console.out << learnt_text(learnt.value());
  const auto is_new = [](const LearntLimit& one) { return one.proposal.refusal.empty(); };
  const auto& asked = learnt.value().learnt;
  if (std::ranges::none_of(asked, is_new)) {
    const std::string why =
        asked.empty() ? "" : ": " + asked[0].limit.measure + ": " + asked[0].proposal.refusal;
    return refuse_data(console, "limits: nothing could be learnt, so there is no draft" + why);
  }
  return record(console, std::move(learnt).value().file, "proposed");
}

int LimitsCommand::approve(Console& console, LimitsFile file) const {
  if (step_ == "approve" && by_.empty()) {
    return refuse_usage(console, "limits: who approves? give --by NAME");
  }
  const int shown = show_effect(console, file);
  if (shown != exit_codes::done || step_ == "effect") return shown;
  if (!yes_) {
    console.out << "nothing is approved yet: add --yes to approve " << file.version << '\n';
    return exit_codes::done;
  }
  return record(console, std::move(file), "approved");
}

int LimitsCommand::activate(Console& console, LimitsFile file) const {
  if (status_of(file, out_) == "draft") {
    const bool was = last_step(file, "approved") != nullptr;
    return refuse_usage(console, "limits: " + file.version +
                                     (was ? " was changed since it was approved" : " is a draft") +
                                     ": only approved limits become active, see rvbench limits "
                                     "approve");
  }
  return record(console, std::move(file), "activated");
}

int LimitsCommand::show_effect(Console& console, const LimitsFile& file) const {
  const auto database = caught_up(ResultDatabase::open(out_));
  if (!database) return refuse_data(console, "limits: " + describe(database.error()));
  const auto runs = database.value().runs();
  if (!runs) return refuse_data(console, "limits: " + describe(runs.error()));
  ProgressBar bar(console, progress_style(console, json_));
  const LimitsEffect effect = effect_of(
      file, out_, runs.value(), [&](double share) { bar.show("effect", share, file.version); });
  bar.clear();
  if (json_) {
    console.out << json_text({{"effect", effect_json(effect)}});
  } else {
    console.out << effect_text(effect);
  }
  return exit_codes::done;
}

int LimitsCommand::check_on_runs(Console& console, const LimitsFile& file) const {
  const auto checked = faults_on_runs(file, out_, plan_);
  if (checked.index() == 1) return refuse_usage(console, "limits: " + std::get<1>(checked));
  const auto& faults = std::get<0>(checked);
  if (faults.empty()) return exit_codes::done;
  const std::string path = from_.empty() ? limits_path(out_, file.version).string() : from_;
  return refuse_file(console, path, with_lines(path, faults));
}

int LimitsCommand::record(Console& console, LimitsFile file, const std::string& step) const {
  if (by_.empty()) return refuse_usage(console, "limits: by whom? give --by NAME");
  if (const int refused = check_on_runs(console, file); refused != exit_codes::done) return refused;
  file.steps.push_back({step, utc_now(), by_, limits_hash(file.limits)});
  try {
    LedgerPen pen(out_);
    // Another may have been at it while this one looked.
    const bool is_taken = step == "proposed" && was_kept(out_, file.version);
    if (is_taken || sha256_of_file(limits_path(out_, file.version)) != read_sha256_) {
      return refuse_usage(console, step == "proposed"
                                       ? "limits: there was a version " + file.version + " in " +
                                             out_ + " before: give the new one another name"
                                       : "limits: " + file.version +
                                             " has just been changed: look "
                                             "at it again");
    }
    keep_limits(pen, file);
  } catch (const std::system_error& error) {
    return refuse_usage(console, "limits: cannot be written: " + reason_of(error));
  }
  console.out << file.version << ": " << step << " by " << by_ << '\n';
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_limits_command() { return std::make_unique<LimitsCommand>(); }

}  // namespace rvbench::bench
