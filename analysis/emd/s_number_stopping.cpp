#include <cstdlib>

#include "analysis/emd/extrema.hpp"
#include "analysis/emd/stopping.hpp"

namespace rvbench::analysis {
namespace {

constexpr int sifts_unchanged = 4;

// Samples that are zero have the sign of those before.
std::ptrdiff_t count_zero_crossings(const Eigen::VectorXd& h) {
  std::ptrdiff_t count = 0;
  double before = 0;
  for (const double sample : h) {
    if (sample * before < 0) ++count;
    if (sample != 0) before = sample > 0 ? 1 : -1;
  }
  return count;
}

class SNumber final : public Stopping {
 public:
  bool is_imf(const SiftState& state) override {
    const auto extrema = static_cast<std::ptrdiff_t>(count_extrema(state.h));
    const std::ptrdiff_t crossings = count_zero_crossings(state.h);
    const bool is_same = extrema == extrema_ && crossings == crossings_;
    const bool alternates = std::abs(extrema - crossings) <= 1;
    unchanged_ = is_same && alternates ? unchanged_ + 1 : 0;
    extrema_ = extrema;
    crossings_ = crossings;
    return unchanged_ >= sifts_unchanged;
  }

 private:
  std::ptrdiff_t extrema_ = -1, crossings_ = -1;
  int unchanged_ = 0;
};

}  // namespace

const StoppingRule& s_number_stopping() {
  static constexpr StoppingRule rule{"s_number", begin_stopping<SNumber>};
  return rule;
}

}  // namespace rvbench::analysis
