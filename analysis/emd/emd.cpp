#include "analysis/emd/emd.hpp"

#include <stdexcept>
#include <string>

#include "analysis/emd/imf_sift.hpp"
#include "analysis/emd/unreliable_end.hpp"

namespace rvbench::analysis {

void check(const EmdOptions& options) {
  const auto need_positive = [](const char* what, int value) {
    if (value < 1) {
      throw std::invalid_argument(std::string("emd: ") + what + " = " + std::to_string(value) +
                                  ", at least 1");
    }
  };
  need_positive("imfs", options.imfs);
  need_positive("sifts", options.sifts);
}

Emd emd(const Eigen::Ref<const Eigen::VectorXd>& x, const EmdOptions& options) {
  check(options);
  if (!x.allFinite()) throw std::invalid_argument("emd: sample not finite");
  const Eigen::Index n = x.size();
  Emd result{.imfs = Eigen::MatrixXd(n, options.imfs), .residue = x, .unreliable_ends = {}};
  const double offset = n > 0 ? x.mean() : 0;  // would cost the modes digits
  result.residue.array() -= offset;

  ImfSift sift(options);
  int found = 0;
  for (; found < options.imfs; ++found) {
    auto imf = result.imfs.col(found);
    imf = result.residue;
    if (!sift.turn_into_imf(imf, found)) break;
    result.residue -= imf;
    add_unreliable_end(result.unreliable_ends, sift.unreliable_end(n));
  }
  result.imfs.conservativeResize(n, found);
  result.residue.array() += offset;
  return result;
}

}  // namespace rvbench::analysis
