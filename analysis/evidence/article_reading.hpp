#pragma once

#include <vector>

#include "analysis/envelope_spectra.hpp"
#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// The article shows the envelopes of so many IMFs.
inline constexpr int article_imfs = 5;

/// The article's own reading: how far the line at each part's order stands above noise in the
/// Hilbert envelope spectra of the first IMFs.
class ArticleReading {
 public:
  explicit ArticleReading(const Kinematics& kinematics);

  /// @param imf  1-based; beyond article_imfs it is not read
  void add(const EnvelopeSpectra& envelope, int imf);

  /// Σ over the IMFs of −ln p of the line, less what noise has
  double statistic(std::size_t signature) const { return parts_[signature].sum; }

  /// The line of the IMF that shows the part most: −ln p of it, where it is, and how deep it swings
  /// the envelope.
  struct Line {
    double log_ratio = 0;
    double order = 0;
    double depth = 0;
  };
  const Line& line(std::size_t signature) const { return parts_[signature].line; }
  int envelopes() const { return envelopes_; }  ///< that were read

  /// The IMF that shows the part most; 0 if none does.
  int imf(std::size_t signature) const { return parts_[signature].imf; }

 private:
  struct Part {
    double order = 0;
    double slip = 0;
    double sum = 0;
    Line line = {};
    int imf = 0;
  };
  std::vector<Part> parts_;
  int envelopes_ = 0;
};

}  // namespace rvbench::analysis
