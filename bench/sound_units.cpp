#include "bench/sound_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "analysis/station/robust_limit.hpp"
#include "analysis/statistics.hpp"
#include "bench/findings_stand.hpp"
#include "bench/run_folder.hpp"
#include "bench/same_recording.hpp"
#include "hal/formats/choose_format.hpp"

namespace rvbench::bench {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<fs::path>;

constexpr const char* verdict_name = "verdict.json";

// A folder's own verdicts, or its recordings.
Files files_below(const fs::path& folder) {
  Files verdicts, recordings;
  std::error_code ignored;
  constexpr auto quietly = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(folder, quietly, ignored)) {
    if (!entry.is_regular_file(ignored) || entry.file_size(ignored) == 0) continue;
    if (entry.path().filename() == verdict_name) verdicts.push_back(entry.path());
    if (hal::formats::choose_format(entry.path())) recordings.push_back(entry.path());
  }
  return verdicts.empty() ? recordings : verdicts;
}

std::optional<fs::path> newest_verdict(const fs::path& runs, const std::string& serial) {
  std::optional<fs::path> newest;
  int number = -1;
  for (const fs::path& run : folders_in(runs / folder_name_of(serial))) {
    const int its = read_run_begin(run).number;
    if (its <= number || !is_finished(run)) continue;
    number = its;
    newest = run / verdict_name;
  }
  return newest;
}

// What one part shows in each sound unit that could judge it.
std::vector<double> severities_of(const analysis::Signature& part,
                                  const std::vector<analysis::Diagnosis>& units) {
  std::vector<double> severities;
  for (const analysis::Diagnosis& unit : units) {
    for (const analysis::Finding* f : unit.hypotheses()) {
      const bool is_it = f->may_be(part.component) && f->mechanism == part.mechanism;
      if (!is_it || std::isnan(f->smallest_visible) || std::isnan(f->severity)) continue;
      severities.push_back(f->severity);
    }
  }
  return severities;
}

struct Spread {
  double median = 0, scatter = 0, factor = 0;
};

// Of few units each counts. Of more, those that are unlike the others do not.
Spread spread_of(const std::vector<double>& values) {
  const std::size_t units = values.size();
  Spread spread;
  spread.median = analysis::median(values);
  if (units < analysis::least_units_of_a_limit) {
    spread.factor = analysis::one_sided_tolerance_factor(units, {});
    double sum2 = 0;
    for (const double value : values) sum2 += (value - spread.median) * (value - spread.median);
    spread.scatter = std::sqrt(sum2 / static_cast<double>(units - 1));
    return spread;
  }
  spread.factor = analysis::robust_tolerance_factor(units, {});
  const auto learnt = analysis::robust_limit(values, analysis::LimitSide::max, spread.factor);
  if (const auto* limit = std::get_if<analysis::RobustLimit>(&learnt)) {
    spread.median = limit->median;
    spread.scatter = (limit->limit - limit->median) / spread.factor;
  }
  return spread;  // else half of them are alike
}

// Of few units the factor is large. They prove no limit that is beyond the one assumed and twice
// what any of them shows.
double most_of(const std::vector<double>& severities, double assumed) {
  if (severities.size() >= analysis::least_units_of_a_limit) {
    return std::numeric_limits<double>::infinity();
  }
  return std::max(assumed, 2 * std::ranges::max(severities));
}

}  // namespace

SoundUnits::Added SoundUnits::add(const std::string& file, Judgement judgement) {
  if (!judgement.diagnosis.resolvable || is_spoiled(judgement)) return Untrusted{};
  if (std::string same = file_with_samples_of(judgement); !same.empty()) {
    return Repeated{std::move(same)};
  }
  units_.push_back({file, std::move(judgement)});
  return Counted{};
}

std::string SoundUnits::file_with_samples_of(const Judgement& judgement) const {
  const auto same = std::ranges::find_if(
      units_, [&](const Unit& unit) { return share_a_recording(unit.judgement, judgement); });
  return same == units_.end() ? "" : same->file;
}

std::vector<std::string> SoundUnits::files() const {
  std::vector<std::string> all;
  for (const Unit& unit : units_) all.push_back(unit.file);
  return all;
}

std::vector<analysis::Diagnosis> SoundUnits::diagnoses() const {
  std::vector<analysis::Diagnosis> all;
  for (const Unit& unit : units_) all.push_back(unit.judgement.diagnosis);
  return all;
}

std::variant<Files, std::string> sound_files(const std::vector<std::string>& words,
                                             const fs::path& runs) {
  Files files;
  for (const std::string& word : words) {
    std::error_code ignored;
    if (word.empty()) return std::string("a name is empty");
    if (fs::is_directory(word, ignored)) {
      const Files below = files_below(word);
      if (below.empty()) return word + " holds no verdict.json and no recording";
      files.insert(files.end(), below.begin(), below.end());
    } else if (fs::exists(word, ignored)) {
      files.emplace_back(word);
    } else if (const auto verdict = newest_verdict(runs, word)) {
      files.push_back(*verdict);
    } else {
      return word + " is no file or folder, and " + runs.string() +
             " has no finished run of such a serial";
    }
  }
  std::ranges::sort(files);
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

analysis::Kinematics with_sound_units(analysis::Kinematics kinematics,
                                      const std::vector<analysis::Diagnosis>& units) {
  for (analysis::Signature& part : kinematics.signatures) {
    const std::vector<double> severities = severities_of(part, units);
    if (severities.size() < fewest_sound_units) continue;
    const Spread spread = spread_of(severities);
    const bool is_shown = spread.median > 0 && spread.scatter > 0;
    const double learnt = std::min(spread.median + spread.factor * spread.scatter,
                                   most_of(severities, part.depth_limit));
    constexpr double least = 0.5;  // of the limit assumed
    const double assumed = part.depth_limit, assumed_aligned = part.aligned_limit;
    const double limit = is_shown ? learnt : std::max(learnt, least * assumed);
    part.set_limit(limit);
    part.aligned_limit = std::clamp(assumed_aligned, learnt, limit);
    part.limit_in_noise = assumed;
    part.sound_median = spread.median;
    if (spread.scatter > 0) part.sound_scatter = spread.scatter;
    part.limit_why =
        fmt::format("{} sound units: median {:.3g} and {:.1f} times their scatter of {:.3g}",
                    severities.size(), spread.median, spread.factor, spread.scatter);
  }
  return kinematics;
}

}  // namespace rvbench::bench
