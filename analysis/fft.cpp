#include "analysis/fft.hpp"

#include <fftw3.h>

#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "hal/types/shared_cache.hpp"

namespace rvbench::analysis {
namespace {

using Planned = std::remove_pointer_t<fftw_plan>;
using Plan = std::shared_ptr<Planned>;

// Planning costs about as much as executing, so the plans of the last lengths are kept, for all
// threads: a plan may be executed by many at once.
class Plans {
 public:
  template <class Make>
  Plan find_or_make(Eigen::Index n, Make make) {
    if (n > std::numeric_limits<int>::max()) throw std::invalid_argument("fft: too many samples");
    static const bool planner_is_safe = (fftw_make_planner_thread_safe(), true);
    static_cast<void>(planner_is_safe);
    return plans_.find_or_make(n, [&](Eigen::Index length) {
      return Plan(make(static_cast<int>(length)), fftw_destroy_plan);
    });
  }

 private:
  // More than one judgement asks for: it would plan each length anew per channel.
  SharedCache<Eigen::Index, Planned> plans_{64};
};

fftw_complex* as_fftw(Eigen::VectorXcd& lines) {
  return reinterpret_cast<fftw_complex*>(lines.data());
}

Eigen::VectorXcd transformed(Plans& plans, Eigen::VectorXcd x, int sign) {
  if (x.size() == 0) return x;
  const Plan plan = plans.find_or_make(x.size(), [&](int n) {
    return fftw_plan_dft_1d(n, as_fftw(x), as_fftw(x), sign, FFTW_ESTIMATE);
  });
  fftw_execute_dft(plan.get(), as_fftw(x), as_fftw(x));
  return x;
}

bool is_fast(Eigen::Index length) {
  for (const Eigen::Index factor : {2, 3, 5}) {
    while (length % factor == 0) length /= factor;
  }
  return length == 1;
}

}  // namespace

Eigen::VectorXcd fft(const Eigen::Ref<const Eigen::VectorXd>& x) {
  // A copy, aligned as Eigen aligns all: a plan holds for one alignment, and rounds alike then.
  if (x.size() == 0) throw std::invalid_argument("fft: no samples");
  Eigen::VectorXd in = x;
  Eigen::VectorXcd lines(x.size() / 2 + 1);
  static Plans plans;
  const Plan plan = plans.find_or_make(x.size(), [&](int n) {
    return fftw_plan_dft_r2c_1d(n, in.data(), as_fftw(lines), FFTW_ESTIMATE);
  });
  fftw_execute_dft_r2c(plan.get(), in.data(), as_fftw(lines));
  return lines;
}

Eigen::VectorXd inverse_fft(Eigen::VectorXcd lines, Eigen::Index n) {
  if (n < 1 || lines.size() != n / 2 + 1) {
    throw std::invalid_argument("inverse_fft: " + std::to_string(lines.size()) +
                                " lines cannot make " + std::to_string(n) + " samples");
  }
  Eigen::VectorXd x(n);
  static Plans plans;
  const Plan plan = plans.find_or_make(n, [&](int size) {
    return fftw_plan_dft_c2r_1d(size, as_fftw(lines), x.data(), FFTW_ESTIMATE);
  });
  fftw_execute_dft_c2r(plan.get(), as_fftw(lines), x.data());
  return x / static_cast<double>(n);
}

Eigen::VectorXcd complex_fft(Eigen::VectorXcd x) {
  static Plans plans;
  return transformed(plans, std::move(x), FFTW_FORWARD);
}

Eigen::VectorXcd inverse_complex_fft(Eigen::VectorXcd lines) {
  static Plans plans;
  const auto n = static_cast<double>(lines.size());
  Eigen::VectorXcd x = transformed(plans, std::move(lines), FFTW_BACKWARD);
  x /= n;
  return x;
}

Eigen::Index next_fast_length(Eigen::Index n) {
  if (n < 1) throw std::invalid_argument("next_fast_length: n = " + std::to_string(n));
  while (!is_fast(n)) ++n;
  return n;
}

Eigen::Index fast_length_within(Eigen::Index n) {
  if (n < 1) return n;
  while (!is_fast(n)) --n;
  return n;
}

}  // namespace rvbench::analysis
