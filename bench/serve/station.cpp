#include "bench/serve/station.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/file_kind.hpp"
#include "bench/find_plan.hpp"
#include "bench/ledger.hpp"
#include "bench/results/audit_index.hpp"
#include "bench/rig_factory.hpp"
#include "bench/run_folder.hpp"
#include "bench/serve/json_fields.hpp"
#include "bench/serve/station_state.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

constexpr std::chrono::seconds judge_again{1};
constexpr std::chrono::seconds gather_again{60};  // a run that somebody began elsewhere has ended

std::filesystem::path made(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
  return folder;
}

StationFile with_whole_paths(StationFile file) {
  std::filesystem::create_directories(file.runs);
  file.runs = std::filesystem::canonical(file.runs);
  return file;
}

bool is_same_point(const hal::PlannedPoint& a, const hal::PlannedPoint& b) {
  const auto is_same = [](double x, double y) {
    return x == y || (std::isnan(x) && std::isnan(y));
  };
  return is_same(a.speed_rpm, b.speed_rpm) && is_same(a.load_pct, b.load_pct) &&
         a.repeat == b.repeat;
}

}  // namespace

Station::Station(StationFile file, std::filesystem::path program, EventHub& hub)
    : file_(with_whole_paths(std::move(file))),
      program_(std::move(program)),
      keep_(made(station_folder(file_.runs))),
      hub_(hub),
      process_(keep_),
      live_(LiveSocket::open(live_file())) {
  read_plan();
  find_run();
  gather();
}

std::string Station::scan(const std::string& text) {
  const std::string serial = scanned_serial(text);
  std::string fault = serial_fault(file_.serial, serial);
  {
    const std::lock_guard lock(mutex_);
    if (phase_ == Phase::running) return "running";
    if (fault.empty()) {
      read_plan();
      if (rig_ && is_almost_golden(qualification_in(*rig_), serial)) fault = "almost_golden";
    }
    if (!fault.empty() && phase_ != Phase::ended) {
      forget_unit();  // what was scanned before is not what lies there now
    }
  }
  if (!fault.empty()) {
    tell_change();
    return fault;
  }
  gather();
  auto known = known_runs(file_.runs, serial);
  {
    const std::lock_guard lock(mutex_);
    if (phase_ == Phase::running) return "running";  // a start of the unit before came between
    serial_ = serial;
    hold_against_time();  // the golden unit is let in where others are not
    known_ = std::move(known);
    phase_ = known_.empty() ? Phase::ready : Phase::duplicate;
    forget_run();
  }
  tell_change();
  return "";
}

std::string Station::why_not(bool is_retest, const StationViewer& viewer) const {
  if (phase_ == Phase::running) return "running";
  if (viewer.is_remote && !file_.remote_start) return "remote_start_off";
  if (!reasons_.empty()) return "not_qualified";
  if (phase_ == Phase::duplicate && !is_retest) return "duplicate";
  return phase_ == Phase::ready || phase_ == Phase::duplicate ? "" : "no_unit";
}

std::string Station::may_start(bool is_retest, const StationViewer& viewer) const {
  const std::lock_guard lock(mutex_);
  return why_not(is_retest, viewer);
}

// The process is made by tick(): it has the priority of whoever makes it.
std::string Station::start(const std::string& serial, bool is_retest, const StationViewer& viewer) {
  {
    const std::lock_guard lock(mutex_);
    if (const std::string reason = why_not(is_retest, viewer); !reason.empty()) return reason;
    if (serial != serial_) return "other_unit";
    phase_ = Phase::running;
    progress_ = {.stage = "start", .text = ""};
    is_due_ = true;
    is_told_to_stop_ = false;
  }
  tell_change();
  return "";
}

std::string Station::stop() {
  const std::lock_guard lock(mutex_);
  if (phase_ != Phase::running) return "not_running";
  is_told_to_stop_ = true;
  if (is_due_) {
    is_due_ = false;
    fail_before_it_began();
    return "";
  }
  return process_.stop() ? "" : "not_running";
}

std::string Station::clear() {
  {
    const std::lock_guard lock(mutex_);
    if (phase_ == Phase::running) return "running";
    forget_unit();
  }
  tell_change();
  return "";
}

std::string Station::serial() const {
  const std::lock_guard lock(mutex_);
  return serial_;
}

bool Station::is_running() const {
  const std::lock_guard lock(mutex_);
  return phase_ == Phase::running;
}

void Station::tick() {
  bool has_ended = false;
  {
    const std::lock_guard lock(mutex_);
    if (is_due_) spawn();
    hear();
    if (phase_ == Phase::running && !process_.is_alive()) {
      hear();  // what it said last
      conclude();
      has_ended = true;
    }
  }
  if (has_ended) tell_change();  // nobody waits for the database to see a verdict
  if (!is_running()) look_after_qualification(has_ended);
  tell_change();
}

// What expires does so while the station waits, and somebody qualifies it in another program.
void Station::look_after_qualification(bool has_ended) {
  const auto now = std::chrono::steady_clock::now();
  if (!has_ended && now - judged_ < judge_again) return;
  judged_ = now;
  std::error_code none_yet;
  const auto changed =
      std::max(std::filesystem::last_write_time(file_.runs / ledger_name, none_yet),
               std::filesystem::last_write_time(qualification_folder(file_.runs), none_yet));
  if (has_ended || changed != records_changed_ || now - gathered_ >= gather_again) {
    records_changed_ = changed;
    gathered_ = now;
    gather();
  } else {
    const std::lock_guard lock(mutex_);
    hold_against_time();
  }
}

// What there is to hold against what the rig file asks. Results may be long in coming, while
// another program writes some: nobody waits for them who only asks how the station stands.
void Station::gather() {
  std::optional<QualificationSection> asked;
  {
    const std::lock_guard lock(mutex_);
    if (const auto* section = rig_ ? qualification_in(*rig_) : nullptr) asked = *section;
  }
  StationEvidence found;
  if (asked) found = gather_evidence(file_.runs, *asked);
  const std::lock_guard lock(mutex_);
  evidence_ = std::move(found);
  hold_against_time();
}

void Station::hold_against_time() {
  reasons_ = faults_;
  const QualificationSection* asked = rig_ ? qualification_in(*rig_) : nullptr;
  if (asked == nullptr) return;
  const auto more =
      qualification_of(*asked, channels_of(*rig_), evidence_, utc_now(), serial_).reasons();
  reasons_.insert(reasons_.end(), more.begin(), more.end());
}

// Also the rig: what cannot be read cannot be run on.
void Station::read_plan() {
  faults_.clear();
  const auto plan = find_plan(file_.plan);
  if (plan.index() == 0) {
    const auto before = std::exchange(points_, std::get<0>(plan).points());
    // Those of the verdict on show stay, but not with other points.
    if (!std::ranges::equal(points_, before, is_same_point)) {
      point_states_.assign(points_.size(), 'o');
    }
  } else {
    faults_.push_back(hal::describe(file_.plan, std::get<1>(plan).front()));
  }
  const auto faults = check_rig(file_.rig);
  if (!faults.empty()) faults_.push_back(hal::describe(file_.rig, faults.front()));
  auto rig = read_rig(file_.rig, {});
  rig_.reset();
  if (rig.index() == 0) rig_ = std::get<0>(std::move(rig));
}

}  // namespace rvbench::bench
