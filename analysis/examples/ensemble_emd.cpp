#include "analysis/emd/ensemble_emd.hpp"

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double rate_Hz = 1000;

// The IMF that is most like a signal.
Eigen::Index most_like(const Emd& modes, const Eigen::VectorXd& signal) {
  Eigen::Index best = 0;
  for (Eigen::Index k = 1; k < modes.imfs.cols(); ++k) {
    if (correlation(modes.imfs.col(k), signal) > correlation(modes.imfs.col(best), signal))
      best = k;
  }
  return best;
}

std::string likeness(const Emd& modes, const Eigen::VectorXd& signal) {
  return rounded(correlation(modes.imfs.col(most_like(modes, signal)), signal), 2);
}

Panel beside(const std::string& title, const Emd& modes, const Eigen::VectorXd& slow) {
  return {title,
          {"time [s]", 0.25, 0.8},
          {"m/s²", -1.5, 1.5},
          {{"slow tone", 0, 1 / rate_Hz, slow},
           {"IMF most like it", 0, 1 / rate_Hz, modes.imfs.col(most_like(modes, slow))}}};
}

Panel of_signal(const Eigen::VectorXd& x) {
  return {"The signal", {"time [s]", 0.25, 0.8}, {"m/s²", -1.5, 1.5}, {{"", 0, 1 / rate_Hz, x}}};
}

}  // namespace

Example ensemble_emd_example() {
  //! [page]
  const Eigen::ArrayXd t_s = times_s(2000, 1000);
  const Eigen::VectorXd slow = wave(8 * t_s);
  Eigen::VectorXd bursts = 0.3 * wave(120 * t_s);
  for (const auto& [from, size] : {std::pair{0, 400}, {700, 600}, {1600, 400}}) {
    bursts.segment(from, size).setZero();
  }
  const Eigen::VectorXd x = slow + bursts;

  const EnsembleOptions options{.emd = {.imfs = 6}, .members = 50, .noise = 0.2, .seed = 1};
  const Emd plain = emd(x, options.emd);
  const Emd mean = eemd(x, options);
  const Emd complete = ceemdan(x, options);
  const Emd improved = iceemdan(x, options);
  //! [page]
  Example page{"ensemble_emd",
               "Ensemble EMD: EEMD, CEEMDAN and the improved one",
               "A tone at 8 Hz sounds all the time, a weaker one at 120 Hz in bursts. Plain EMD "
               "takes what is fastest at the moment into its first IMF: the burst, and between "
               "bursts the slow tone, which so is torn in two (mode mixing). Noise that is added "
               "and averaged out keeps it whole, if not as high: some of it is in the IMFs beside.",
               {"emd/ensemble_emd.hpp"},
               {},
               {}};
  const auto add = [&](const std::string& name, const Emd& modes) {
    page.figures.push_back(
        {"correlation of the slow tone with its IMF, " + name, "1", likeness(modes, slow)});
    page.figures.push_back(
        {"correlation of the bursts with their IMF, " + name, "1", likeness(modes, bursts)});
  };
  add("EMD", plain);
  add("EEMD", mean);
  add("CEEMDAN", complete);
  add("improved CEEMDAN", improved);
  page.plots = {of_signal(x), beside("EMD", plain, slow), beside("EEMD", mean, slow),
                beside("Improved CEEMDAN", improved, slow)};
  return page;
}

}  // namespace rvbench::analysis::examples
