#include "hal/daq/sample_clock.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/recording.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::hal {
namespace {

constexpr std::size_t most_seconds = 60;
constexpr std::size_t seconds_for_a_rate = 5;
constexpr std::size_t seconds_for_a_scatter = 3;
constexpr double worst_quartz = 1e-3;  // a device farther off its rate is broken, or loses samples
constexpr double least_hole_s = 0.005;

}  // namespace

SampleClock::SampleClock(double nominal_rate_Hz)
    : nominal_rate_Hz_(nominal_rate_Hz), period_s_(1 / nominal_rate_Hz), uncertainty_s_(not_known) {
  require_positive(nominal_rate_Hz, "SampleClock", "nominal_rate_Hz");
}

void SampleClock::add(std::int64_t samples, double arrival_s) {
  const Block block{double(samples - 1), arrival_s};  // the newest sample arrives last
  if (!has_block_) {
    has_block_ = true;
    start_s_ = arrival_s - block.sample * period_s_;
    punctual_ = block;
    second_ends_s_ = arrival_s + 1;
    return;
  }
  if (lateness_s(block) < lateness_s(punctual_)) punctual_ = block;
  // Nothing is taken before it has arrived.
  if (seconds_.size() < seconds_for_a_rate) start_s_ += std::min(0.0, lateness_s(block));
  if (arrival_s < second_ends_s_) return;
  close_second();
  punctual_ = block;
  second_ends_s_ = arrival_s + 1;
}

double SampleClock::lateness_s(const Block& block) const {
  return block.arrival_s - (start_s_ + block.sample * period_s_);
}

// A second that is late as a whole lacks samples: no block of it came when it should have.
void SampleClock::close_second() {
  const double late_s = lateness_s(punctual_);
  const double scatter_s = std::isfinite(uncertainty_s_) ? uncertainty_s_ : 0;
  if (seconds_.size() >= seconds_for_a_scatter && late_s > least_hole_s + 5 * scatter_s) {
    missing_s_ = late_s;
    return;
  }
  missing_s_ = 0;
  seconds_.push_back(punctual_);
  if (seconds_.size() > most_seconds) seconds_.pop_front();
  fit();
}

void SampleClock::fit() {
  const Block& origin = seconds_.front();
  double mean_n = 0, mean_s = 0;
  for (const Block& block : seconds_) {
    mean_n += (block.sample - origin.sample) / double(seconds_.size());
    mean_s += (block.arrival_s - origin.arrival_s) / double(seconds_.size());
  }
  double nn = 0, ns = 0;
  for (const Block& block : seconds_) {
    const double n = block.sample - origin.sample - mean_n;
    nn += n * n;
    ns += n * (block.arrival_s - origin.arrival_s - mean_s);
  }
  if (seconds_.size() >= seconds_for_a_rate && nn > 0) {
    period_s_ = std::clamp(ns / nn, (1 - worst_quartz) / nominal_rate_Hz_,
                           (1 + worst_quartz) / nominal_rate_Hz_);
  }
  // On the line of the most punctual blocks, and not through their middle.
  start_s_ = origin.arrival_s + mean_s - (origin.sample + mean_n) * period_s_;
  double earliest_s = 0, squares = 0;
  for (const Block& block : seconds_) {
    earliest_s = std::min(earliest_s, lateness_s(block));
    squares += lateness_s(block) * lateness_s(block);
  }
  if (seconds_.size() >= seconds_for_a_scatter) {
    uncertainty_s_ = std::sqrt(squares / double(seconds_.size() - 1));
  }
  start_s_ += earliest_s;
}

double SampleClock::time_s(std::int64_t sample) const {
  return start_s_ + double(sample) * period_s_;
}

double SampleClock::rate_Hz() const { return 1 / period_s_; }

double SampleClock::uncertainty_s() const { return uncertainty_s_; }

}  // namespace rvbench::hal
