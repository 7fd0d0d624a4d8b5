#include "analysis/emd/emd.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "analysis/emd/extrema.hpp"
#include "analysis/emd/mean_envelope.hpp"

namespace rvbench::analysis {
namespace {

void check(const Eigen::Ref<const Eigen::VectorXd>& x, const EmdOptions& options) {
  const auto need_positive = [](const char* what, int value) {
    if (value < 1) {
      throw std::invalid_argument(std::string("emd: ") + what + " = " + std::to_string(value) +
                                  ", at least 1");
    }
  };
  need_positive("imfs", options.imfs);
  need_positive("sifts", options.sifts);
  if (!x.allFinite()) throw std::invalid_argument("emd: sample not finite");
}

// Fewer extrema are no oscillation: a maximum between two minima is the least.
constexpr std::size_t least_extrema = 3;

Eigen::Index unreliable_end(Eigen::Index n, std::size_t extrema, int sifts) {
  const double period = 2 * static_cast<double>(n) / static_cast<double>(extrema);
  return std::min(n, static_cast<Eigen::Index>(std::ceil(period * std::sqrt(sifts))));
}

}  // namespace

Emd emd(const Eigen::Ref<const Eigen::VectorXd>& x, const EmdOptions& options) {
  check(x, options);
  const Eigen::Index n = x.size();
  Emd result{.imfs = Eigen::MatrixXd(n, options.imfs), .residue = x, .unreliable_ends = {}};
  const double offset = n > 0 ? x.mean() : 0;  // would cost the modes digits
  result.residue.array() -= offset;

  Extrema extrema;
  MeanEnvelope mean_envelope;
  Eigen::Index found = 0;
  for (; found < options.imfs; ++found) {
    find_extrema(result.residue, extrema);
    if (extrema.count < least_extrema) break;
    auto imf = result.imfs.col(found);
    imf = result.residue;
    std::size_t count = 0;
    for (int sift = 0; sift < options.sifts && extrema.count >= least_extrema; ++sift) {
      count = extrema.count;
      mirror_ends(imf, extrema);
      mean_envelope.subtract_from(imf, extrema);
      find_extrema(imf, extrema);
    }
    result.residue -= imf;
    result.unreliable_ends.push_back(unreliable_end(n, count, options.sifts));
  }
  result.imfs.conservativeResize(n, found);
  result.residue.array() += offset;
  return result;
}

}  // namespace rvbench::analysis
