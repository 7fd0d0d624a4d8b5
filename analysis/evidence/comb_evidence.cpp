#include "analysis/evidence/comb_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

// One line read at one place.
struct Reading {
  double log_ratio = 0;
  double excess = 0;    // power above what it must exceed
  double variance = 0;  // of excess
};

class Reader {
 public:
  Reader(const EnvelopeSpectra& envelope, const SignatureComb& comb)
      : envelope_(envelope), comb_(comb), floor_(comb.rolls ? envelope.unlocked : envelope.lines) {}

  Reading read(std::size_t line, Eigen::Index bin, Eigen::Index shift) const {
    Reading reading;
    if (!holds(bin)) return reading;
    const double base = base_of(comb_.lines[line], bin, shift);
    const double power = (1 + in_own_floor(bin, shift)) * floor_.power[bin];
    const double m = floor_.floor_lines[bin];
    reading.log_ratio = m * std::log1p(power / (m * base));
    reading.excess = comb_.rolls ? lobe_above_floor(bin) : power - base;
    // |a + n|² of a line a in complex noise of mean power F varies by F² + 2·F·|a|². Hann lines
    // share noise: neighbours by 2/3, the next but one by 1/6 in amplitude; the three of a lobe
    // over 3/2 have 2.14 times the first term and 1.30 times the second.
    const double floor = floor_.floor[bin];
    const double strength = std::max(reading.excess, 0.0);
    reading.variance = comb_.rolls ? 2.14 * floor * floor + 1.30 * 2 * floor * strength
                                   : floor * floor + 2 * floor * strength;
    return reading;
  }

  // Inside the spectrum and below half the carrier.
  bool reaches(Eigen::Index bin) const {
    return bin >= 2 && bin < floor_.power.size() - 1 &&
           double(bin) * comb_.resolution < envelope_.highest_order;
  }

  // And for what rolls, off the gear train's lines.
  bool holds(Eigen::Index bin) const {
    return reaches(bin) && !(comb_.rolls && floor_.is_locked(bin));
  }

  // Every line that the envelope reaches has decoys, even where its own nominal place is the gear
  // train's: slip may take it to where it counts.
  Eigen::VectorXd decoy(Eigen::Index shift) const {
    Eigen::VectorXd ratios = Eigen::VectorXd::Zero(comb_.bins.rows());
    for (Eigen::Index i = 0; i < ratios.size(); ++i) {
      const auto line = static_cast<std::size_t>(i);
      const Eigen::Index bin = comb_.bins(i, comb_.nominal);
      if (!reaches(bin)) continue;
      const Eigen::Index moved = holds(bin + shift) ? shift : -shift;
      ratios[i] = holds(bin + moved) ? read(line, bin + moved, moved).log_ratio : 1;  // its mean
      if (!is_capped(line)) continue;
      ratios[i] = std::min(ratios[i], ratios[static_cast<Eigen::Index>(harmonic_of(line))]);
    }
    return ratios;
  }

  bool is_capped(std::size_t line) const {
    return comb_.rolls && comb_.lines[line].sideband_of >= 0;
  }
  std::size_t harmonic_of(std::size_t line) const {
    return static_cast<std::size_t>(comb_.lines[line].sideband_of);
  }

 private:
  // Power of a line that lies anywhere between two of the spectrum, or is smeared over them: a Hann
  // window spreads a power of 1 over three lines with a sum of 3/2.
  double lobe_above_floor(Eigen::Index bin) const {
    double sum = 0;
    for (const Eigen::Index at : {bin - 1, bin, bin + 1}) {
      if (holds(at)) sum += floor_.power[at] - floor_.floor[at];
    }
    return sum / 1.5;
  }

  // A gear train's line is not among those that its floor is the median of, and its decoys are.
  // What is in the median of n lines of noise is, over that, lower by a share of 1/n on the
  // average: the mean and the median of exponential numbers vary together by ln 2/n.
  double in_own_floor(Eigen::Index bin, Eigen::Index shift) const {
    const bool only_the_decoy = floor_.is_neighbour(bin) && !floor_.is_neighbour(bin - shift);
    return only_the_decoy ? 1 / floor_.neighbours[bin] : 0;
  }

  // What a line must exceed to speak for this comb.
  double base_of(const SignatureLine& wanted, Eigen::Index bin, Eigen::Index shift) const {
    double base = floor_.floor[bin];
    for (const double rival : wanted.rivals) {
      const Eigen::Index other = comb_.bin_of(rival) + shift;
      if (holds(other)) base = std::max(base, floor_.power[other]);
    }
    return base;
  }

  const EnvelopeSpectra& envelope_;
  const SignatureComb& comb_;
  const LineFloor& floor_;
};

}  // namespace

CombEvidence comb_evidence(const EnvelopeSpectra& envelope, const SignatureComb& comb) {
  const Reader reader(envelope, comb);
  CombEvidence e;
  e.log_ratio = e.depth2 = e.variance = Eigen::MatrixXd::Zero(comb.bins.rows(), comb.bins.cols());
  const double mean2 = envelope.mean * envelope.mean;
  for (Eigen::Index t = 0; t < comb.bins.cols(); ++t) {
    for (Eigen::Index i = 0; i < comb.bins.rows(); ++i) {
      const auto line = static_cast<std::size_t>(i);
      const Reading reading = reader.read(line, comb.bins(i, t), 0);
      e.log_ratio(i, t) = reading.log_ratio;
      e.depth2(i, t) = reading.excess / mean2;
      e.variance(i, t) = reading.variance / (mean2 * mean2);
      if (!reader.is_capped(line)) continue;
      const auto harmonic = static_cast<Eigen::Index>(reader.harmonic_of(line));
      e.log_ratio(i, t) = std::min(e.log_ratio(i, t), e.log_ratio(harmonic, t));
      e.depth2(i, t) = std::min(e.depth2(i, t), e.depth2(harmonic, t));
    }
  }
  e.shifts = decoy_shifts(comb, envelope.lines.locked_every);
  e.decoys.resize(comb.bins.rows(), static_cast<Eigen::Index>(e.shifts.size()));
  for (Eigen::Index d = 0; d < e.decoys.cols(); ++d) {
    e.decoys.col(d) = reader.decoy(e.shifts[static_cast<std::size_t>(d)]);
  }
  return e;
}

}  // namespace rvbench::analysis
