#include "bench/compare_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>

#include "analysis/compare/block_spectrum.hpp"
#include "analysis/shaft_angle.hpp"
#include "bench/command.hpp"
#include "bench/file_kind.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {
namespace {

constexpr double same_order = 1e-9;

// The machine as it was when the run began, else the one that its plan names.
std::variant<analysis::Kinematics, JudgeRefusal> machine_of(const std::filesystem::path& folder) {
  std::string machine = (folder / "kinematics.json").string();
  if (is_absent(machine)) {
    const auto plan = sequences::read_plan(folder / "plan.json");
    if (plan.index() == 1) {
      return JudgeRefusal{exit_codes::bad_file,
                          hal::describe((folder / "plan.json").string(), std::get<1>(plan)[0])};
    }
    machine = std::get<0>(plan).specimen.kinematics;
  }
  auto kinematics = read_kinematics(machine);
  if (kinematics.index() == 1) {
    return JudgeRefusal{exit_codes::bad_file, hal::describe(machine, std::get<1>(kinematics)[0])};
  }
  return std::get<0>(std::move(kinematics));
}

// Hidden files are notes of the system, not recordings.
// @param why  set if the folder cannot be read
std::vector<std::string> files_in(const std::filesystem::path& path, std::error_code& why) {
  std::error_code unknown;  // then reading the file tells why
  if (!std::filesystem::is_directory(path, unknown)) return {path.string()};
  std::vector<std::string> files;
  for (std::filesystem::directory_iterator at(path, why), end; !why && at != end;
       at.increment(why)) {
    const std::string name = at->path().filename().string();
    if (at->is_regular_file(unknown) && !name.starts_with(".")) {
      files.push_back(at->path().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

using Hashes = std::vector<std::pair<std::string, std::string>>;  // file, SHA-256

// Of those that can be read: reading the others tells why not.
Hashes hashes_of(const std::vector<std::string>& files) {
  Hashes hashes;
  for (const std::string& file : files) {
    if (const auto hash = sha256_of_file(file)) hashes.emplace_back(file, *hash);
  }
  return hashes;
}

// A recording that is there twice has not been repeated.
std::vector<analysis::NotCompared> leave_out_copies(std::vector<std::string>& files,
                                                    Hashes& hashes) {
  std::map<std::string, std::string> known;  // hash → file
  std::vector<analysis::NotCompared> copies;
  std::erase_if(hashes, [&](const auto& hashed) {
    const auto& [file, hash] = hashed;
    const auto [first, is_new] = known.emplace(hash, file);
    if (is_new) return false;
    copies.push_back({file, "a copy of " + first->second + ", no repeat"});
    std::erase(files, file);
    return true;
  });
  return copies;
}

// A run folder in this one, or in one of its folders: "runs" and "runs/A17" are parents of some.
std::optional<std::filesystem::path> run_within(const std::filesystem::path& folder) {
  constexpr int deepest = 2;
  std::error_code unknown;  // a file has none
  for (std::filesystem::recursive_directory_iterator at(folder, unknown), end; at != end;
       at.increment(unknown)) {
    if (at.depth() >= deepest) at.disable_recursion_pending();
    if (at->path().filename() == "plan.json") return at->path().parent_path();
  }
  return std::nullopt;
}

// Without lines where the channel is missing, too short or has lost samples.
analysis::Spectrum spectrum_of(const Recording& record, const std::string& name,
                               const analysis::Kinematics& kinematics) {
  const Channel* channel = record.find(name);
  const auto angle = analysis::ShaftAngle::of(record);
  if (channel == nullptr || !angle || !channel->samples.allFinite()) return {};
  return analysis::block_spectrum(analysis::over_periods(*channel, *angle, kinematics), *angle,
                                  analysis::block_turns(kinematics));
}

}  // namespace

std::variant<CompareSide, JudgeRefusal> CompareSide::open(const std::string& path,
                                                          const hal::RecordingHints& hints,
                                                          const std::stop_token& stop) {
  const std::filesystem::path at = path;
  auto opened = is_absent(at / "plan.json") ? open_files(at, hints, stop) : open_run(at);
  if (auto* side = std::get_if<CompareSide>(&opened)) side->path_ = path;
  return opened;
}

std::variant<CompareSide, JudgeRefusal> CompareSide::open_run(const std::filesystem::path& folder) {
  if (is_at_work(folder)) {
    return JudgeRefusal{exit_codes::bad_file, folder.string() + ": " + still_at_work};
  }
  auto machine = machine_of(folder);
  if (machine.index() == 1) return std::get<1>(std::move(machine));
  auto run = RunRecordings::open(folder);
  if (!run) return JudgeRefusal{exit_codes::data_refused, run.error().where};
  CompareSide side;
  side.kinematics_ = std::get<0>(std::move(machine));
  side.run_ = std::move(run).value();
  for (int point = 0; point < side.run_->points(); ++point) {
    if (side.run_->has(point)) side.points_.push_back(point);
  }
  if (side.points_.empty()) {
    return JudgeRefusal{exit_codes::data_refused, folder.string() + " holds no record"};
  }
  std::vector<std::string> files;
  for (const std::string& name : recording_names(folder)) {
    files.push_back((folder / name).string());
  }
  side.hashes_ = hashes_of(files);
  return side;
}

std::variant<CompareSide, JudgeRefusal> CompareSide::open_files(const std::filesystem::path& path,
                                                                const hal::RecordingHints& hints,
                                                                const std::stop_token& stop) {
  if (const auto run = run_within(path)) {
    return JudgeRefusal{
        exit_codes::data_refused,
        path.string() + " is a parent of run folders: give one, as " + run->string()};
  }
  CompareSide side;
  std::error_code why;
  std::vector<std::string> files = files_in(path, why);
  if (why) {
    return JudgeRefusal{exit_codes::data_refused, path.string() + ": " + why.message()};
  }
  side.hashes_ = hashes_of(files);
  side.left_out_ = leave_out_copies(files, side.hashes_);
  if (files.empty()) {
    return JudgeRefusal{exit_codes::data_refused, path.string() + " holds no recording"};
  }
  auto read = recordings_to_judge({.files = files, .hints = hints, .channel = "", .stop = stop});
  if (read.index() == 1) return std::get<1>(std::move(read));
  side.records_ = std::get<0>(std::move(read));
  for (const Recording& record : side.records_) {
    for (const std::string& note : record.notes) {
      // The comparison tells of that itself, of runs as well.
      if (note.find(", no acceleration") == note.npos) {
        side.left_out_.push_back({record.source, note});
      }
    }
  }
  return side;
}

Result<Recording> CompareSide::read(std::size_t index) {
  Result<Recording> record =
      run_ ? run_->read(points_.at(index)) : Result<Recording>(records_.at(index));
  if (!record || names_.empty()) return record;
  Recording renamed = std::move(record).value();
  for (Channel& channel : renamed.channels) {
    const auto name = names_.find(channel.info.name);
    if (name != names_.end()) channel.info.name = name->second;
  }
  return renamed;
}

Result<bool> CompareSide::has_channel(const std::string& name) {
  for (std::size_t i = 0; i < size(); ++i) {
    const Result<Recording> record = read(i);
    if (!record) return record.error();
    if (record.value().find(name) != nullptr) return true;
  }
  return false;
}

std::optional<analysis::Spectrum> CompareSide::mean_spectrum(
    const std::vector<std::size_t>& records, const std::string& channel,
    const analysis::Kinematics& kinematics) {
  std::vector<analysis::Spectrum> spectra;
  Eigen::Index lines = std::numeric_limits<Eigen::Index>::max();
  for (const std::size_t i : records) {
    const Result<Recording> record = read(i);
    if (!record) return std::nullopt;
    analysis::Spectrum one = spectrum_of(record.value(), channel, kinematics);
    if (one.amplitude.size() == 0) continue;
    lines = std::min(lines, one.amplitude.size());
    spectra.push_back(std::move(one));
  }
  if (spectra.empty()) return std::nullopt;
  Eigen::VectorXd power = Eigen::VectorXd::Zero(lines);
  for (const analysis::Spectrum& one : spectra) power += one.amplitude.head(lines).cwiseAbs2();
  return analysis::Spectrum{spectra.front().resolution,
                            (power / static_cast<double>(spectra.size())).cwiseSqrt()};
}

bool is_same_machine(const analysis::Kinematics& a, const analysis::Kinematics& b) {
  return std::abs(a.period_turns - b.period_turns) < same_order &&
         std::ranges::equal(a.orders, b.orders, [](const auto& x, const auto& y) {
           return x.name == y.name && std::abs(x.order - y.order) < same_order;
         });
}

}  // namespace rvbench::bench
