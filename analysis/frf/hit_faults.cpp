#include "analysis/frf/hit_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/fft.hpp"
#include "analysis/quality/clipping.hpp"
#include "analysis/smallest_step.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

namespace {

constexpr Eigen::Index shortest_flat_top = 3;
constexpr double surely_no_noise = 1e-6;  // p-value

std::string place_of(const FrfChannel& channel) {
  return channel.place.point + channel.place.direction;
}

// Samples that stay at the largest magnitude, where the signal was cut off there.
Eigen::Index cut_off_samples(const Eigen::VectorXd& x) {
  const double top = x.cwiseAbs().maxCoeff();
  const double cut = steps_of_crest * smallest_step(x);
  const auto falls_steeply = [&](Eigen::Index i) {
    return i >= 0 && i < x.size() && top - std::abs(x[i]) > cut;
  };
  Eigen::Index count = 0, run = 0;
  for (Eigen::Index i = 0; i <= x.size(); ++i) {
    if (i < x.size() && std::abs(x[i]) >= top * (1 - 1e-12)) {
      ++run;
      continue;
    }
    if (run >= shortest_flat_top && (falls_steeply(i) || falls_steeply(i - run - 1))) count += run;
    run = 0;
  }
  return count;
}

Eigen::Index clipped_samples(const Eigen::VectorXd& x, double range) {
  if (std::isfinite(range)) return (x.array().abs() >= 0.999 * range).count();
  return cut_off_samples(x);
}

class Judge {
 public:
  Judge(const FrfRecord& record, const FrfSetup& setup, const HitLimits& limits,
        const HitWindows& windows)
      : record_(record), setup_(setup), limits_(limits), windows_(windows) {}

  JudgedHit judge() {
    hit_.source = record_.source;
    if (!record_.excitations.allFinite() || !record_.responses.allFinite()) {
      const auto lost = double(record_.excitations.size() + record_.responses.size() -
                               record_.excitations.array().isFinite().count() -
                               record_.responses.array().isFinite().count());
      add(HitFaultKind::not_finite, lost, 0, fmt::format("{} samples are not finite", lost));
      return hit_;
    }
    hit_.pulse = force_pulse(record_.excitations.col(0));
    judge_strength();
    if (hit_.pulse.height == 0) return hit_;
    judge_second_pulse();
    judge_clipping();
    const FrfRecord windowed = windowed_hit(record_, windows_);
    if (std::isfinite(limits_.to_Hz)) judge_spectrum(windowed);
    judge_decay(windowed);
    return hit_;
  }

 private:
  void add(HitFaultKind kind, double value, double limit, const std::string& what) {
    hit_.faults.push_back({kind, value, limit, fmt::format("{}: {}", to_string(kind), what)});
  }

  void judge_strength() {
    const std::string& unit = setup_.excitations.front().unit;
    const double height = std::abs(hit_.pulse.height);
    if (height < limits_.least_peak) {
      add(HitFaultKind::weak, height, limits_.least_peak,
          fmt::format("peak of {:.3g} {}, at least {:.3g} wanted", height, unit,
                      limits_.least_peak));
    }
    const double least = limits_.least_peak_over_noise * hit_.pulse.noise;
    if (height < least || height == 0) {
      add(HitFaultKind::weak, height, least,
          fmt::format("peak of {:.3g} {} over a noise of {:.3g}, {:.3g} times wanted", height, unit,
                      hit_.pulse.noise, limits_.least_peak_over_noise));
    }
  }

  void judge_second_pulse() {
    const ForcePulse& pulse = hit_.pulse;
    const double limit = std::max(limits_.second_pulse_share, pulse.least_share_seen());
    if (pulse.second_share() <= limit) return;
    add(HitFaultKind::double_hit, pulse.second_share(), limit,
        fmt::format("a pulse of {:.1f} % {:.3g} ms {} the first, up to {:.1f} % allowed",
                    100 * pulse.second_share(),
                    1e3 * double(std::abs(pulse.second - pulse.peak)) / record_.rate_Hz,
                    pulse.second > pulse.peak ? "after" : "before", 100 * limit));
  }

