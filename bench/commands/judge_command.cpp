#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>

#include "analysis/table4.hpp"
#include "bench/commands/commands.hpp"
#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/progress_bar.hpp"
#include "bench/report/report.hpp"
#include "bench/sha256.hpp"
#include "bench/software_version.hpp"
#include "bench/summary.hpp"
#include "bench/verdict_json.hpp"
#include "hal/formats/read_recordings.hpp"

namespace rvbench::bench {
namespace {

class JudgeCommand final : public Command {
 public:
  std::string name() const override { return "judge"; }
  std::string summary() const override { return "diagnoses stored recordings of one machine"; }
  std::string examples() const override {
    return "  rvbench judge IR007_0.mat --kinematics cwru_6205 --rate 12000 --speed 1797\n"
           "  rvbench judge runs/A17/20260102T030405Z/recording.h5 --kinematics rv20e --json\n";
  }
  std::vector<Option> options() override {
    return {{"REC", "recordings; several are points of one judgement", &files_, true, {}},
            {"--kinematics", "machine: built-in name or file", &kinematics_, true, {}},
            {"--speed", "speed of the input shaft [rpm]", &speed_rpm_, false, {}},
            {"--rate", "sample rate [Hz]", &rate_Hz_, false, {}},
            {"--channel", "judge this channel only", &channel_, false, {}},
            {"--catalogue",
             "orders to match: derived, or Table 4 as published",
             &catalogue_,
             false,
             {"derived", "published"}},
            {"--out", "folder for verdict.json and report.html", &out_, false, {}},
            {"--json", "one JSON document on standard output", &json_, false, {}}};
  }
  int run(Console& console) override;

 private:
  int load(Console& console);
  int refuse_unknown(Console& console, const Recording& record, const std::string& file) const;
  bool keep_channel(Recording& record) const;
  Judgement judge(Console& console, const analysis::Kinematics& kinematics) const;
  analysis::Kinematics catalogue_for(const Recording& record,
                                     const analysis::Kinematics& derived) const;
  void write_out(const Judgement& judgement, const analysis::Kinematics& kinematics) const;

  std::vector<std::string> files_;
  std::string kinematics_;
  std::optional<double> speed_rpm_;
  std::optional<double> rate_Hz_;
  std::string channel_;
  std::string catalogue_ = "derived";
  std::string out_;
  bool json_ = false;
  std::vector<Recording> records_;
};

int JudgeCommand::run(Console& console) {
  for (const auto& [value, name] :
       {std::pair{speed_rpm_, "--speed"}, std::pair{rate_Hz_, "--rate"}}) {
    if (value && !(*value > 0 && std::isfinite(*value))) {
      return refuse_usage(console, std::string(name) + " must be above 0");
    }
  }
  const auto kinematics = read_kinematics(kinematics_);
  if (kinematics.index() == 1) return refuse_file(console, kinematics_, std::get<1>(kinematics));
  std::error_code unusable;
  if (!out_.empty()) std::filesystem::create_directories(out_, unusable);
  if (unusable) return refuse_usage(console, "judge: --out " + out_ + ": " + unusable.message());
  if (const int refused = load(console); refused != exit_codes::done) return refused;
  const analysis::Kinematics used = catalogue_for(records_.front(), std::get<0>(kinematics));
  const Judgement judgement = judge(console, std::get<0>(kinematics));
  if (json_) {
    console.out << judgement_to_json(judgement);
  } else {
    print_summary(console, judgement, used);
  }
  try {
    if (!out_.empty()) write_out(judgement, used);
  } catch (const std::system_error& error) {
    return refuse_usage(console, std::string("judge: --out: ") + error.what());
  }
  return exit_code(judgement.ending);
}

/// Reads every file. @return why not, or done
int JudgeCommand::load(Console& console) {
  const hal::RecordingHints hints{rate_Hz_.value_or(not_known), speed_rpm_.value_or(not_known)};
  for (const std::string& file : files_) {
    Result<std::vector<Recording>> read = hal::read_recordings(file, hints);
    if (!read) {
      console.err << "rvbench: " << read.error().where << '\n';
      return exit_codes::data_refused;
    }
    for (Recording& record : std::move(read).value()) {
      if (const int refused = refuse_unknown(console, record, file); refused != exit_codes::done)
        return refused;
      if (keep_channel(record)) records_.push_back(std::move(record));
    }
  }
  if (records_.empty())
    return refuse_usage(console, "no recording has a channel \"" + channel_ + "\"");
  return exit_codes::done;
}

int JudgeCommand::refuse_unknown(Console& console, const Recording& record,
                                 const std::string& file) const {
  for (const Channel& channel : record.channels) {
    if (!(channel.rate_Hz > 0))
      return refuse_usage(console, file + " states no sample rate: give it with --rate HZ");
  }
  const bool has_speed =
      std::isfinite(record.speed_rpm) || record.find(channel_names::input_angle) != nullptr;
  if (!has_speed)
    return refuse_usage(console, file + " states no shaft speed: give it with --speed RPM");
  return exit_codes::done;
}

/// Leaves the channel asked for, beside angle and torque. @return whether it is there
bool JudgeCommand::keep_channel(Recording& record) const {
  if (channel_.empty()) return true;
  if (record.find(channel_) == nullptr) return false;
  std::erase_if(record.channels, [&](const Channel& channel) {
    return channel.info.name != channel_ && channel.info.name != channel_names::input_angle &&
           channel.info.name != channel_names::input_torque;
  });
  return true;
}

analysis::Kinematics JudgeCommand::catalogue_for(const Recording& record,
                                                 const analysis::Kinematics& derived) const {
  const bool published = catalogue_ == "published" && std::isfinite(record.speed_rpm);
  return published ? analysis::published_table4(std::abs(record.speed_rpm)) : derived;
}

Judgement JudgeCommand::judge(Console& console, const analysis::Kinematics& kinematics) const {
  ProgressBar bar(console, progress_style(console, json_));
  Judgement judgement;
  judgement.facts.software = software_version();
  judgement.facts.started_utc = utc_now();
  for (std::size_t i = 0; i < records_.size(); ++i) {
    bar.show("judge", double(i) / double(records_.size()), records_[i].source);
    judgement.points.push_back(
        judge_point(records_[i], catalogue_for(records_[i], kinematics), {}));
  }
  bar.clear();
  conclude(judgement, catalogue_for(records_.front(), kinematics), {},
           {Outcome::pass, ErrorKind::none, "every recording was read"});
  return judgement;
}

void JudgeCommand::write_out(const Judgement& judgement,
                             const analysis::Kinematics& kinematics) const {
  const std::filesystem::path folder = out_;
  ReportInput input;
  input.judgement = judgement;
  input.kinematics = kinematics;
  input.load = [this](std::size_t point) { return std::optional<Recording>(records_.at(point)); };
  for (const std::string& file : files_) {
    const std::optional<std::string> hash = sha256_of_file(file);
    if (hash) input.hashes.emplace_back(file, *hash);
  }
  write_file(folder / "verdict.json", judgement_to_json(judgement));
  write_file(folder / "report.html", make_report(input));
}

}  // namespace

std::unique_ptr<Command> make_judge_command() { return std::make_unique<JudgeCommand>(); }

}  // namespace rvbench::bench
