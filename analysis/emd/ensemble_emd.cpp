#include "analysis/emd/ensemble_emd.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/emd/extrema.hpp"
#include "analysis/emd/imf_sift.hpp"
#include "analysis/emd/unreliable_end.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {
namespace {

// Members are worked on side by side so many at a time, and summed in their order.
constexpr Eigen::Index batch = 16;

void check(const Eigen::Ref<const Eigen::VectorXd>& x, const EnsembleOptions& options) {
  check(options.emd);
  if (options.members < 1) throw std::invalid_argument("ensemble: members, at least 1");
  if (!(options.noise >= 0) || !std::isfinite(options.noise)) {
    throw std::invalid_argument("ensemble: noise, at least 0");
  }
  if (!x.allFinite()) throw std::invalid_argument("ensemble: sample not finite");
}

double deviation(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (x.size() == 0) return 0;
  return std::sqrt((x.array() - x.mean()).square().mean());
}

Eigen::VectorXd white_noise(Eigen::Index samples, std::uint64_t seed, Eigen::Index member) {
  std::seed_seq both{seed & 0xFFFFFFFFU, seed >> 32U, std::uint64_t(member)};
  std::mt19937_64 generator(both);
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(samples, [&] { return normal(generator); });
}

// Has a member give what it has. `sift` is nobody else's meanwhile.
using Give =
    std::function<void(std::size_t member, ImfSift& sift, Eigen::Ref<Eigen::VectorXd> given)>;

// Sums what each member gives, in their order: the result does not depend on the threads.
// @param sifts  one for each member of a batch
Eigen::VectorXd mean_of_members(Eigen::Index samples, const EnsembleOptions& options,
                                std::vector<ImfSift>& sifts, const Give& give) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(samples);
  Eigen::MatrixXd given(samples, std::min<Eigen::Index>(batch, options.members));
  for (Eigen::Index first = 0; first < options.members; first += batch) {
    const Eigen::Index count = std::min(batch, options.members - first);
    parallel_for(
        std::size_t(count),
        [&](std::size_t i) { give(std::size_t(first) + i, sifts[i], given.col(Eigen::Index(i))); },
        options.threads);
    for (Eigen::Index i = 0; i < count; ++i) sum += given.col(i);
  }
  return sum / options.members;
}

// The noise of each member, as far as its IMFs were not taken yet.
std::vector<Eigen::VectorXd> noise_of_members(Eigen::Index samples,
                                              const EnsembleOptions& options) {
  std::vector<Eigen::VectorXd> noise(std::size_t(options.members));
  parallel_for(
      noise.size(),
      [&](std::size_t i) { noise[i] = white_noise(samples, options.seed, Eigen::Index(i)); },
      options.threads);
  return noise;
}

// The next IMF of its noise; none if it has no more.
void take_next_noise(Eigen::VectorXd& noise, ImfSift& sift, int imf,
                     Eigen::Ref<Eigen::VectorXd> taken) {
  taken = noise;
  if (sift.turn_into_imf(taken, imf)) {
    noise -= taken;
  } else {
    taken.setZero();
  }
}

double scale_to(double size, const Eigen::Ref<const Eigen::VectorXd>& noise) {
  const double own = deviation(noise);
  return own > 0 ? size / own : 1;
}

enum class Kind { complete, improved };

// The noise that a member adds to what is left of the signal before IMF number `imf`.
void give_noise(Eigen::VectorXd& noise, ImfSift& sift, Kind kind, int imf, double size,
                Eigen::Ref<Eigen::VectorXd> given) {
  if (kind == Kind::complete && imf == 0) {
    given = noise;
  } else {
    take_next_noise(noise, sift, kind == Kind::complete ? imf - 1 : imf, given);
  }
  given *= kind == Kind::improved && imf > 0 ? size : scale_to(size, given);
}

// What the fastest IMF leaves of h. @return whether there is one
bool leave_imf_out(ImfSift& sift, int imf, Eigen::Ref<Eigen::VectorXd> h) {
  const Eigen::VectorXd whole = h;
  if (!sift.turn_into_imf(h, imf)) return false;
  h = whole - h;
  return true;
}

