#include "analysis/emd/imf_sift.hpp"

#include <algorithm>

#include "analysis/emd/unreliable_end.hpp"

namespace rvbench::analysis {

ImfSift::ImfSift(const EmdOptions& options) : chain_(options.sifts, options.rule) {
  if (options.stopping != nullptr) passes_.emplace(*options.stopping, options.rule, options.sifts);
}

bool ImfSift::turn_into_imf(Eigen::Ref<Eigen::VectorXd> h, int imf) {
  return passes_ ? passes_->turn_into_imf(h) : chain_.turn_into_imf(h, imf);
}

Eigen::Index ImfSift::unreliable_end(Eigen::Index samples) const {
  if (!passes_) {
    return analysis::unreliable_end(samples, chain_.sifted_extrema(), chain_.sifts());
  }
  const auto sifts = static_cast<std::size_t>(std::max(passes_->sifts(), 1));
  return analysis::unreliable_end(samples, passes_->extrema(), sifts);
}

}  // namespace rvbench::analysis
