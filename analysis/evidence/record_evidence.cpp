#include "analysis/evidence/record_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "analysis/evidence/decoy_p_value.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

constexpr int beside = 2;         // a line takes its neighbours with it, and
constexpr double smear = 0.02;    // relative: as far as slip has smeared it,
constexpr double is_smeared = 2;  // where the mean log ratio is above noise's of 1

// One signature in all channels of a record.
class RecordEvidence {
 public:
  RecordEvidence(const std::vector<std::vector<ChannelEvidence>>& channels, std::size_t signature,
                 const SignatureComb& comb)
      : comb_(comb) {
    log_ratio_.setZero(comb.bins.rows(), comb.bins.cols());
    for (const std::vector<ChannelEvidence>& channel : channels) {
      if (signature >= channel.size()) {
        throw std::invalid_argument("score_signatures: a channel lacks evidence of a signature");
      }
      const ChannelEvidence& evidence = channel[signature];
      channels_.push_back(&evidence);
      if (evidence.imfs.empty()) continue;
      log_ratio_ += evidence.sum.log_ratio;
      shifts_ = evidence.sum.shifts;
      decoys_ = decoys_.size() == 0 ? evidence.sum.decoys : (decoys_ + evidence.sum.decoys).eval();
      envelopes_ += evidence.imfs.size();
    }
    open_ = Mask::Constant(comb.bins.rows(), comb.bins.cols(), true);
  }

  // Leaves out what another part explains.
  void leave_out(const std::set<int>& taken, const std::set<int>& smeared) {
    for (Eigen::Index t = 0; t < open_.cols(); ++t) {
      for (Eigen::Index i = 0; i < open_.rows(); ++i) {
        const int bin = comb_.bins(i, t);
        const bool strong = log_ratio_(i, t) > is_smeared * static_cast<double>(envelopes_);
        if (taken.contains(bin) || (strong && smeared.contains(bin))) open_(i, t) = false;
      }
    }
  }

  SignatureScore score(int signature) const {
    SignatureScore score;
    score.signature = signature;
    score.line_depths.assign(comb_.lines.size(), 0.0);
    score.channel_depths.assign(channels_.size(), 0.0);
    put_lines(comb_.nominal, score);
    if (envelopes_ == 0 || comb_.lines.empty()) return score;

    const Eigen::VectorXd sums =
        open_.select(log_ratio_.array(), 0.0).matrix().colwise().sum().transpose();
    Eigen::Index best = comb_.nominal;
    for (Eigen::Index t = 0; t < sums.size(); ++t) {
      if (sums[t] > sums[best]) best = t;
    }
    put_lines(best, score);
    const Eigen::VectorXd decoys = decoys_of_open_lines(best);
    score.log_likelihood_ratio = sums[best] - median({decoys.begin(), decoys.end()});
    score.p_value = std::min(1.0, decoy_p_value(sums[best], decoys, lines_per_decoy_line(best)) *
                                      static_cast<double>(sums.size()));
    read_depths(best, score);
    return score;
  }

 private:
  // Where the signature and its lines are at this stretch.
  void put_lines(Eigen::Index stretch, SignatureScore& score) const {
    const double stretched = stretch < comb_.stretches.size() ? comb_.stretches[stretch] : 1;
    score.order = comb_.order * stretched;
    score.line_orders.clear();
    for (const SignatureLine& line : comb_.lines) {
      score.line_orders.push_back(comb_.order_of(line, stretched));
    }
  }

  // As many lines as the sum has, each harmonic with its sidebands at a shift of its own: shifted
  // as a whole, a comb of evenly spaced lines would meet itself, and its decoys be copies of a few.
  // The offsets grow quadratically, so that no two decoys meet at one harmonic as they do at the
  // next.
  Eigen::VectorXd decoys_of_open_lines(Eigen::Index stretch) const {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(decoys_.cols());
    for (Eigen::Index i = 0; i < decoys_.rows(); ++i) {
      if (!open_(i, stretch)) continue;
      const int harmonic = comb_.lines[static_cast<std::size_t>(i)].sideband_of;
      const Eigen::Index group = harmonic < 0 ? i : harmonic;
      const Eigen::Index offset = 37 * (group * (group + 1) / 2) % decoys_.cols();
      sums.head(decoys_.cols() - offset) +=
          decoys_.row(i).tail(decoys_.cols() - offset).transpose();
      sums.tail(offset) += decoys_.row(i).head(offset).transpose();
    }
    return sums;
  }

  // Share of what noise moves the sum by that also moves the decoys' centre: they are made of so
  // many lines of the spectrum, and no more.
  double lines_per_decoy_line(Eigen::Index stretch) const {
    std::vector<Eigen::Index> taken;
    Eigen::Index lines = 0;
    for (Eigen::Index i = 0; i < open_.rows(); ++i) {
      if (!open_(i, stretch)) continue;
      ++lines;
      for (const Eigen::Index shift : shifts_)
        taken.push_back(comb_.bins(i, comb_.nominal) + shift);
    }
    std::ranges::sort(taken);
    taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
    const auto different = std::max<std::size_t>(taken.size(), 1);
    return static_cast<double>(lines) / static_cast<double>(different);
  }

