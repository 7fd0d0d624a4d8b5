#include "analysis/emd/ensemble_emd.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/emd/imf_sift.hpp"
#include "analysis/emd/sift_chain.hpp"
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

// Sums what each member gives, in their order: the result does not depend on the threads.
Eigen::VectorXd mean_of_members(
    Eigen::Index samples, const EnsembleOptions& options,
    const std::function<void(Eigen::Index, Eigen::Ref<Eigen::VectorXd>)>& give) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(samples);
  Eigen::MatrixXd given(samples, std::min<Eigen::Index>(batch, options.members));
  for (Eigen::Index first = 0; first < options.members; first += batch) {
    const Eigen::Index count = std::min(batch, options.members - first);
    parallel_for(
        std::size_t(count),
        [&](std::size_t i) { give(first + Eigen::Index(i), given.col(Eigen::Index(i))); },
        options.threads);
    for (Eigen::Index i = 0; i < count; ++i) sum += given.col(i);
  }
  return sum / options.members;
}

// What a member knows: its noise, as far as its IMFs were not taken yet.
struct Member {
  Eigen::VectorXd noise;
  ImfSift sift;
};

// The next IMF of its noise; none if it has no more.
Eigen::VectorXd next_noise(Member& member, int imf) {
  Eigen::VectorXd next = member.noise;
  if (!member.sift.turn_into_imf(next, imf)) return Eigen::VectorXd::Zero(next.size());
  member.noise -= next;
  return next;
}

std::vector<Member> members_of(Eigen::Index samples, const EnsembleOptions& options) {
  std::vector<Member> members;
  for (Eigen::Index i = 0; i < options.members; ++i) {
    members.push_back({white_noise(samples, options.seed, i), ImfSift(options.emd)});
  }
  return members;
}

Eigen::VectorXd scaled_to(double size, const Eigen::VectorXd& noise) {
  const double own = deviation(noise);
  return own > 0 ? Eigen::VectorXd(noise * (size / own)) : noise;
}

enum class Kind { complete, improved };

// The noise that a member adds to what is left of the signal before IMF number `imf`.
Eigen::VectorXd added_noise(Member& member, Kind kind, int imf, double size) {
  if (kind == Kind::complete && imf == 0) return scaled_to(size, member.noise);
  const Eigen::VectorXd next = next_noise(member, kind == Kind::complete ? imf - 1 : imf);
  return kind == Kind::improved && imf > 0 ? Eigen::VectorXd(size * next) : scaled_to(size, next);
}

bool swings(const Eigen::VectorXd& x, const EmdOptions& options) {
  Eigen::VectorXd one = x;
  return SiftChain(1, options.rule).turn_into_imf(one, 0);
}

Emd by_stages(const Eigen::Ref<const Eigen::VectorXd>& x, const EnsembleOptions& options,
              Kind kind) {
  check(x, options);
  const Eigen::Index n = x.size();
  Emd result{.imfs = Eigen::MatrixXd(n, options.emd.imfs), .residue = x, .unreliable_ends = {}};
  const double offset = n > 0 ? x.mean() : 0;  // would cost the modes digits
  result.residue.array() -= offset;
  std::vector<Member> members = members_of(n, options);
  int found = 0;
  for (; found < options.emd.imfs && swings(result.residue, options.emd); ++found) {
    const Eigen::VectorXd before = result.residue;
    const double size = options.noise * deviation(before);
    const auto give = [&](Eigen::Index i, Eigen::Ref<Eigen::VectorXd> given) {
      Member& member = members[std::size_t(i)];
      const Eigen::VectorXd noisy = before + added_noise(member, kind, found, size);
      given = noisy;
      const bool is_imf = member.sift.turn_into_imf(given, found);
      if (kind == Kind::improved) given = is_imf ? Eigen::VectorXd(noisy - given) : noisy;
      if (kind == Kind::complete && !is_imf) given.setZero();
    };
    const Eigen::VectorXd mean = mean_of_members(n, options, give);
    result.residue = kind == Kind::improved ? mean : Eigen::VectorXd(before - mean);
    result.imfs.col(found) = before - result.residue;
    const Eigen::Index inherited = found > 0 ? result.unreliable_ends.back() : 0;
    const Eigen::Index own = members.front().sift.unreliable_end(n);
    result.unreliable_ends.push_back(std::max(inherited, own));
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
      if (imfs > most) result.unreliable_ends = member.unreliable_ends;
      most = std::max(most, imfs);
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
