#include "bench/serve/live_feed.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "analysis/spectrum.hpp"
#include "bench/json_text.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

constexpr std::chrono::milliseconds strip_every{200};
constexpr int strips_per_spectrum = 5;
constexpr double quietest_g = 1e-6;  // -120 dB: below what any of these sensors tells from nothing

}  // namespace

LiveFeed::LiveFeed(LiveSocket socket, std::string run, std::size_t points)
    : socket_(std::move(socket)), run_(std::move(run)), points_(points, 'o') {
  latest_.reserve(spectrum_samples);  // no memory is asked for while samples come
  thread_ = std::jthread([this](const std::stop_token& stop) { this->run(stop); });
}

LiveFeed::~LiveFeed() {
  thread_.request_stop();
  ending_.notify_all();
  thread_.join();
  send_state();
}

void LiveFeed::progress(const std::string& stage, double fraction, double left_s,
                        const std::string& text) {
  const std::lock_guard lock(state_mutex_);
  stage_ = stage;
  done_ = fraction;
  left_s_ = left_s;
  text_ = text;
}

void LiveFeed::begin_point(int point) { tell_point(point, 'm'); }
void LiveFeed::end_point(int point, bool is_good) { tell_point(point, is_good ? 'd' : 'f'); }

void LiveFeed::tell_point(int point, char status) {
  const std::lock_guard lock(state_mutex_);
  if (point >= 0 && point < static_cast<int>(points_.size())) {
    points_[static_cast<std::size_t>(point)] = status;
  }
}

void LiveFeed::take(const hal::TorqueBlock& block, double rate_Hz) {
  const std::unique_lock lock(values_mutex_, std::try_to_lock);
  if (!lock) return;
  for (std::size_t i = 0; i < block.samples.size(); ++i) {
    const hal::TorqueSample& sample = block.samples[i];
    if (!std::isfinite(sample.torque_Nm) || !std::isfinite(sample.angle_rad)) continue;
    const double time_s = block.t0_s + double(i) / rate_Hz;
    if (values_.torques == 0) {
      values_.first_s = time_s;
      values_.first_rad = sample.angle_rad;
    }
    values_.last_s = time_s;
    values_.last_rad = sample.angle_rad;
    values_.torque_sum_Nm += sample.torque_Nm;
    ++values_.torques;
    values_.newest_s = time_s;
  }
}

void LiveFeed::take(const hal::AccelerationBlock& block, double rate_Hz,
                    const std::string& first_channel) {
  const std::unique_lock lock(values_mutex_, std::try_to_lock);
  if (!lock || block.scans.rows() == 0 || block.scans.cols() == 0) return;
  // Once for each of the two that are swapped.
  if (values_.sums_m_s2.size() != block.scans.cols()) {
    values_.sums_m_s2 = values_.squares = Eigen::VectorXd::Zero(block.scans.cols());
  }
  // A spectrum knows no holes: neither blocks that were not waited for nor lost samples. Time
  // stamps that follow the clock move by half a sample.
  if (!(std::abs(block.t0_s - heard_until_s_) < 0.75 / rate_Hz)) latest_.clear();
  heard_until_s_ = block.t0_s + double(block.scans.rows()) / rate_Hz;
  for (Eigen::Index row = 0; row < block.scans.rows(); ++row) {
    if (!block.scans.row(row).allFinite()) {
      latest_.clear();
      continue;
    }
    for (Eigen::Index channel = 0; channel < block.scans.cols(); ++channel) {
      const double value = block.scans(row, channel);
      values_.sums_m_s2[channel] += value;
      values_.squares[channel] += value * value;
    }
    ++values_.scans;
    if (latest_.size() < spectrum_samples) latest_.push_back(block.scans(row, 0));
  }
  rate_Hz_ = rate_Hz;
  if (channel_.empty()) channel_ = first_channel;
  values_.newest_s = heard_until_s_;
}

void LiveFeed::take_temperature(double degC) {
  const std::unique_lock lock(values_mutex_, std::try_to_lock);
  if (lock) values_.temperature_degC = degC;
}

void LiveFeed::Values::clear() {
  *this = {.sums_m_s2 = std::move(sums_m_s2), .squares = std::move(squares)};
  sums_m_s2.setZero();
  squares.setZero();
}

void LiveFeed::run(const std::stop_token& stop) {
  std::mutex mutex;
  Values values;
  for (int round = 1; !stop.stop_requested(); ++round) {
    {
      std::unique_lock lock(mutex);
      ending_.wait_for(lock, stop, strip_every, [] { return false; });
    }
    values.clear();
    std::vector<double> samples;
    double rate_Hz = 0;
    {
      const std::lock_guard lock(values_mutex_);
      const double temperature_degC = values_.temperature_degC;
      std::swap(values, values_);
      values_.temperature_degC = temperature_degC;  // told more seldom than strips are
      if (round % strips_per_spectrum == 0 && latest_.size() == spectrum_samples) {
        samples = latest_;
        latest_.clear();
      }
      rate_Hz = rate_Hz_;
    }
    send_state();
    if (values.torques > 0 || values.scans > 0) send_strip(values);
    if (!samples.empty()) {
      send_spectrum(Eigen::Map<const Eigen::VectorXd>(samples.data(), spectrum_samples), rate_Hz,
                    channel_);
    }
  }
}

void LiveFeed::send_state() {
  const std::lock_guard lock(state_mutex_);
  socket_.send(
      json_line(nlohmann::json({{"kind", "state"},
                                {"run", run_},
                                {"stage", stage_},
                                {"text", text_},
                                {"done", std::clamp(std::isfinite(done_) ? done_ : 0.0, 0.0, 1.0)},
                                {"left_s", left_s_},
                                {"points", points_}})));
}

void LiveFeed::send_strip(const Values& values) {
  double vibration_g = not_known;
  if (values.scans > 0) {
    const Eigen::VectorXd means = values.sums_m_s2 / values.scans;
    const double most = (values.squares / values.scans - means.cwiseAbs2()).maxCoeff();
    vibration_g = units::g_from_m_s2(std::sqrt(std::max(0.0, most)));
  }
  const double speed_rad_s =
      (values.last_rad - values.first_rad) / (values.last_s - values.first_s);
  socket_.send(json_line(nlohmann::json(
      {{"kind", "strip"},
       {"t_s", values.newest_s},
       {"torque_Nm", values.torques > 0 ? values.torque_sum_Nm / values.torques : not_known},
       {"speed_rpm", units::rpm_from_rad_s(speed_rad_s)},
       {"temperature_C", values.temperature_degC},
       {"vibration_g", vibration_g}})));
}

void LiveFeed::send_spectrum(const Eigen::VectorXd& samples, double rate_Hz,
                             const std::string& channel) {
  const auto spectrum = analysis::amplitude_spectrum(samples, rate_Hz, analysis::Window::hann);
  auto levels_dB = nlohmann::json::array();
  for (const double amplitude_m_s2 : spectrum.amplitude) {
    const double g = std::max(quietest_g, units::g_from_m_s2(amplitude_m_s2));
    levels_dB.push_back(std::round(200 * std::log10(g)) / 10);
  }
  socket_.send(json_line(nlohmann::json({{"kind", "spectrum"},
                                         {"channel", channel},
                                         {"step_Hz", spectrum.resolution},
                                         {"levels_dB", std::move(levels_dB)}})));
}

}  // namespace rvbench::bench
