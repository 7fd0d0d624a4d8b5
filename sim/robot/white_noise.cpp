#include "sim/robot/white_noise.hpp"

#include <cmath>

namespace rvbench::sim {
namespace {

class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  double within_one() { return static_cast<double>(next() >> 11U) * 0x1p-52 - 1; }  // [-1, 1)

 private:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_;
};

}  // namespace

void add_white_noise(Eigen::Ref<Eigen::VectorXd> samples, double rms, std::uint64_t seed) {
  if (rms == 0) return;
  SplitMix64 uniform(seed);
  for (Eigen::Index i = 0; i < samples.size(); i += 2) {
    double a = 0, b = 0, square = 0;
    do {
      a = uniform.within_one();
      b = uniform.within_one();
      square = a * a + b * b;
    } while (square >= 1 || square == 0);
    const double scale = rms * std::sqrt(-2 * std::log(square) / square);
    samples[i] += scale * a;
    if (i + 1 < samples.size()) samples[i + 1] += scale * b;
  }
}

}  // namespace rvbench::sim
