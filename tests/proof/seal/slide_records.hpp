#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

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

/// How far a change stands above noise in its best bin, of all records [dB].
/// @param change  per record, without noise
double best_bin_snr_dB(const std::vector<Eigen::VectorXd>& change, double noise, double slope,
                       double rate_Hz);

double rms(const Eigen::VectorXd& x);

}  // namespace seal
