#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/emd/emd.hpp"
#include "analysis/emd/sift_chain.hpp"

namespace rvbench::analysis {

/// EMD of a signal that is still coming: IMFs to be watched while a bench runs.
///
/// A sample of an IMF comes out when nothing that is yet to come can change it: with a fixed count
/// of sifts that is the case 60 to 80 of the IMF's extrema later for each sift, beside what the
/// IMFs before wait for: ten sifts and an extremum in 5 ms are 3 to 4 s. It is then
/// the same as emd() makes of the whole record, to rounding; what emd() marks as unreliable at the
/// record's start is so here, and only end() makes an unreliable end.
///
/// Shape    any number of samples at a time; how they are parted changes no bit
/// Units    those of the samples
/// Memory   of the samples that are not final yet
/// Threads  one caller at a time
/// Errors   throws std::invalid_argument: options not positive, or with a stopping rule; sample not
///          finite, of which nothing is taken up; std::out_of_range: no such IMF
/// Source   ours; block by block, but for another record: Rilling, Flandrin & Gonçalvès, NSIP-03
///          (2003)
class LiveEmd {
 public:
  explicit LiveEmd(const EmdOptions& options = {});

  void add(const Eigen::Ref<const Eigen::VectorXd>& samples);
  /// No more will come: what is left is decomposed as the end of a record.
  void end();

  /// Samples of that IMF, 0 the fastest, that have become final and have not been taken yet; those
  /// of the residue for `options.imfs`. An IMF that the signal does not have comes with none, ever.
  Eigen::VectorXd take(int imf);

  Eigen::Index known() const { return known_; }  ///< samples so far
  Eigen::Index done(int imf) const;              ///< of which so many are final

 private:
  struct Stage {
    explicit Stage(const EmdOptions& options) : chain(options.sifts, options.rule) {}
    SiftChain chain;
    std::vector<double> input;  ///< what the IMFs before have left
    std::vector<double> h;      ///< the same, being sifted
    std::vector<double> out;    ///< final, not taken yet
    Eigen::Index sifted = 0;    ///< of `h` that are final
    Eigen::Index done = 0;
  };

  void pass_on(const double* samples, Eigen::Index count, std::size_t stage, bool is_end);
  void give_to_residue(const double* samples, Eigen::Index count);

  std::vector<Stage> stages_;
  std::vector<double> residue_;
  Eigen::Index residue_done_ = 0;
  Eigen::Index known_ = 0;
  double offset_ = 0;  ///< of the first sample: it would cost the modes digits
};

}  // namespace rvbench::analysis
