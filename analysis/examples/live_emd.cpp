#include "analysis/emd/live_emd.hpp"

#include <vector>

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr int imfs = 5;
constexpr Eigen::Index count = 20000, block = 100;
constexpr double rate_Hz = 1000;

Eigen::VectorXd signal() {
  //! [page]
  const Eigen::ArrayXd t_s = times_s(20000, 1000);
  const Eigen::VectorXd x = noise(20000, 1) + 3 * wave(3 * t_s);
  //! [page]
  return x;
}

struct Watched {
  Eigen::MatrixXd behind_s;       // blocks by IMFs
  std::vector<double> first_imf;  // as it came
};

Watched watch(const Eigen::VectorXd& x) {
  Watched seen{Eigen::MatrixXd(count / block, imfs), {}};
  //! [page]
  LiveEmd live({.imfs = imfs});
  for (Eigen::Index at = 0; at < x.size(); at += block) {
    live.add(x.segment(at, block));
    const Eigen::VectorXd fresh = live.take(0);
    seen.first_imf.insert(seen.first_imf.end(), fresh.begin(), fresh.end());
    for (int k = 0; k < imfs; ++k) {
      seen.behind_s(at / block, k) = double(live.known() - live.done(k)) / rate_Hz;
    }
  }
  live.end();
  const Eigen::VectorXd rest = live.take(0);
  //! [page]
  seen.first_imf.insert(seen.first_imf.end(), rest.begin(), rest.end());
  return seen;
}

}  // namespace

Example live_emd_example() {
  const Eigen::VectorXd x = signal();
  //! [page]
  const Emd whole = emd(x, {.imfs = imfs});
  //! [page]
  const Watched seen = watch(x);
  const Eigen::Map<const Eigen::VectorXd> first(seen.first_imf.data(), count);
  const bool is_same = (first - whole.imfs.col(0)).cwiseAbs().maxCoeff() < 1e-12;
  Example page{"live_emd",
               "Live EMD",
               "Noise over a tone at 3 Hz, sampled at 1 kHz, comes in blocks of 0.1 s. A sample of "
               "an IMF comes out when nothing that is yet to come can change it: a time behind "
               "that grows with the period of the IMF, and not with the length of the record. It "
               "is then what the whole record would have given.",
               {"emd/live_emd.hpp"},
               {{"IMF 1 as it came, against that of the whole record", "the same",
                 is_same ? "the same" : "different"}},
               {}};
  Panel behind{"How far an IMF is behind", {"time [s]", 0, 20}, {"behind [s]", 0, 20}, {}};
  for (const int k : {0, 2, 3}) {
    behind.traces.push_back({"IMF " + std::to_string(k + 1), 0.1, 0.1, seen.behind_s.col(k)});
  }
  for (int k = 0; k < 4; ++k) {
    page.figures.push_back({"IMF " + std::to_string(k + 1) + " behind after 20 s [s]", "–",
                            rounded(seen.behind_s(count / block - 1, k), 1)});
  }
  page.plots = {Panel{"IMF 1 as it came",
                      {"time [s]", 10, 10.5},
                      {"m/s²", -6.5, 6.5},
                      {{"signal", 0, 1 / rate_Hz, x}, {"IMF 1", 0, 1 / rate_Hz, first}}},
                behind};
  return page;
}

}  // namespace rvbench::analysis::examples
