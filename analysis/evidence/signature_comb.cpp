#include "analysis/evidence/signature_comb.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index lines_beside = 2;  // a Hann line does not reach further
constexpr Eigen::Index stride = 3;  // so that two decoys of one line share no noise

Eigen::VectorXd stretches_of(double reach, Eigen::Index tries) {
  if (tries == 0) return Eigen::VectorXd::Ones(1);
  return Eigen::VectorXd::LinSpaced(2 * tries + 1, 1 - reach, 1 + reach);
}

// Whether a shift leads from a line of the gear train to where it has none.
bool between_locked(Eigen::Index shift, Eigen::Index locked_every) {
  if (locked_every < 2 * lines_beside) return true;  // too dense to step around
  const Eigen::Index away = shift % locked_every;
  return away >= lines_beside && away <= locked_every - lines_beside;
}

}  // namespace

double SignatureComb::order_of(const SignatureLine& line, double stretch) const {
  const SignatureLine& harmonic =
      line.sideband_of < 0 ? line : lines[static_cast<std::size_t>(line.sideband_of)];
  return line.order + (stretch - 1) * harmonic.order;
}

Eigen::Index SignatureComb::bin_of(double at_order) const {
  return static_cast<Eigen::Index>(std::lround(at_order / resolution));
}

std::vector<SignatureComb> signature_combs(const Kinematics& kinematics, double resolution) {
  if (!(resolution > 0)) throw std::invalid_argument("signature_combs: resolution must be above 0");
  std::vector<std::vector<SignatureLine>> lines = signature_lines(kinematics, resolution);
  std::vector<SignatureComb> combs;
  for (std::size_t s = 0; s < lines.size(); ++s) {
    const Signature& signature = kinematics.signatures[s];
    SignatureComb comb{.lines = std::move(lines[s]),
                       .order = signature.order,
                       .rolls = signature.slip > 0,
                       .resolution = resolution};
    double highest = 0;
    for (const SignatureLine& line : comb.lines) {
      if (line.sideband_of < 0) highest = std::max(highest, line.order);
    }
    const double reach = std::max(signature.slip, signature.tolerance);
    comb.nominal = static_cast<Eigen::Index>(std::ceil(2 * reach * highest / resolution));
    comb.stretches = stretches_of(reach, comb.nominal);
    comb.bins.resize(static_cast<Eigen::Index>(comb.lines.size()), comb.stretches.size());
    for (Eigen::Index i = 0; i < comb.bins.rows(); ++i) {
      for (Eigen::Index t = 0; t < comb.bins.cols(); ++t) {
        const SignatureLine& line = comb.lines[static_cast<std::size_t>(i)];
        comb.bins(i, t) = static_cast<int>(comb.bin_of(comb.order_of(line, comb.stretches[t])));
      }
    }
    combs.push_back(std::move(comb));
  }
  return combs;
}

std::vector<Eigen::Index> decoy_shifts(const SignatureComb& comb, Eigen::Index locked_every) {
  Eigen::Index reach = 0;
  for (Eigen::Index i = 0; i < comb.bins.rows(); ++i) {
    const auto last = comb.bins.cols() - 1;
    reach = std::max<Eigen::Index>(reach, comb.bins(i, last) - comb.bins(i, comb.nominal));
  }
  const auto one_order = reach + comb.bin_of(1);
  std::vector<Eigen::Index> shifts;
  for (Eigen::Index shift = reach + lines_beside; shifts.size() < std::size_t{decoys}; ++shift) {
    if (!comb.rolls && !between_locked(shift, locked_every)) continue;
    if (shift > one_order && shifts.size() >= std::size_t{fewest_decoys}) break;
    shifts.push_back(shifts.size() % 2 == 0 ? shift : -shift);
    shift += stride - 1;
  }
  return shifts;
}

}  // namespace rvbench::analysis
