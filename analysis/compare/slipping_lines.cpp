#include "analysis/compare/slipping_lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/compare/line_level.hpp"
#include "analysis/evidence/decoy_p_value.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr int decoys = 48;
constexpr double golden = 0.618033988749895;  // its multiples fill 0..1 evenly

// A line found in a spectrum, from its first bin to its last.
struct Peak {
  Index from, to;
};

// A spectrum in which peaks are looked for.
class Peaks {
 public:
  Peaks(const Spectrum& spectrum, const LineFloor& floor, double blocks)
      : spectrum_(spectrum),
        floor_(floor),
        blocks_(blocks),
        log_ratio_((floor.power.array() / floor.floor.array()).max(1).log()) {}

  Index size() const { return log_ratio_.size(); }
  double resolution() const { return spectrum_.resolution; }
  Index bin_of(double order) const {
    return static_cast<Index>(std::lround(order / spectrum_.resolution));
  }
  double log_ratio(Index bin) const { return log_ratio_[bin]; }

  // What stands out of the noise at an order: as wide as a Hann line at least, as far as it is
  // smeared at most.
  std::optional<Peak> at(double order, double smear) const {
    const auto level =
        line_level(spectrum_, floor_, blocks_, order, spectrum_.resolution, smear * order);
    if (!level || level->p_value > seen_p) return std::nullopt;
    Index highest = bin_of(order);
    for (const Index bin : {highest - 1, highest + 1}) {
      if (floor_.power[bin] > floor_.power[highest]) highest = bin;
    }
    constexpr auto hann = static_cast<Index>(lines_to_part) - 1;
    const auto reach = std::max(hann, static_cast<Index>(smear * static_cast<double>(highest)));
    Peak peak{highest, highest};
    while (peak.from > std::max<Index>(highest - reach, 0) && stands_out(peak.from - 1)) {
      --peak.from;
    }
    while (peak.to < std::min(highest + reach, size() - 1) && stands_out(peak.to + 1)) ++peak.to;
    peak.from = std::max<Index>(std::min(peak.from, highest - hann), 0);
    peak.to = std::min(std::max(peak.to, highest + hann), size() - 1);
    return peak;
  }

 private:
  bool stands_out(Index bin) const {
    return line_p_value(blocks_ * floor_.power[bin] / floor_.floor[bin], blocks_,
                        blocks_ * floor_.floor_lines[bin]) <= seen_p;
  }

  const Spectrum& spectrum_;
  const LineFloor& floor_;
  double blocks_;
  Eigen::ArrayXd log_ratio_;
};