bool turn_into_imf_or_nothing(ImfSift& sift, int imf, Eigen::Ref<Eigen::VectorXd> h) {
  if (sift.turn_into_imf(h, imf)) return true;
  h.setZero();
  return false;
}

// Of each IMF, the largest of all members that have it.
void add_worst(const std::vector<Eigen::Index>& of_member, std::vector<Eigen::Index>& worst) {
  worst.resize(std::max(worst.size(), of_member.size()));
  for (std::size_t k = 0; k < of_member.size(); ++k) worst[k] = std::max(worst[k], of_member[k]);
}

Emd by_stages(const Eigen::Ref<const Eigen::VectorXd>& x, const EnsembleOptions& options,
              Kind kind) {
  check(x, options);
  const Eigen::Index n = x.size();
  Emd result{.imfs = Eigen::MatrixXd(n, options.emd.imfs), .residue = x, .unreliable_ends = {}};
  const double offset = n > 0 ? x.mean() : 0;  // would cost the modes digits
  result.residue.array() -= offset;
  std::vector<Eigen::VectorXd> noise = noise_of_members(n, options);
  std::vector<ImfSift> sifts(std::size_t(batch), ImfSift(options.emd));
  int found = 0;
  for (; found < options.emd.imfs && count_extrema(result.residue) >= least_extrema; ++found) {
    const Eigen::VectorXd before = result.residue;
    const double size = options.noise * deviation(before);
    std::vector<Eigen::Index> ends(noise.size());  // that each member's IMF makes unreliable
    const auto give = [&](std::size_t i, ImfSift& sift, Eigen::Ref<Eigen::VectorXd> given) {
      give_noise(noise[i], sift, kind, found, size, given);
      given += before;
      const bool has_imf = kind == Kind::improved ? leave_imf_out(sift, found, given)
                                                  : turn_into_imf_or_nothing(sift, found, given);
      if (has_imf) ends[i] = sift.unreliable_end(n);
    };
    const Eigen::VectorXd mean = mean_of_members(n, options, sifts, give);
    result.residue = kind == Kind::improved ? mean : Eigen::VectorXd(before - mean);
    result.imfs.col(found) = before - result.residue;
    add_unreliable_end(result.unreliable_ends, std::ranges::max(ends));
  }
  result.imfs.conservativeResize(n, found);
  result.residue.array() += offset;
  return result;
}

}  // namespace

Emd eemd(const Eigen::Ref<const Eigen::VectorXd>& x, const EnsembleOptions& options) {
  check(x, options);
  const Eigen::Index n = x.size();
  const double size = options.noise * deviation(x);
  Emd result{
      .imfs = Eigen::MatrixXd::Zero(n, options.emd.imfs), .residue = x, .unreliable_ends = {}};
  Eigen::Index most = 0;
  for (Eigen::Index first = 0; first < options.members; first += batch) {
    std::vector<Emd> given(std::size_t(std::min(batch, options.members - first)));
    parallel_for(
        given.size(),
        [&](std::size_t i) {
          const Eigen::VectorXd noise = white_noise(n, options.seed, first + Eigen::Index(i));
          given[i] = emd(x + size * noise, options.emd);
        },
        options.threads);
    for (const Emd& member : given) {
      const Eigen::Index imfs = member.imfs.cols();
      result.imfs.leftCols(imfs) += member.imfs;
      most = std::max(most, imfs);
      add_worst(member.unreliable_ends, result.unreliable_ends);
    }
  }
  result.imfs.conservativeResize(n, most);
  result.imfs /= options.members;
  result.residue -= result.imfs.rowwise().sum();
  return result;
}

Emd ceemdan(const Eigen::Ref<const Eigen::VectorXd>& x, const EnsembleOptions& options) {
  return by_stages(x, options, Kind::complete);
}

Emd iceemdan(const Eigen::Ref<const Eigen::VectorXd>& x, const EnsembleOptions& options) {
  return by_stages(x, options, Kind::improved);
}

}  // namespace rvbench::analysis
