#include "analysis/quality/record_quality.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "analysis/order/resolution.hpp"
#include "analysis/quality.hpp"
#include "analysis/quality/drift.hpp"
#include "analysis/quality/frozen_samples.hpp"
#include "analysis/quality/heard.hpp"
#include "analysis/quality/iepe_bias.hpp"
#include "analysis/quality/mains_hum.hpp"
#include "analysis/quality/spikes.hpp"
#include "analysis/spectral_lines.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {
namespace {

constexpr double turns_per_spike = 4;

using Complaint = std::optional<std::string>;

Complaint of_spikes(const Channel& c, const ShaftAngle& angle) {
  const std::vector<Eigen::Index> spikes = find_spikes(c.samples);
  const double duration_s = static_cast<double>(c.samples.size()) / c.rate_Hz;
  const double turns = duration_s * angle.mean_speed_Hz();
  if (spikes.empty() || turns_per_spike * static_cast<double>(spikes.size()) > turns) return {};
  return fmt::format(
      "spikes: {} that no vibration makes, the first at {:.3f} s: a loose plug, or a discharge",
      spikes.size(), static_cast<double>(spikes.front()) / c.rate_Hz);
}

// "0.77 m/s²"; without a unit the number alone.
std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

Complaint of_drift(const Channel& c, double period_s) {
  const std::optional<Drift> drift = find_drift(c.samples, c.rate_Hz, period_s);
  if (!drift) return {};
  return fmt::format(
      "drift: its mean moves by {}, its vibration is {} rms: the amplifier or the IEPE supply has "
      "not settled",
      with_unit(drift->change, c.info.unit), with_unit(drift->vibration, c.info.unit));
}

Complaint of_bias(const Channel& c) {
  const std::optional<double> bias_V = open_cable_bias_V(c);
  if (!bias_V) return {};
  return fmt::format("IEPE bias: {:.1f} V, that of an open cable", *bias_V);
}

Complaint of_frozen(const Channel& c) {
  const std::optional<FrozenSamples> frozen = find_frozen_samples(c.samples);
  if (!frozen) return {};
  return fmt::format(
      "stood still: {} samples in a row are the same from {:.3f} s on, where else it is {} at "
      "most, but for one run in a thousand: were samples lost?",
      frozen->count, static_cast<double>(frozen->first) / c.rate_Hz, frozen->usual);
}

Complaint of_silence(const std::vector<Heard>& all, std::size_t one) {
  if (!hears_front_end_only(all, one)) return {};
  return fmt::format(
      "IEPE bias: only white noise of {} rms, a hundredth of what its neighbours hear: "
      "cable open or shorted, or the sensor is off",
      with_unit(all[one].rms, all[one].unit));
}

Complaint of_hum(const std::vector<Heard>& all, std::size_t one, const ShaftAngle& angle,
                 const Kinematics& kinematics) {
  const double speed_Hz = angle.mean_speed_Hz();
  const auto is_of_machine = [&](double frequency_Hz, double within_Hz) {
    const double order = frequency_Hz / speed_Hz;
    const double off = speed_error(angle.is_measured()) * order;
    return !meaning_of(order, within_Hz / speed_Hz + off, kinematics).empty();
  };
  const std::optional<MainsHum> hum = find_mains_hum(all, one, is_of_machine);
  if (!hum) return {};
  return fmt::format(
      "mains hum: {:.2f} Hz x {}, {:.0f} % of its rms, and hardly in its neighbours: a ground loop "
      "or a lost shield",
      hum->grid_Hz, fmt::join(hum->harmonics, ", "), 100 * hum->share);
}

}  // namespace

std::vector<std::vector<QualityNote>> record_quality(const std::vector<const Channel*>& channels,
                                                     const ShaftAngle& angle,
                                                     const Kinematics& kinematics,
                                                     double clip_level) {
  std::vector<std::vector<QualityNote>> notes(channels.size());
  std::vector<Heard> all(channels.size());
  const auto complain = [&](std::size_t i, const Complaint& what) {
    if (what && notes[i].empty()) notes[i].push_back({channels[i]->info.name, *what, true});
  };
  parallel_for(channels.size(), [&](std::size_t i) {
    const Channel& c = *channels[i];
    notes[i] = accelerometer_quality(c, clip_level);
    if (!notes[i].empty()) return;
    complain(i, of_spikes(c, angle));
    complain(i, of_drift(c, kinematics.period_turns / angle.mean_speed_Hz()));
    complain(i, of_bias(c));
    if (notes[i].empty()) all[i] = heard(c);
  });

  std::vector<Heard> sound;
  std::vector<std::size_t> whose;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!notes[i].empty()) continue;
    sound.push_back(std::move(all[i]));
    whose.push_back(i);
  }
  for (std::size_t k = 0; k < sound.size(); ++k) {
    complain(whose[k], of_silence(sound, k));
    complain(whose[k], of_hum(sound, k, angle, kinematics));
  }
  for (const std::size_t i : whose) {
    const Complaint frozen = notes[i].empty() ? of_frozen(*channels[i]) : std::nullopt;
    if (frozen) notes[i].push_back({channels[i]->info.name, *frozen, false});
  }
  return notes;
}

}  // namespace rvbench::analysis
