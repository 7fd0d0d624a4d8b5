#include "hal/daq/scan_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rvbench::hal {

ScanStream::ScanStream(double rate_Hz, Eigen::Index most_scans)
    : most_scans_(most_scans), clock_(rate_Hz) {}

void ScanStream::push(AccelerationBlock::Scans scans, double arrival_s) {
  if (scans.rows() == 0) return;
  const std::lock_guard lock(mutex_);
  if (failure_) return;
  if (waiting_scans_ + scans.rows() > most_scans_) {
    failure_ = IoError{IoErrc::overrun, "nobody took the scans in time"};
    return;
  }
  pushed_ += scans.rows();
  waiting_scans_ += scans.rows();
  waiting_.push_back(std::move(scans));
  clock_.add(pushed_, arrival_s);
  if (clock_.missing_s() > 0) {
    failure_ =
        IoError{IoErrc::overrun, fmt::format("{:.0f} ms of samples are missing, or its clock "
                                             "is off by more than 0.1 %",
                                             1e3 * clock_.missing_s())};
  }
}

void ScanStream::fail(const IoError& error) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = error;
}

Result<ScanStream::Taken> ScanStream::take() {
  std::deque<AccelerationBlock::Scans> blocks;
  Taken taken;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty() && failure_) return *failure_;
    blocks.swap(waiting_);
    if (waiting_scans_ > 0) taken.t0_s = slewed_t0_s(waiting_scans_);
    taken_ += std::exchange(waiting_scans_, 0);
  }
  Eigen::Index scans = 0;
  for (const auto& block : blocks) scans += block.rows();
  if (blocks.size() == 1) taken.scans = std::move(blocks.front());
  if (blocks.size() < 2) return taken;
  taken.scans.resize(scans, blocks.front().cols());
  Eigen::Index from = 0;
  for (const auto& block : blocks) {
    taken.scans.middleRows(from, block.rows()) = block;
    from += block.rows();
  }
  return taken;
}

// As the estimate of the clock improves, time stamps follow it by half a sample per block: blocks
// stay in one row, without gap or overlap.
double ScanStream::slewed_t0_s(Eigen::Index scans) {
  const double period_s = 1 / clock_.rate_Hz();
  const double estimated_s = clock_.time_s(taken_);
  const double t0_s = std::isnan(next_t0_s_) ? estimated_s
                                             : next_t0_s_ + std::clamp(estimated_s - next_t0_s_,
                                                                       -period_s / 2, period_s / 2);
  next_t0_s_ = t0_s + double(scans) * period_s;
  return t0_s;
}

double ScanStream::uncertainty_s() const {
  const std::lock_guard lock(mutex_);
  return clock_.uncertainty_s();
}

}  // namespace rvbench::hal
