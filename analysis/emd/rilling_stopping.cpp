#include "analysis/emd/stopping.hpp"

namespace rvbench::analysis {
namespace {

constexpr double usual = 0.05;  // |mean| / amplitude ...
constexpr double anywhere = 0.5;
constexpr double share_beyond_usual = 0.05;  // of the samples

class Rilling final : public Stopping {
 public:
  bool is_imf(const SiftState& state) override {
    const auto mean = state.mean.array().abs();
    const auto amplitude = state.amplitude.array().abs();
    const auto beyond = static_cast<double>((mean > usual * amplitude).count());
    return beyond <= share_beyond_usual * static_cast<double>(mean.size()) &&
           (mean <= anywhere * amplitude).all();
  }
};

}  // namespace

const StoppingRule& rilling_stopping() {
  static constexpr StoppingRule rule{"rilling", begin_stopping<Rilling>};
  return rule;
}

}  // namespace rvbench::analysis
