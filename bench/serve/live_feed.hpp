#pragma once

#include <Eigen/Core>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "bench/serve/live_socket.hpp"
#include "hal/accelerometers.hpp"
#include "hal/torque_sensor.hpp"

namespace rvbench::bench {

/// How a run goes, told to whoever watches it: letters of JSON to a LiveSocket.
///
///     {"kind":"state","run":"A17/2026...","stage":"measure","text":"...","done":0.4,
///      "left_s":12.5,"points":"ddmoo"}                       open, measuring, done, failed
///     {"kind":"strip","t_s":..,"torque_Nm":..,"speed_rpm":..,"temperature_C":..,"vibration_g":..}
///     {"kind":"spectrum","channel":"accel_1x","step_Hz":..,"levels_dB":[...]}     dB re 1 g
///
/// About five strips and one spectrum a second, in real time, whatever the rig's. The strip holds
/// means since the one before, of the vibration the rms without its mean of the channel that shows
/// most; null where nothing came. For people to look at: nothing is judged by it.
///
/// Threads  all calls may come from any thread, also one of real time: they never wait. Values that
///          come while others are taken over are left out. Sending has a thread of its own
class LiveFeed {
 public:
  static constexpr int spectrum_samples = 1024;

  /// @param run     below the folder of runs: "A17/20261126T101112Z"
  /// @param points  of the plan
  LiveFeed(LiveSocket socket, std::string run, std::size_t points);
  ~LiveFeed();  ///< tells the last state
  LiveFeed(const LiveFeed&) = delete;
  LiveFeed& operator=(const LiveFeed&) = delete;

  void progress(const std::string& stage, double fraction, double left_s, const std::string& text);
  void begin_point(int point);
  void end_point(int point, bool is_good);
  void take(const hal::TorqueBlock& block, double rate_Hz);
  void take(const hal::AccelerationBlock& block, double rate_Hz, const std::string& first_channel);
  void take_temperature(double degC);

 private:
  struct Values {  // since the last strip
    double torque_sum_Nm = 0, first_rad = not_known, last_rad = not_known, first_s = 0, last_s = 0;
    int torques = 0;
    Eigen::VectorXd sums_m_s2, squares;
    int scans = 0;
    double temperature_degC = not_known;
    double newest_s = not_known;  // on the rig's clock

    void clear();  // keeps the memory of sums and squares
  };
  void run(const std::stop_token& stop);
  void send_state();
  void send_strip(const Values& values);
  void send_spectrum(const Eigen::VectorXd& samples, double rate_Hz, const std::string& channel);
  void tell_point(int point, char status);

  LiveSocket socket_;
  const std::string run_;

  std::mutex state_mutex_;
  std::string stage_ = "start", text_, points_;
  double done_ = 0, left_s_ = not_known;

  std::mutex values_mutex_;  // of the rest; never waited for by who measures
  Values values_;
  std::vector<double> latest_;  // of the first channel, at most spectrum_samples
  double rate_Hz_ = 0;
  double heard_until_s_ = not_known;  // of the accelerations
  std::string channel_;

  std::condition_variable_any ending_;
  std::jthread thread_;
};

}  // namespace rvbench::bench
