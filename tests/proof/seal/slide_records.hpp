#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/proof/seal/slide_effects/slide_effects.hpp"

namespace seal {

/// What was recorded of a machine that moves along one way.
struct SlideRecord {
  std::string condition;
  std::string programme;  ///< "" if nothing repeats it
  Eigen::VectorXd input, output;
};

struct SlideChannels {
  double rate_Hz = 0;
  std::string input, output;  ///< names
};

/// Writes record_1.csv, ... and the campaign.json that tells their conditions.
void write_records(const std::filesystem::path& folder, const SlideChannels& channels,
                   const std::vector<SlideRecord>& records);

/// How far a change stands above noise in its best bin, in the middle one of the records [dB].
/// @param change  per record, without noise
double middle_snr_dB(const std::vector<Eigen::VectorXd>& change, double noise, double slope,
                     double rate_Hz);

double rms(const Eigen::VectorXd& x);

/// A number of a plant file.
nlohmann::json quantity(double value, const char* unit, const nlohmann::json& tolerance_pct);

/// What the right answer says of one effect in the slide's body.
nlohmann::json answer_of(const HiddenInSlide& effect, const std::string& body, double size,
                         double concealment_dB, double snr_dB);

}  // namespace seal
