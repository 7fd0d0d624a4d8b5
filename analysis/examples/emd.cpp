#include "analysis/emd/emd.hpp"

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/hilbert.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double rate_Hz = 1000;
constexpr Eigen::Index count = 2000, end_samples = 100;

// The largest error within 0.1 s of either end, and the rms error of the middle half.
double error_at_ends(const Eigen::VectorXd& error) {
  return std::max(error.head(end_samples).cwiseAbs().maxCoeff(),
                  error.tail(end_samples).cwiseAbs().maxCoeff());
}
double error_in_middle(const Eigen::VectorXd& error) {
  return rms(error.segment(count / 4, count / 2));
}

Panel beside(const std::string& title, const Eigen::VectorXd& imf, const Eigen::VectorXd& tone) {
  return {title,
          {"time [s]", 0, 0.5},
          {"m/s²", -1.6, 1.6},
          {{"tone", 0, 1 / rate_Hz, tone}, {"IMF", 0, 1 / rate_Hz, imf}}};
}

std::vector<Plot> plots(const Emd& modes, const Eigen::VectorXd& fast,
                        const Eigen::VectorXd& slow) {
  const Panel signal{"The signal",
                     {"time [s]", 0, 0.5},
                     {"m/s²", -2.2, 2.2},
                     {{"signal", 0, 1 / rate_Hz, fast + slow}}};
  return {signal, beside("IMF 1", modes.imfs.col(0), fast),
          beside("IMF 2", modes.imfs.col(1), slow)};
}

}  // namespace

Example emd_example() {
  //! [page]
  const Eigen::ArrayXd t_s = times_s(2000, 1000);
  const Eigen::VectorXd fast = wave(40 * t_s + 0.2), slow = wave(7 * t_s);

  const Emd modes = emd(fast + slow);
  const double fast_Hz = crossing_frequency(modes.imfs.col(0), 1000);
  const double slow_Hz = crossing_frequency(modes.imfs.col(1), 1000);
  //! [page]
  Example page{
      "emd",
      "Empirical mode decomposition",
      "Two tones of amplitude 1, at 40 Hz and at 7 Hz, sampled at 1 kHz for 2 s. Each IMF must be "
      "one of the tones; the ends are where it may not be, and differ by the rule that draws the "
      "envelopes on past them. Rules that stop a sift by what they see come near to the fixed "
      "count of ten, but depend on the length of the record.",
      {"emd/emd.hpp", "emd/end_rule.hpp", "emd/stopping.hpp"},
      {{"frequency of IMF 1 [Hz]", "40", rounded(fast_Hz, 1)},
       {"frequency of IMF 2 [Hz]", "7", rounded(slow_Hz, 1)},
       {"error of IMF 1 in the middle, rms", "0",
        rounded(error_in_middle(modes.imfs.col(0) - fast), 4)}},
      plots(modes, fast, slow)};
  //! [page]
  for (const EndRule* rule : end_rules()) {
    const Emd by_rule = emd(fast + slow, {.rule = {.ends = rule}});
    const double off = error_at_ends(by_rule.imfs.col(0) - fast);
    page.figures.push_back(
        {std::string("largest error within 0.1 s of an end, ") + rule->name, "0", rounded(off, 3)});
  }
  for (const StoppingRule* rule : stopping_rules()) {
    const Emd stopped = emd(fast + slow, {.sifts = 100, .stopping = rule});
    const double off = error_in_middle(stopped.imfs.col(0) - fast);
    page.figures.push_back(
        {std::string("error in the middle, stopped by ") + rule->name, "0", rounded(off, 4)});
  }
  //! [page]
  return page;
}

}  // namespace rvbench::analysis::examples