// The lines of one signature.
class Comb {
 public:
  Comb(std::size_t signature, double order, double reach, const std::vector<Quantity>& quantities,
       const Peaks& peaks, const std::vector<Peak>& of_others)
      : signature_(signature), order_(order), reach_(reach), peaks_(&peaks) {
    taken_.resize(static_cast<std::size_t>(peaks.size()), false);
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const Quantity& line = quantities[q];
      if (std::ranges::find(line.families, signature) == line.families.end()) continue;
      if (peaks.bin_of(line.order * (1 + reach)) + 2 >= peaks.size()) continue;
      quantities_.push_back(q);
      orders_.push_back(line.order);
    }
    leave_out(of_others);
    place();
    alone_ = stretch_;
  }

  std::size_t signature() const { return signature_; }
  double p_value() const { return p_value_; }

  // Those of its lines that stand out.
  std::vector<Peak> found() const {
    std::vector<Peak> found;
    if (p_value_ > found_p) return found;
    for (const double order : orders_) {
      if (is_taken(order)) continue;
      if (const auto peak = peaks_->at(order * stretch_, reach_)) found.push_back(*peak);
    }
    return found;
  }

  // Whether its lines, looked for alone, lie on more than half of these.
  bool shares(const std::vector<Peak>& peaks) const {
    const auto shared = std::ranges::count_if(peaks, [&](const Peak& peak) {
      return std::ranges::any_of(orders_, [&](double order) {
        const Index bin = peaks_->bin_of(order * alone_);
        return bin >= peak.from && bin <= peak.to;
      });
    });
    return 2 * static_cast<std::size_t>(shared) > peaks.size();
  }

  void leave_out(const std::vector<Peak>& peaks) {
    if (peaks.empty()) return;
    for (const Peak& peak : peaks) {
      std::fill(taken_.begin() + peak.from, taken_.begin() + peak.to + 1, true);
    }
    place();
  }

  void tell(std::vector<SlippingLine>& lines) const {
    for (std::size_t i = 0; i < orders_.size(); ++i) {
      SlippingLine& line = lines[quantities_[i]];
      const bool taken = is_taken(orders_[i]);
      if (std::isnan(line.order) || (line.taken && !taken))
        line = {orders_[i] * stretch_, p_value_, taken};
    }
  }

 private:
  bool is_taken(double order) const {
    return taken_[static_cast<std::size_t>(peaks_->bin_of(order * stretch_))];
  }

  struct Best {
    double stretch, sum;
  };

  // The stretch at which these orders stand out most; their own where none does.
  Best best_of(const std::vector<double>& orders) const {
    const double highest = *std::ranges::max_element(orders_);
    const auto tries = static_cast<int>(std::ceil(2 * reach_ * highest / peaks_->resolution()));
    Best best{1, sum_at(orders, 1)};
    for (int i = -tries; i <= tries; ++i) {
      const double stretch = 1 + reach_ * i / std::max(tries, 1);
      const double sum = sum_at(orders, stretch);
      if (sum > best.sum) best = {stretch, sum};
    }
    return best;
  }

  double sum_at(const std::vector<double>& orders, double stretch) const {
    double sum = 0;
    for (const double order : orders) {
      const Index bin = std::min(peaks_->bin_of(order * stretch), peaks_->size() - 1);
      if (!taken_[static_cast<std::size_t>(bin)]) sum += peaks_->log_ratio(bin);
    }
    return sum;
  }

  // The comb with each harmonic, and its sidebands, up to an order off its place.
  std::vector<double> decoy(int number) const {
    std::vector<double> orders;
    for (const double order : orders_) {
      const double harmonic = std::max(1.0, std::round(order / order_));
      const double part = std::fmod(golden * (number + 1) * (2 * harmonic - 1), 1.0);
      const double farthest = std::min(1.0, order_ / 2);
      orders.push_back(std::abs(order + farthest * (2 * part - 1)));
    }
    return orders;
  }

  void place() {
    if (orders_.empty()) return;
    const Best best = best_of(orders_);
    stretch_ = best.stretch;
    Eigen::VectorXd sums(decoys);
    for (int i = 0; i < decoys; ++i) sums[i] = best_of(decoy(i)).sum;
    p_value_ = decoy_p_value(best.sum, sums);
  }

  std::size_t signature_;
  double order_;
  double reach_;  // relative
  const Peaks* peaks_;
  std::vector<bool> taken_;  // bins
  std::vector<std::size_t> quantities_;
  std::vector<double> orders_;
  double stretch_ = 1, alone_ = 1, p_value_ = 1;
};

// 9 and 1, not 2.5 and 1.
bool is_multiple(double order, double of) {
  const double times = std::round(order / of);
  return times > 1 && std::abs(order - times * of) < 1e-6 * order;
}

std::vector<Peak> of_input_shaft(const Peaks& peaks, double speed_error) {
  std::vector<Peak> found;
  for (double order = 1; peaks.bin_of(order) + 2 < peaks.size(); ++order) {
    if (const auto peak = peaks.at(order, speed_error)) found.push_back(*peak);
  }
  return found;
}

}  // namespace

SlippingLines find_slipping_lines(const Kinematics& kinematics,
                                  const std::vector<Quantity>& quantities, const Spectrum& spectrum,
                                  const LineFloor& floor, double blocks, double speed_error) {
  const Peaks peaks(spectrum, floor, blocks);
  const std::vector<Peak> of_shaft = of_input_shaft(peaks, speed_error);
  std::vector<Comb> waiting;
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    const Signature& signature = kinematics.signatures[s];
    const double stray = std::max(signature.slip, signature.tolerance);
    if (stray > 0)
      waiting.emplace_back(s, signature.order, stray + speed_error, quantities, peaks, of_shaft);
  }

  SlippingLines found{std::vector<SlippingLine>(quantities.size()), {}};
  const auto add_unparted = [&](std::size_t one, std::size_t other) {
    found.unparted.emplace_back(std::min(one, other), std::max(one, other));
  };
  std::vector<std::size_t> shown;
  while (!waiting.empty()) {
    const auto first = std::ranges::min_element(waiting, {}, &Comb::p_value);
    first->tell(found.lines);
    const std::vector<Peak> explained = first->found();
    const std::size_t explains = first->signature();
    waiting.erase(first);
    if (explained.empty()) continue;
    const double order = kinematics.signatures[explains].order;
    for (const std::size_t one : shown) {
      const double earlier = kinematics.signatures[one].order;
      if (is_multiple(order, earlier) || is_multiple(earlier, order)) add_unparted(one, explains);
    }
    shown.push_back(explains);
    for (Comb& other : waiting) {
      if (other.shares(explained)) {
        add_unparted(explains, other.signature());
      } else {
        other.leave_out(explained);
      }
    }
  }
  return found;
}

}  // namespace rvbench::analysis
