#include "analysis/compare/slipping_comb.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/evidence/decoy_p_value.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr int decoys = 48;
constexpr double golden = 0.618033988749895;  // its multiples fill 0..1 evenly

}  // namespace

SlippingComb::SlippingComb(std::size_t index, const Signature& signature, double reach,
                           const std::vector<Quantity>& quantities, double highest,
                           const SpectralPeaks& peaks, const std::vector<Peak>& of_others)
    : signature_(index), order_(signature.order), reach_(reach), peaks_(&peaks) {
  taken_.resize(static_cast<std::size_t>(peaks.size()), false);
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (!quantities[q].is_in(index) || !fits(quantities[q].order)) continue;
    quantities_.push_back(q);
    orders_.push_back(quantities[q].order);
  }
  add_harmonics(highest);
  leave_out(of_others);
  alone_ = stretch_;
}

std::vector<Peak> SlippingComb::found() const {
  std::vector<Peak> found;
  if (p_value_ > found_p) return found;
  const auto add = [&](double order) {
    const Index line = peaks_->line_of(order);
    const bool is_known =
        std::ranges::any_of(found, [&](const Peak& peak) { return peak.holds(line); });
    if (is_known || line < 0 || line >= peaks_->size() || taken_[static_cast<std::size_t>(line)])
      return;
    if (const auto peak = peaks_->at(order, reach_)) found.push_back(*peak);
  };
  for (const double order : orders_) add(order * stretch_);
  if (order_ < 1) return found;
  const double highest = *std::ranges::max_element(orders_);
  for (double harmonic = order_; harmonic <= highest; harmonic += order_) {
    for (const double side : {-1.0, 1.0}) add(harmonic * stretch_ + side);
  }
  return found;
}

bool SlippingComb::shares(const std::vector<Peak>& peaks) const {
  const auto shared = std::ranges::count_if(peaks, [&](const Peak& peak) {
    return std::ranges::any_of(
        orders_, [&](double order) { return peak.holds(peaks_->line_of(order * alone_)); });
  });
  return 2 * static_cast<std::size_t>(shared) > peaks.size();
}

void SlippingComb::leave_out(const std::vector<Peak>& peaks) {
  for (const Peak& peak : peaks) {
    std::fill(taken_.begin() + peak.from, taken_.begin() + peak.to + 1, true);
  }
  if (orders_.empty()) return;
  const Best best = best_of(orders_);
  stretch_ = best.stretch;
  Eigen::VectorXd sums(decoys);
  for (int i = 0; i < decoys; ++i) sums[i] = best_of(decoy(i)).sum;
  p_value_ = decoy_p_value(best.sum, sums);
}

bool SlippingComb::is_taken_at(double order) const {
  return taken_[static_cast<std::size_t>(peaks_->line_of(order * stretch_))];
}

void SlippingComb::add_harmonics(double highest) {
  if (orders_.empty() || order_ < 1) return;
  constexpr double next = 1 + 1e-6;  // also where the last is a harmonic but for rounding
  for (double h = std::floor(orders_.back() / order_ + next);
       h * order_ <= highest && fits(h * order_); ++h) {
    orders_.push_back(h * order_);
  }
}

// The stretch at which these orders stand out most; their own where none does.
SlippingComb::Best SlippingComb::best_of(const std::vector<double>& orders) const {
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

double SlippingComb::sum_at(const std::vector<double>& orders, double stretch) const {
  double sum = 0;
  for (const double order : orders) {
    const Index line = peaks_->line_of(order * stretch);
    if (!taken_[static_cast<std::size_t>(line)]) sum += peaks_->log_ratio(line);
  }
  return sum;
}

// The comb with each harmonic, and its sidebands, up to an order off its place.
std::vector<double> SlippingComb::decoy(int number) const {
  std::vector<double> orders;
  for (const double order : orders_) {
    const double harmonic = std::max(1.0, std::round(order / order_));
    const double part = std::fmod(golden * (number + 1) * (2 * harmonic - 1), 1.0);
    const double farthest = std::min(1.0, order_ / 2);
    const double off = farthest * (2 * part - 1);
    const double moved = std::abs(order + off);
    orders.push_back(fits(moved) ? moved : order - std::abs(off));
  }
  return orders;
}

}  // namespace rvbench::analysis