  // The channel where the signature is deepest speaks for its depth; where none shows it, the one
  // whose noise could hide most, lest one that hears nothing of it seem to know.
  void read_depths(Eigen::Index stretch, SignatureScore& score) const {
    double deepest2 = -1;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const ChannelEvidence& evidence = *channels_[c];
      if (evidence.imfs.empty()) continue;
      const auto open = open_.col(stretch);
      const Eigen::ArrayXd depth2 = open.select(evidence.sum.depth2.col(stretch).array(), 0.0);
      const double sum = std::max(depth2.sum(), 0.0);
      const double variance = open.select(evidence.sum.variance.col(stretch).array(), 0.0).sum();
      score.channel_depths[c] = std::sqrt(sum);
      if (sum < deepest2 || (sum == deepest2 && variance <= score.depth2_variance)) continue;
      deepest2 = sum;
      score.channel = static_cast<int>(c);
      score.depth = std::sqrt(sum);
      score.depth2_variance = variance;
      for (std::size_t i = 0; i < score.line_depths.size(); ++i) {
        score.line_depths[i] = std::sqrt(std::max(depth2[static_cast<Eigen::Index>(i)], 0.0));
      }
      score.imf = evidence.imfs[strongest_imf(evidence, stretch)];
    }
  }

  static std::size_t strongest_imf(const ChannelEvidence& evidence, Eigen::Index stretch) {
    std::size_t strongest = 0;
    for (std::size_t k = 1; k < evidence.by_stretch.size(); ++k) {
      if (evidence.by_stretch[k][stretch] > evidence.by_stretch[strongest][stretch]) strongest = k;
    }
    return strongest;
  }

  const SignatureComb& comb_;
  std::vector<const ChannelEvidence*> channels_;
  Eigen::MatrixXd log_ratio_;
  Eigen::MatrixXd decoys_;
  std::vector<Eigen::Index> shifts_;
  std::size_t envelopes_ = 0;
  Mask open_;
};

// Lines of the spectrum that a part explains, once its order is found: those of its comb and all
// higher harmonics.
struct Explained {
  std::set<int> taken;
  std::set<int> smeared;

  void add(const SignatureComb& comb, double order, int highest_bin) {
    const double stretch = order / comb.order;
    for (const SignatureLine& line : comb.lines) {
      add_line(comb.bin_of(comb.order_of(line, stretch)));
    }
    for (int h = 1; comb.bin_of(h * order) <= highest_bin; ++h) add_line(comb.bin_of(h * order));
  }

 private:
  void add_line(Eigen::Index line) {
    const int at = static_cast<int>(line);
    const int reach = std::max(beside, static_cast<int>(smear * at));
    for (int bin = at - reach; bin <= at + reach; ++bin) smeared.insert(bin);
    for (int bin = at - beside; bin <= at + beside; ++bin) taken.insert(bin);
  }
};

int highest_bin(const std::vector<SignatureComb>& combs) {
  int highest = 0;
  for (const SignatureComb& comb : combs) {
    if (comb.bins.size() > 0) highest = std::max(highest, comb.bins.maxCoeff());
  }
  return highest;
}

}  // namespace

void ChannelEvidence::add(const CombEvidence& evidence, int imf, double share) {
  if (imfs.empty()) {
    sum.log_ratio = sum.depth2 = sum.variance =
        Eigen::MatrixXd::Zero(evidence.log_ratio.rows(), evidence.log_ratio.cols());
    sum.decoys = Eigen::MatrixXd::Zero(evidence.decoys.rows(), evidence.decoys.cols());
    sum.shifts = evidence.shifts;
  }
  sum.log_ratio += evidence.log_ratio;
  sum.depth2 += share * evidence.depth2;
  // IMFs of one channel may share all their noise: deviations add, not variances.
  sum.variance =
      (sum.variance.cwiseSqrt() + share * evidence.variance.cwiseSqrt()).cwiseAbs2().eval();
  sum.decoys += evidence.decoys;
  imfs.push_back(imf);
  by_stretch.push_back(evidence.log_ratio.colwise().sum().transpose());
}

std::vector<SignatureScore> score_signatures(
    const std::vector<std::vector<ChannelEvidence>>& channels,
    const std::vector<SignatureComb>& combs) {
  std::vector<RecordEvidence> records;
  std::vector<SignatureScore> scores;
  std::vector<std::size_t> waiting;  // those that roll, and have not explained their lines yet
  for (std::size_t s = 0; s < combs.size(); ++s) {
    records.emplace_back(channels, s, combs[s]);
    scores.push_back(records.back().score(static_cast<int>(s)));
    if (combs[s].rolls) waiting.push_back(s);
  }
  Explained explained;
  while (waiting.size() > 1) {
    const auto deepest = std::max_element(
        waiting.begin(), waiting.end(),
        [&](std::size_t a, std::size_t b) { return scores[a].depth < scores[b].depth; });
    explained.add(combs[*deepest], scores[*deepest].order, highest_bin(combs));
    waiting.erase(deepest);
    for (const std::size_t s : waiting) {
      records[s].leave_out(explained.taken, explained.smeared);
      scores[s] = records[s].score(static_cast<int>(s));
    }
  }
  return scores;
}

}  // namespace rvbench::analysis
