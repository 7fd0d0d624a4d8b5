#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "bench/commands/commands.hpp"
#include "bench/fault_lines.hpp"
#include "bench/json_text.hpp"
#include "bench/judging.hpp"
#include "bench/limits_file.hpp"
#include "bench/progress_bar.hpp"
#include "bench/rejudging.hpp"
#include "bench/result_database.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

nlohmann::ordered_json json_of(const Ending& ending, const std::string& software) {
  return hal::json_object({{"verdict", to_string(ending.outcome)},
                           {"reason", ending.reason},
                           {"error_kind", to_string(ending.error_kind)},
                           {"software", software}});
}

class RejudgeCommand final : public Command {
 public:
  std::string name() const override { return "rejudge"; }
  std::string summary() const override {
    return "judges stored runs again: with new limits, or by this version of rvbench";
  }
  std::string examples() const override {
    return "  rvbench rejudge runs/A17/20260102T030405Z\n"
           "  rvbench rejudge runs/*/2026* --limits limits.json\n"
           "The verdict of then stays as it is. The new one is written beside it, as\n"
           "rejudged-1.json and so on, and rvbench history shows both. The exit code is that of\n"
           "the gravest new verdict.\n";
  }
  std::vector<Option> options() override {
    return {{"RUN", "run folders", &folders_, true, {}},
            {"--limits", "limits file, in place of the limits of the plan", &limits_file_},
            {"--json", "one JSON document on standard output", &json_}};
  }
  int run(Console& console) override;

 private:
  int judge(Console& console, const std::filesystem::path& folder);
  int check_limits(Console& console, const StoredRun& run) const;
  Rejudgement judged(Console& console, const StoredRun& stored) const;
  void tell(Console& console, const StoredRun& run, const Rejudgement& again,
            const std::string& file);

  std::vector<std::string> folders_;
  std::string limits_file_;
  bool json_ = false;
  std::optional<LimitsFile> limits_;
  Ending gravest_{Outcome::pass, ErrorKind::none, ""};
  nlohmann::ordered_json told_ = nlohmann::ordered_json::array();
};

int RejudgeCommand::run(Console& console) {
  if (!limits_file_.empty()) {
    auto read = read_limits_file(limits_file_);
    if (read.index() == 1) {
      return refuse_file(console, limits_file_, with_lines(limits_file_, std::get<1>(read)));
    }
    limits_ = std::get<0>(std::move(read));
  }
  int refused = exit_codes::done;
  for (const std::string& folder : folders_) {
    // "runs/A17/20260102T030405Z/" is the same folder.
    const std::filesystem::path path = std::filesystem::path(folder) / "";
    refused = std::max(refused, judge(console, path.parent_path()));
  }
  if (refused != exit_codes::done && told_.empty()) return refused;
  if (json_) {
    nlohmann::ordered_json told = nlohmann::ordered_json::object();
    if (refused != exit_codes::done) {  // what was judged is told beside
      told = parse_ordered_json(refusal_to_json(refused, std::exchange(console.complaints, {})));
    }
    told["runs"] = told_;
    console.out << json_text(told);
  }
  return refused != exit_codes::done ? refused : exit_code(gravest_);
}

// Limits of another plan would ask for what was never measured.
int RejudgeCommand::check_limits(Console& console, const StoredRun& run) const {
  if (!limits_) return exit_codes::done;
  if (limits_->plan != run.plan.name) {
    return refuse_data(console, "rejudge: " + limits_file_ + " limits runs of plan " +
                                    hal::in_quotes(limits_->plan) + ", and " + run.folder.string() +
                                    " is one of " + hal::in_quotes(run.plan.name));
  }
  const auto faults = limits_out_of_place(limits_->limits, run.plan, run.kinematics);
  if (faults.empty()) return exit_codes::done;
  return refuse_file(console, limits_file_, with_lines(limits_file_, faults));
}

int RejudgeCommand::judge(Console& console, const std::filesystem::path& folder) {
  const auto read = read_stored_run(folder);
  if (const auto* faults = std::get_if<FileFaults>(&read)) {
    return refuse_file(console, faults->first, faults->second);
  }
  const StoredRun& stored = std::get<StoredRun>(read);
  const std::string why_not = why_not_judged_again(stored);
  if (!why_not.empty()) return refuse_data(console, "rejudge: " + folder.string() + " " + why_not);
  if (const int refused = check_limits(console, stored); refused != exit_codes::done) {
    return refused;
  }
  // New hashes must not bless anything that was changed, least of all a recording.
  const std::vector<std::string> changed = changed_files(folder);
  for (const std::string& fault : changed) complain(console, (folder / fault).string());
  if (!changed.empty()) return exit_codes::bad_file;
  const Rejudgement again = judged(console, stored);
  std::string file;
  try {
    const std::optional<FileLock> alone = lock_run(folder);
    if (!alone) return refuse_file(console, folder, {{0, "", still_at_work}});
    file = next_rejudgement_name(folder);
    write_file(folder / file, rejudgement_to_json(again));
    renew_sums(folder, {file});
  } catch (const std::system_error& error) {
    return refuse_usage(console, "rejudge: cannot be written: " + reason_of(error));
  }
  tell(console, stored, again, file);
  return exit_codes::done;
}

Rejudgement RejudgeCommand::judged(Console& console, const StoredRun& stored) const {
  Rejudgement again;
  ProgressBar bar(console, progress_style(console, json_));
  again.judgement =
      judged_again(stored, limits_ ? limits_->limits : stored.plan.limits,
                   [&](double share) { bar.show("judge", share, stored.folder.string()); });
  bar.clear();
  again.judged_utc = utc_now();
  if (limits_) {
    again.limits_version = limits_->version;
    again.judgement.facts.limits_version = limits_->version;
    again.limits_sha256 = limits_hash(limits_->limits);
  }
  return again;
}

void RejudgeCommand::tell(Console& console, const StoredRun& run, const Rejudgement& again,
                          const std::string& file) {
  // An index that is there takes it in; else rvbench history makes one from the folders.
  const std::filesystem::path root =
      std::filesystem::absolute(run.folder).parent_path().parent_path();
  std::error_code unknown;
  if (std::filesystem::exists(root / result_database_name, unknown)) {
    if (const auto entered = caught_up(ResultDatabase::open(root)); !entered) {
      console.err << "rvbench: warning: " << describe(entered.error())
                  << "; rvbench history enters it later\n";
    }
  }
  const Ending& then = run.as_judged.ending;
  const Ending& now = again.judgement.ending;
  gravest_ = graver(gravest_, now);
  told_.push_back(hal::json_object({{"folder", run.folder.string()},
                                    {"file", file},
                                    {"as_judged", json_of(then, run.as_judged.facts.software)},
                                    {"rejudged", json_of(now, again.judgement.facts.software)}}));
  told_.back()["limits_version"] = nullptr;
  if (!again.limits_version.empty()) told_.back()["limits_version"] = again.limits_version;
  if (json_) return;
  console.out << run.folder.string() << '\n'
              << "  as judged then  "
              << paint(console, tone_of(then.outcome), to_string(then.outcome)) << "  "
              << as_cell(then.reason, 500) << '\n'
              << "  re-judged       "
              << paint(console, tone_of(now.outcome), to_string(now.outcome)) << "  "
              << as_cell(now.reason, 500) << '\n'
              << "  " << (run.folder / file).string() << '\n';
}

}  // namespace

std::unique_ptr<Command> make_rejudge_command() { return std::make_unique<RejudgeCommand>(); }

}  // namespace rvbench::bench
