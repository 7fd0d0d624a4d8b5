#pragma once

#include <cstddef>
#include <vector>

#include "analysis/compare/quantities.hpp"
#include "analysis/compare/spectral_peaks.hpp"
#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// p-value up to which a part is found: of the four of a bearing one by chance once in 25.
inline constexpr double found_p = 0.01;

/// The lines of one part that slips, where all together stand out most: those that are compared,
/// and its higher harmonics.
///
/// The p-value is that of their sum of ln(power / floor), against the sums of the same search for
/// combs whose harmonics lie off their places. A part that turns slower than the input shaft has a
/// harmonic next to anything: of such none are added.
///
/// Units   orders of the input shaft; relative
/// Errors  none thrown
/// Source  ours; p-value: decoy_p_value()
class SlippingComb {
 public:
  /// @param index    of the signature in the kinematics
  /// @param reach    relative: how far the lines may be off their orders; >= 0
  /// @param highest  order of the highest harmonic that is added
  /// @param peaks    must outlive this
  SlippingComb(std::size_t index, const Signature& signature, double reach,
               const std::vector<Quantity>& quantities, double highest, const SpectralPeaks& peaks,
               const std::vector<Peak>& of_others);

  std::size_t signature() const { return signature_; }
  double p_value() const { return p_value_; }
  /// The quantities that are its lines, and where each stands.
  const std::vector<std::size_t>& quantities() const { return quantities_; }
  double place_of(std::size_t line) const { return orders_[line] * stretch_; }
  /// Whether what stands there is another part's.
  bool is_taken(std::size_t line) const { return is_taken_at(orders_[line]); }
  /// Those of its lines that stand out, if the part is found, and of their sidebands at the input
  /// shaft's speed, which loads every part unevenly.
  std::vector<Peak> found() const;
  /// Whether its lines, looked for alone, lie on more than half of these.
  bool shares(const std::vector<Peak>& peaks) const;
  /// Looks for the lines anew, in what these leave.
  void leave_out(const std::vector<Peak>& peaks);

 private:
  struct Best {
    double stretch, sum;
  };

  bool fits(double order) const { return peaks_->reaches(order * (1 + reach_)); }
  bool is_taken_at(double order) const;
  void add_harmonics(double highest);
  Best best_of(const std::vector<double>& orders) const;
  double sum_at(const std::vector<double>& orders, double stretch) const;
  std::vector<double> decoy(int number) const;

  std::size_t signature_;
  double order_;
  double reach_;  // relative
  const SpectralPeaks* peaks_;
  std::vector<bool> taken_;  // lines
  std::vector<std::size_t> quantities_;
  std::vector<double> orders_;  // of the quantities, then of further harmonics
  double stretch_ = 1, alone_ = 1, p_value_ = 1;
};

}  // namespace rvbench::analysis
