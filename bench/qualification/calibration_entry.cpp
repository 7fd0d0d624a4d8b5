#include "bench/qualification/calibration_entry.hpp"

#include <algorithm>
#include <utility>

#include "bench/qualification/ages.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/software_version.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t longest_text = 200;  // of a certificate, or of who enters it

// What is wrong with its texts; "" if nothing is.
std::string text_fault(const CalibrationEntry& entry) {
  for (const auto& [value, option] : {std::pair{entry.channel, "--channel"},
                                      {entry.certificate, "--certificate"},
                                      {entry.by, "--by"},
                                      {entry.on, "--on"},
                                      {entry.until, "--until"}}) {
    if (value.empty()) return std::string("give ") + option;
    if (value.starts_with(' ') || value.ends_with(' ')) {
      return std::string(option) + ": no blank may begin or end it";
    }
    if (value.size() > longest_text) return std::string(option) + " is too long";
  }
  return "";
}

}  // namespace

std::variant<CalibrationRecord, std::string> calibration_record(
    const CalibrationEntry& entry, const std::string& station,
    const std::vector<std::string>& channels, const std::string& now_utc) {
  if (std::string fault = text_fault(entry); !fault.empty()) return fault;
  if (std::ranges::find(channels, entry.channel) == channels.end()) {
    return "the rig has no channel " + hal::in_quotes(entry.channel) +
           hal::what_there_is(entry.channel, channels);
  }
  // Left out by mistake, nobody would hold the rig's against it.
  if (entry.sensitivity.has_value() == entry.no_sensitivity) {
    return "give --sensitivity, or --no-sensitivity if the certificate states none";
  }
  const auto on = utc_of_text(entry.on, false), until = utc_of_text(entry.until, true);
  if (!on || !until) return "--on and --until are days, as 2026-11-02";
  if (is_ahead(*on, now_utc)) {
    return "--on " + day_of(*on) + " is yet to come by this computer's clock (" +
           readable_utc(now_utc) + ")";
  }
  if (!(days_between(*on, *until) > 0)) return "--until lies before --on";
  return CalibrationRecord{.file = "",
                           .station = station,
                           .channel = entry.channel,
                           .sensitivity = entry.sensitivity.value_or(not_known),
                           .certificate = entry.certificate,
                           .by = entry.by,
                           .calibrated_utc = *on,
                           .valid_until_utc = *until,
                           .entered_utc = now_utc,
                           .software = software_version()};
}

}  // namespace rvbench::bench
