#include "bench/qualification/qualification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "bench/ledger.hpp"
#include "bench/qualification/ages.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/run_folder.hpp"

namespace rvbench::bench {
namespace {

// Half of what the best calibration by comparison is sure of (ISO 16063-21: 1 %); a rig file may
// state three digits.
constexpr double same_sensitivity = 0.005;
constexpr double warn_share = 0.9;  // of the time that something counts for

const SelfTestRecord* newest_self_test(const QualificationSection& section,
                                       const std::vector<SelfTestRecord>& records) {
  const auto found =
      std::find_if(records.rbegin(), records.rend(), [&](const SelfTestRecord& record) {
        return record.station == section.station && record.rig_kind == section.rig_kind;
      });
  return found == records.rend() ? nullptr : &*found;
}

// The one by which the sensor was calibrated last, whenever it was entered. Of a certificate that
// was entered again the last entry counts: the one before was wrong.
const CalibrationRecord* newest_calibration(const std::string& station, const std::string& channel,
                                            const std::vector<CalibrationRecord>& records) {
  const CalibrationRecord* newest = nullptr;
  std::set<std::string> seen;
  for (auto record = records.rbegin(); record != records.rend(); ++record) {
    if (record->station != station || record->channel != channel) continue;
    if (!seen.insert(record->certificate).second) continue;
    if (newest == nullptr || record->calibrated_utc > newest->calibrated_utc) newest = &*record;
  }
  return newest;
}

RequirementState state_of(std::string requirement, const char* word, std::string sentence) {
  const bool blocks = word != std::string_view("fulfilled") && word != std::string_view("expires");
  return {std::move(requirement), word, std::move(sentence), blocks};
}

// Whether a damaged record may be what the section asks for; one of no known kind may.
bool concerns(const DamagedRecord& damaged, const QualificationSection& section) {
  if (!damaged.station.empty() && damaged.station != section.station) return false;
  if (damaged.kind.starts_with(self_test_kind(""))) {
    return section.self_test && damaged.kind == self_test_kind(section.rig_kind);
  }
  if (!damaged.kind.starts_with(calibration_of(""))) return true;
  return section.calibration &&
         std::ranges::any_of(section.calibration->channels, [&](const std::string& channel) {
           return damaged.kind.starts_with(calibration_kind(channel, ""));
         });
}

RequirementState self_test_state(const QualificationSection& section,
                                 const std::vector<SelfTestRecord>& records,
                                 const std::string& now_utc) {
  const char* const name = "self_test";
  const SelfTestSpec& spec = *section.self_test;
  const SelfTestRecord* newest = newest_self_test(section, records);
  if (newest == nullptr) {
    return state_of(name, "missing",
                    "self-test: station " + section.station + " has none: rvbench qualify");
  }
  if (!newest->has_ended()) {
    return state_of(name, "failed",
                    fmt::format("self-test: that of {} has not come to its end: if none is at "
                                "work, repeat it: rvbench qualify",
                                readable_utc(newest->utc)));
  }
  if (!newest->passed) {
    return state_of(name, "failed",
                    fmt::format("self-test: that of {} was not passed: {}",
                                readable_utc(newest->utc), newest->reason));
  }
  if (newest->judged_by != limits_of(spec)) {
    return state_of(name, "missing",
                    fmt::format("self-test: that of {} was judged by other limits than the rig "
                                "file's: rvbench qualify",
                                readable_utc(newest->utc)));
  }
  const std::string age = age_fault(newest->utc, spec.max_age_h, now_utc);
  if (!age.empty()) return state_of(name, "expired", "self-test: the newest " + age);
  const double left_h = spec.max_age_h - 24 * days_between(newest->utc, now_utc);
  const bool is_soon = left_h < (1 - warn_share) * spec.max_age_h;
  return state_of(name, is_soon ? "expires" : "fulfilled",
                  fmt::format("self-test: passed {}, counts for {:.3g} h more",
                              readable_utc(newest->utc), left_h));
}

// What is wrong with the sensitivity that the rig goes by; empty: nothing that is known.
std::string sensitivity_fault(const CalibrationRecord& record, const ChannelInfo& channel) {
  const double off = channel.sensitivity / record.sensitivity - 1;
  if (!(std::abs(off) > same_sensitivity)) return "";  // false where either is not known
  return fmt::format(
      "certificate {} states {:.5g} V/({}), the rig goes by {:.5g}, {:+.{}f} % off: put right "
      "whichever is wrong",
      record.certificate, record.sensitivity, channel.unit, channel.sensitivity, 100 * off,
      std::abs(off) < 0.1 ? 1 : 0);
}

RequirementState calibration_state(const std::string& station, const ChannelInfo& channel,
                                   double warn_days, const std::vector<CalibrationRecord>& records,
                                   const std::string& now_utc) {
  const std::string name = calibration_of(channel.name);
  const CalibrationRecord* newest = newest_calibration(station, channel.name, records);
  if (newest == nullptr) {
    return state_of(
        name, "missing",
        name + ": station " + station + " has no record of it: rvbench qualify calibrate");
  }
  const std::string calibrated = day_of(newest->calibrated_utc);
  const std::string until = day_of(newest->valid_until_utc);
  for (const auto& [utc, what] :
       {std::pair{newest->calibrated_utc, "calibrated"}, {newest->entered_utc, "entered"}}) {
    if (!is_ahead(utc, now_utc)) continue;
    return state_of(
        name, "failed",
        fmt::format("{}: certificate {} was {} on {}, which is yet to come by this "
                    "computer's clock ({}): put the clock right, or enter that certificate again",
                    name, newest->certificate, what, day_of(utc), readable_utc(now_utc)));
  }
  const double left_days = days_between(now_utc, newest->valid_until_utc);
  if (!(left_days > 0)) {
    return state_of(name, "expired",
                    fmt::format("{}: certificate {} of {} has expired, it was valid until {}", name,
                                newest->certificate, calibrated, until));
  }
  if (const std::string fault = sensitivity_fault(*newest, channel); !fault.empty()) {
    return state_of(name, "failed", name + ": " + fault);
  }
  const std::string sentence =
      fmt::format("{}: certificate {} of {} is valid until {}, {:.0f} days more", name,
                  newest->certificate, calibrated, until, std::floor(left_days));
  return state_of(name, left_days < warn_days ? "expires" : "fulfilled", sentence);
}

RequirementState golden_state(const GoldenUnitDemand& demand, const GoldenEvidence& evidence,
                              const std::string& now_utc) {
  const char* const name = "golden_unit";
  const auto reasons = golden_reasons(evidence, demand, now_utc);
  if (!reasons.empty()) {
    return state_of(name, evidence.runs.empty() ? "missing" : "failed",
                    fmt::format("{}", fmt::join(reasons, "; ")));
  }
  const std::string& utc = evidence.runs.back().started_utc;
  const double left_h = demand.max_age_h - 24 * days_between(utc, now_utc);
  const bool is_soon = left_h < (1 - warn_share) * demand.max_age_h;
  return state_of(name, is_soon ? "expires" : "fulfilled",
                  fmt::format("golden unit {}: its run of {} is in control, and counts for {:.3g} "
                              "h more",
                              demand.serial, readable_utc(utc), left_h));
}

}  // namespace

StationEvidence gather_evidence(const std::filesystem::path& root,
                                const QualificationSection& section) {
  StationEvidence evidence;
  std::optional<LedgerReading> reading(std::in_place, root);
  const Ledger ledger = read_ledger(root);
  evidence.records = newest_station_records(root, ledger);
  reading.reset();
  if (!section.golden_unit) return evidence;
  std::error_code unknown;
  if (!std::filesystem::is_directory(root, unknown)) return evidence;  // no run yet
  // The results are asked later: a run that ends meanwhile is still at work by the ledger.
  if (!ledger.fault.empty()) {
    evidence.golden.unreadable = ledger.fault;
    return evidence;
  }
  evidence.golden = golden_evidence(caught_up(ResultDatabase::open(root)), ledger, section);
  if (evidence.golden.unreadable.empty()) return evidence;
  // The folders are the truth, and the database may be locked or of a newer rvbench.
  evidence.golden = golden_evidence(caught_up(ResultDatabase::in_memory(root)), ledger, section);
  return evidence;
}

std::vector<std::string> Qualification::reasons() const {
  std::vector<std::string> all;
  for (const RequirementState& state : requirements) {
    if (state.blocks) all.push_back(state.sentence);
  }
  return all;
}

std::vector<std::string> Qualification::warnings() const {
  std::vector<std::string> all;
  for (const RequirementState& state : requirements) {
    if (state.word == "expires") all.push_back(state.sentence);
  }
  return all;
}

std::optional<Ending> Qualification::refusal() const {
  const std::vector<std::string> all = reasons();
  if (all.empty()) return std::nullopt;
  return Ending{Outcome::error, ErrorKind::not_qualified,
                fmt::format("the station is not qualified: {}", fmt::join(all, "; "))};
}

Qualification qualification_of(const QualificationSection& section,
                               const std::vector<ChannelInfo>& channels,
                               const StationEvidence& evidence, const std::string& now_utc,
                               const std::string& serial) {
  Qualification qualification;
  auto& all = qualification.requirements;
  const StationRecords& records = evidence.records;
  for (const DamagedRecord& damaged : records.damaged) {
    if (concerns(damaged, section)) all.push_back(state_of("records", "failed", damaged.sentence));
  }
  if (!records.clock_fault.empty()) {
    all.push_back(state_of("records", "failed", records.clock_fault));
  }
  if (section.self_test) all.push_back(self_test_state(section, records.self_tests, now_utc));
  if (section.calibration) {
    for (const std::string& name : section.calibration->channels) {
      const auto channel = std::ranges::find(channels, name, &ChannelInfo::name);
      all.push_back(calibration_state(
          section.station,
          channel == channels.end() ? ChannelInfo{name, "", "", not_known} : *channel,
          section.calibration->warn_days, records.calibrations, now_utc));
    }
  }
  if (section.golden_unit && section.golden_unit->serial != serial) {
    all.push_back(golden_state(*section.golden_unit, evidence.golden, now_utc));
  }
  return qualification;
}

Qualification qualification_now(const RigFile& rig, const std::filesystem::path& root,
                                const std::string& serial) {
  const QualificationSection* section = qualification_in(rig);
  if (section == nullptr) return {};
  return qualification_of(*section, channels_of(rig), gather_evidence(root, *section), utc_now(),
                          serial);
}

}  // namespace rvbench::bench
