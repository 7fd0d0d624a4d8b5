#include "analysis/order/line_ridge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/spectrum.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index smallest_block = 32;
constexpr Eigen::Index fewest_lines = 16;
constexpr int highest_moment = 24;  // of the Chernoff bound

// The lines of all blocks within the search.
struct Blocks {
  Eigen::Index first = 0;  // line of the search's lower end
  Eigen::Index lines = 0;  // within it
  Eigen::Index reach = 1;  // lines that the ridge may move from block to block
  double resolution_Hz = 0;
  std::vector<Spectrum> spectra;
  Eigen::MatrixXd rises;  // ln(1 + P/floor): lines by blocks
};

Eigen::VectorXd rises_of(const Spectrum& spectrum, Eigen::Index first, Eigen::Index lines) {
  const Eigen::ArrayXd power = spectrum.amplitude.segment(first, lines).array().square();
  // Noise power is exponentially distributed: its median is ln 2 of its mean.
  const double floor = median({power.begin(), power.end()}) / std::numbers::ln2;
  if (!(floor > 0)) return Eigen::VectorXd::Zero(lines);
  return (power / floor).log1p();
}

Blocks blocks_of(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                 const RidgeSearch& search) {
  constexpr Require require{"line_ridge"};
  require_positive(rate_Hz, "line_ridge", "rate_Hz");
  require_positive(search.block_s, "line_ridge", "block_s");
  require(search.from_Hz >= 0 && search.to_Hz > search.from_Hz && search.to_Hz <= rate_Hz / 2,
          "the band must lie within half the rate");
  require(search.most_change_Hz_s >= 0, "most_change_Hz_s must not be below 0");
  require(x.allFinite(), "a sample is not finite");
  const Eigen::Index half = std::llround(search.block_s * rate_Hz / 2), size = 2 * half;
  require(size >= smallest_block, "a block needs 32 samples");

  Blocks blocks;
  blocks.resolution_Hz = rate_Hz / static_cast<double>(size);
  blocks.first = std::max<Eigen::Index>(
      2, static_cast<Eigen::Index>(std::ceil(search.from_Hz / blocks.resolution_Hz)));
  const auto last = std::min(
      half - 1, static_cast<Eigen::Index>(std::floor(search.to_Hz / blocks.resolution_Hz)));
  blocks.lines = last - blocks.first + 1;
  require(blocks.lines >= fewest_lines, "the band must be at least 16 lines of a block wide");
  const double change = search.most_change_Hz_s * search.block_s / 2 / blocks.resolution_Hz;
  blocks.reach =
      std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::ceil(change)), 1, blocks.lines - 1);
  for (Eigen::Index start = 0; start + size <= x.size(); start += half) {
    blocks.spectra.push_back(amplitude_spectrum(x.segment(start, size), rate_Hz, Window::hann));
  }
  blocks.rises.resize(blocks.lines, static_cast<Eigen::Index>(blocks.spectra.size()));
  for (Eigen::Index b = 0; b < blocks.rises.cols(); ++b) {
    blocks.rises.col(b) =
        rises_of(blocks.spectra[static_cast<std::size_t>(b)], blocks.first, blocks.lines);
  }
  return blocks;
}

// The path of the largest sum: for each block the line within the search.
std::vector<Eigen::Index> highest_path(const Blocks& blocks) {
  const Eigen::Index count = blocks.rises.cols(), lines = blocks.lines;
  Eigen::VectorXd best = blocks.rises.col(0), next(lines);
  Eigen::Matrix<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic> came_from(lines, count);
  for (Eigen::Index b = 1; b < count; ++b) {
    for (Eigen::Index k = 0; k < lines; ++k) {
      const Eigen::Index from = std::max<Eigen::Index>(k - blocks.reach, 0);
      const Eigen::Index to = std::min(k + blocks.reach, lines - 1);
      Eigen::Index at = 0;
      next[k] = best.segment(from, to - from + 1).maxCoeff(&at) + blocks.rises(k, b);
      came_from(k, b) = from + at;
    }
    best.swap(next);
  }
  std::vector<Eigen::Index> path(static_cast<std::size_t>(count));
  best.maxCoeff(&path.back());
  for (Eigen::Index b = count - 1; b > 0; --b) {
    path[static_cast<std::size_t>(b - 1)] = came_from(path[static_cast<std::size_t>(b)], b);
  }
  return path;
}

// ln of a bound of the probability that noise lines of so many blocks reach a sum of rises:
// E[(1 + E)^t] = Σ t!/k! for exponential E and whole t.
double log_bound(double sum, double blocks) {
  double bound = 0, moment = 1;
  for (int t = 1; t <= highest_moment; ++t) {
    moment = 1 + t * moment;
    bound = std::min(bound, blocks * std::log(moment) - t * sum);
  }
  return bound;
}

double p_value_of(const Blocks& blocks, const std::vector<Eigen::Index>& path) {
  double sum = 0, independent = 0;
  for (std::size_t b = 0; b < path.size(); b += 2) {
    sum += blocks.rises(path[b], static_cast<Eigen::Index>(b));
    ++independent;
  }
  const double log_paths = std::log(static_cast<double>(blocks.lines)) +
                           (independent - 1) * std::log(4 * double(blocks.reach) + 1);
  return std::min(1.0, std::exp(log_paths + log_bound(sum, independent)));
}

double frequency_Hz(const Blocks& blocks, std::size_t block, Eigen::Index line) {
  const Eigen::VectorXd& amplitude = blocks.spectra[block].amplitude;
  Eigen::Index top = blocks.first + line;
  if (amplitude[top - 1] > amplitude[top]) --top;
  if (amplitude[top + 1] > amplitude[top]) ++top;
  const double place =
      std::clamp(place_of_tone(amplitude, top), double(top) - 0.5, double(top) + 0.5);
  return place * blocks.resolution_Hz;
}

}  // namespace

std::optional<LineRidge> line_ridge(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                    const RidgeSearch& search) {
  const Blocks blocks = blocks_of(x, rate_Hz, search);
  if (blocks.spectra.empty()) return std::nullopt;
  const std::vector<Eigen::Index> path = highest_path(blocks);
  LineRidge ridge;
  ridge.p_value = p_value_of(blocks, path);
  if (!(ridge.p_value < significant_p)) return std::nullopt;
  ridge.start_s = 0.5 / blocks.resolution_Hz;
  ridge.step_s = ridge.start_s;
  ridge.frequency_Hz.resize(static_cast<Eigen::Index>(path.size()));
  for (std::size_t b = 0; b < path.size(); ++b) {
    ridge.frequency_Hz[static_cast<Eigen::Index>(b)] = frequency_Hz(blocks, b, path[b]);
  }
  return ridge;
}

}  // namespace rvbench::analysis