  void judge_clipping() {
    const FrfChannel& hammer = setup_.excitations.front();
    const Eigen::Index cut = clipped_samples(record_.excitations.col(0), hammer.range);
    if (cut > 0) {
      add(HitFaultKind::overload, double(cut), 0,
          fmt::format("{} samples of the force are clipped", cut));
    }
    for (std::size_t r = 0; r < setup_.responses.size(); ++r) {
      const FrfChannel& sensor = setup_.responses[r];
      const Eigen::Index count =
          clipped_samples(record_.responses.col(Eigen::Index(r)), sensor.range);
      if (count == 0) continue;
      add(HitFaultKind::response_clipped, double(count), 0,
          fmt::format("{} samples at {}", count, place_of(sensor)));
    }
  }

  void judge_spectrum(const FrfRecord& windowed) {
    const Eigen::VectorXd power = fft(windowed.excitations.col(0)).cwiseAbs2();
    const double step_Hz = record_.rate_Hz / double(windowed.excitations.rows());
    const auto from = Eigen::Index(std::ceil(limits_.from_Hz / step_Hz));
    const auto to = std::min(Eigen::Index(limits_.to_Hz / step_Hz), power.size() - 1);
    Require{"judge_hit"}(from <= to, "the band holds no line of the record");
    const double highest = power.head(to + 1).maxCoeff();
    const double least = highest * std::pow(10, -limits_.spectrum_drop_dB / 10);
    Eigen::Index reaches = from;
    while (reaches <= to && power[reaches] >= least) ++reaches;
    hit_.reaches_Hz = double(std::max(reaches - 1, Eigen::Index{0})) * step_Hz;
    if (reaches > to) return;
    const double drop_dB =
        10 * std::log10(highest / std::max(power.segment(from, to - from + 1).minCoeff(), 1e-300));
    add(HitFaultKind::narrow_spectrum, drop_dB, limits_.spectrum_drop_dB,
        fmt::format("the force falls by {:.0f} dB up to {:.4g} Hz, and by {:.0f} dB at {:.4g} Hz",
                    drop_dB, limits_.to_Hz, limits_.spectrum_drop_dB, double(reaches) * step_Hz));
  }

  void judge_decay(const FrfRecord& windowed) {
    const Eigen::Index n = windowed.responses.rows();
    const Eigen::Index end = std::max<Eigen::Index>(n / 20, 4);
    const Eigen::Index rest = hit_.pulse.samples_at_rest();
    const double at_end = exponential_window(n, record_.rate_Hz, windows_.decay_s)[n - end / 2];
    for (std::size_t r = 0; r < setup_.responses.size(); ++r) {
      const Eigen::VectorXd x = windowed.responses.col(Eigen::Index(r));
      double power = x.tail(end).squaredNorm() / double(end);
      if (rest > 0) {
        const Eigen::VectorXd before = record_.responses.col(Eigen::Index(r)).head(rest);
        const double noise = (before.array() - before.mean()).square().mean() * at_end * at_end;
        const double p =
            line_p_value(double(end) / 2 * power / noise, double(end) / 2, double(rest - 1) / 2);
        power = p < surely_no_noise ? power - noise : 0;
      }
      const double share = std::sqrt(power) / x.cwiseAbs().maxCoeff();
      if (!(share > limits_.undecayed_share)) continue;
      add(HitFaultKind::not_decayed, share, limits_.undecayed_share,
          fmt::format("{} is at {:.1f} % of its peak at the end, {:.1f} % allowed",
                      place_of(setup_.responses[r]), 100 * share, 100 * limits_.undecayed_share));
    }
  }

  const FrfRecord& record_;
  const FrfSetup& setup_;
  const HitLimits& limits_;
  const HitWindows& windows_;
  JudgedHit hit_;
};

}  // namespace

const char* to_string(HitFaultKind kind) noexcept {
  switch (kind) {
    case HitFaultKind::not_finite: return "not finite";
    case HitFaultKind::weak: return "weak hit";
    case HitFaultKind::double_hit: return "double hit";
    case HitFaultKind::overload: return "overload";
    case HitFaultKind::narrow_spectrum: return "narrow spectrum";
    case HitFaultKind::response_clipped: return "response clipped";
    case HitFaultKind::not_decayed: return "not decayed";
    case HitFaultKind::unequal: return "unequal";
    case HitFaultKind::unlike_others: return "unlike others";
  }
  return "unknown";
}

JudgedHit judge_hit(const FrfRecord& record, const FrfSetup& setup, const HitLimits& limits,
                    const HitWindows& windows) {
  require_record(record, setup, "judge_hit");
  Require{"judge_hit"}(setup.excitations.size() == 1, "a hit has one excitation");
  return Judge(record, setup, limits, windows).judge();
}

}  // namespace rvbench::analysis
