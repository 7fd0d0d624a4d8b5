#include "analysis/emd/stopping.hpp"

namespace rvbench::analysis {
namespace {

constexpr double resolution = 1e5;  // 50 dB, in squares

class Energy final : public Stopping {
 public:
  bool is_imf(const SiftState& state) override {
    return state.h.squaredNorm() >= resolution * state.mean.squaredNorm();
  }
};

}  // namespace

const StoppingRule& energy_stopping() {
  static constexpr StoppingRule rule{"energy", begin_stopping<Energy>};
  return rule;
}

}  // namespace rvbench::analysis
