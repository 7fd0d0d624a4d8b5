#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/proof/seal/sealed_case.hpp"
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

/// What stands between a machine and its records.
struct SlideChain {
  double gain = 1, delay_s = 0;
  double noise_slope = 0;  ///< its power falls as 1/f^slope
};
SlideChain chain_of(const CasePlan& plan, double rate_Hz, Draw& draw);

/// An effect in a machine, as large as it is.
struct HiddenSlide {
  HiddenInSlide effect;
  double size = 0;
  std::vector<Eigen::VectorXd> change = {};  ///< of each record, without noise
  double shown_dB = 0;  ///< what a calibration leaves of it, above noise of 1 in the output's unit
  double value = 0;     ///< of its parameter
};

/// How far a change stands above noise of 1 in its best bin, in the middle one of the records [dB].
double middle_snr_dB(const std::vector<Eigen::VectorXd>& change, double slope, double rate_Hz);

/// Noise that the one that shows least stands so far above as it is to.
/// @param hidden  one at least
double noise_under(const std::vector<HiddenSlide>& hidden, const CasePlan& plan);

double rms(const Eigen::VectorXd& x);

/// A number of a plant file.
nlohmann::json quantity(double value, const char* unit, const nlohmann::json& tolerance_pct);

/// What the right answer says of the effects in the machine's body.
nlohmann::json answer_of(const std::vector<HiddenSlide>& hidden, const std::string& body,
                         const CasePlan& plan, double noise);

}  // namespace seal
