#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "analysis/emd/end_rule.hpp"

namespace rvbench::analysis {

/// The extrema as seen from one end of the signal: `out` grows towards it and beyond, so that a
/// rule says the same of either end.
///
/// Units, errors  of EndRule. Source  ours: no rule is written twice
class OutwardExtrema {
 public:
  struct Extremum {
    double out = 0;  ///< in samples
    double value = 0;
  };

  static OutwardExtrema of_start(double first_sample, Knots& extrema) {
    return {extrema, true, extrema.size(), {0, first_sample}};
  }
  static OutwardExtrema of_end(double last_sample, Eigen::Index last, std::size_t count,
                               Knots& extrema) {
    return {extrema, false, count, {static_cast<double>(last), last_sample}};
  }

  Extremum end() const { return end_; }         ///< the end sample
  std::size_t count() const { return count_; }  ///< of all extrema of the signal
  Extremum nth(std::size_t i) const {           ///< 0 is the outermost one
    return at_start_ ? Extremum{-knots_->at[outermost_ + i], knots_->value[outermost_ + i]}
                     : Extremum{knots_->at[outermost_ - i], knots_->value[outermost_ - i]};
  }
  /// One more, further out than all others. nth() counts from where it did.
  void lay(Extremum extremum) {
    if (at_start_) {
      knots_->push_front(-extremum.out, extremum.value);
    } else {
      knots_->push_back(extremum.out, extremum.value);
    }
  }

 private:
  OutwardExtrema(Knots& knots, bool at_start, std::size_t count, Extremum end)
      : knots_(&knots),
        at_start_(at_start),
        count_(count),
        outermost_(at_start ? knots.first : knots.end - 1),
        end_(end) {}

  Knots* knots_;
  bool at_start_;
  std::size_t count_;
  std::size_t outermost_;
  Extremum end_;
};

/// A rule that lays the same past either end.
template <void (*lay_past)(OutwardExtrema)>
constexpr EndRule end_rule(const char* name) {
  return {name,
          [](double first_sample, Knots& extrema) {
            lay_past(OutwardExtrema::of_start(first_sample, extrema));
          },
          [](double last_sample, Eigen::Index last, std::size_t count, Knots& extrema) {
            lay_past(OutwardExtrema::of_end(last_sample, last, count, extrema));
          }};
}

}  // namespace rvbench::analysis
