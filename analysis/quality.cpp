#include "analysis/quality.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/quality/clipping.hpp"
#include "analysis/spectral_lines.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index fewest_samples = 256;
// No accelerometer on a machine that turns shows one and the same value for that long.
constexpr double standstill_s = 0.5;

// The longest stretch of samples that are all the same.
Eigen::Index longest_standstill(const Eigen::VectorXd& x) {
  Eigen::Index longest = 1;
  Eigen::Index run = 1;
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    run = x[i] == x[i - 1] ? run + 1 : 1;
    longest = std::max(longest, run);
  }
  return longest;
}

bool is_locked(const Finding& finding, const Kinematics& kinematics) {
  return std::ranges::any_of(kinematics.signatures, [&](const Signature& s) {
    return s.slip == 0 && s.component == finding.component && s.mechanism == finding.mechanism;
  });
}

// Whether the line is on the first harmonic of what turns with the shaft, or of a mesh.
bool is_witness(const SpectralLine& line, const Kinematics& kinematics) {
  return !slips(line.order, kinematics) && is_characteristic(line, kinematics);
}

// One line on a wrong speed's order is soon met by chance: half of the channels must have one.
bool shows_shaft(const Examination& point, const Kinematics& kinematics) {
  const auto showing =
      std::ranges::count_if(point.channels, [&](const ChannelExamination& channel) {
        return std::ranges::any_of(
            channel.lines, [&](const SpectralLine& line) { return is_witness(line, kinematics); });
      });
  return showing > 0 && 2 * showing >= std::ssize(point.channels);
}

}  // namespace

std::vector<const Channel*> acceleration_channels(const Recording& record) {
  std::vector<const Channel*> channels;
  for (const Channel& c : record.channels) {
    if (is_of_shaft(c.info)) continue;
    if (c.info.unit.empty() || c.info.unit == "m/s²" || c.info.unit == "g") channels.push_back(&c);
  }
  return channels;
}

std::vector<QualityNote> channel_quality(const Channel& channel, double clip_level) {
  const Eigen::VectorXd& x = channel.samples;
  const auto bad = [&channel](std::string what) {
    return std::vector<QualityNote>{{channel.info.name, std::move(what), true}};
  };
  if (x.size() < fewest_samples) {
    return bad("too short: " + std::to_string(x.size()) + " samples, " +
               std::to_string(fewest_samples) + " are the least");
  }
  if (!(channel.rate_Hz > 0)) return bad("no sample rate");
  const Eigen::Index lost = x.size() - x.array().isFinite().count();
  if (lost > 0)
    return bad("lost samples: " + std::to_string(lost) + " of " + std::to_string(x.size()));
  if (x.maxCoeff() == x.minCoeff()) return bad("dead: every sample is the same");
  const Eigen::Index clipped = std::isfinite(clip_level)
                                   ? (x.array().abs() >= 0.999 * clip_level).count()
                                   : clipped_samples(x);
  if (clipped > 0) return bad("clipped: " + std::to_string(clipped) + " samples at full scale");
  return {};
}

std::vector<QualityNote> accelerometer_quality(const Channel& channel, double clip_level) {
  std::vector<QualityNote> notes = channel_quality(channel, clip_level);
  if (!notes.empty()) return notes;
  const Eigen::Index stood = longest_standstill(channel.samples);
  if (stood >= fewest_samples && double(stood) > standstill_s * channel.rate_Hz) {
    notes.push_back(
        {channel.info.name,
         "dead for a while: " + std::to_string(stood) + " samples in a row are the same", true});
  }
  return notes;
}

bool shows_shaft(const std::vector<Examination>& points, const Diagnosis& diagnosis,
                 const Kinematics& kinematics) {
  const auto locked = [&](const Finding& finding) { return is_locked(finding, kinematics); };
  if (std::ranges::any_of(diagnosis.findings, locked)) return true;
  if (std::ranges::any_of(diagnosis.below_limit, locked)) return true;
  return std::ranges::any_of(
      points, [&](const Examination& point) { return shows_shaft(point, kinematics); });
}

}  // namespace rvbench::analysis
