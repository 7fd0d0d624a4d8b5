#pragma once

#include <vector>

#include "analysis/envelope_spectra.hpp"
#include "analysis/evidence/record_evidence.hpp"

namespace rvbench::test {

/// All signatures scored on envelopes of one record, each an IMF that is all of a channel.
inline std::vector<analysis::SignatureScore> scored(
    const std::vector<analysis::EnvelopeSpectra>& envelopes,
    const analysis::Kinematics& kinematics) {
  const auto combs = analysis::signature_combs(kinematics, envelopes.front().whole.resolution);
  std::vector<std::vector<analysis::ChannelEvidence>> channels;
  for (const analysis::EnvelopeSpectra& envelope : envelopes) {
    std::vector<analysis::ChannelEvidence>& channel = channels.emplace_back(combs.size());
    for (std::size_t s = 0; s < combs.size(); ++s) {
      channel[s].add(analysis::comb_evidence(envelope, combs[s]), 1, 1);
    }
  }
  return analysis::score_signatures(channels, combs);
}

}  // namespace rvbench::test
