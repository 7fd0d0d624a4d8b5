#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/article_reading.hpp"
#include "analysis/evidence/gear_evidence.hpp"
#include "analysis/evidence/residual_envelope.hpp"
#include "analysis/shaft_angle.hpp"

namespace rvbench::analysis {

/// Where the gears' lines are in the spectra of channels of one length and rate.
struct RecordPlaces {
  GearPlaces gears;
  GearPlaces noise;
  ResidualPlaces residual;
  std::vector<double> sound;  ///< orders that a sound machine has
};

/// What one channel came to.
struct ChannelResult {
  ChannelExamination examination;
  std::shared_ptr<const RecordPlaces> places;
  std::vector<GearReading> gears;  ///< one per signature; none where no period of the gears fits
  std::vector<GearReading> noise;
  ResidualEnvelope residual;
  std::optional<ArticleReading> article;
  std::vector<QualityNote> quality;
  double periods = 0;
  bool repeats_another = false;  ///< sample by sample: what it shows is no evidence of its own
};

struct Task {
  const Kinematics& kinematics;
  const ShaftAngle& angle;
  const ExamineOptions& options;
};

/// Whether a channel's notes forbid a verdict by it.
bool is_spoiled(const std::vector<QualityNote>& notes);

/// Of each channel; channels that are alike share one. None where no period of the gears fits.
std::vector<std::shared_ptr<const RecordPlaces>> places_of(
    const std::vector<const Channel*>& channels, const ShaftAngle& angle, bool is_placed,
    const Kinematics& kinematics);

/// Takes one channel apart; a spoiled one has its name, unit and notes alone.
ChannelResult examine_channel(const Channel& channel, std::vector<QualityNote> quality,
                              std::shared_ptr<const RecordPlaces> places, const Task& task);

}  // namespace rvbench::analysis
