#pragma once

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

namespace rvbench::test {

/// One line of what the program prints.
struct Figure {
  std::string what;
  double value = 0;
  std::string unit = "";
  double limit = 0;  ///< 0: printed without one
  /// Of a short run, on a machine that others use, which may grant no real-time priority, under a
  /// sanitizer perhaps: delays may be a time slice or two of the others longer, 10 ms each, and
  /// work may cost several times as much. A wait too many is far beyond it.
  double short_limit = 0;
};

/// @pre values is not empty
inline double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

/// Keeps one core busy while it lives.
class Load {
 public:
  Load()
      : thread_([](const std::stop_token& stop) {
          volatile double sum = 0;
          while (!stop.stop_requested()) sum = sum + 1;
        }) {}

 private:
  std::jthread thread_;
};

/// From the sample beyond an interlock until the command to stop is on the wire.
std::vector<Figure> measure_trips(int trips);
/// From a pulled cable until the run is ended, and until the drive's own watchdog has let the shaft
/// go.
std::vector<Figure> measure_link_loss(int losses);
/// From standstill, or from teardown's time-out, until no torque is commanded at the brake.
std::vector<Figure> measure_release(int runs);
/// Of the supervisor's rounds.
std::vector<Figure> measure_lateness(double duration_s);
/// Of the inverter driver, against bare libmodbus on the same loopback.
std::vector<Figure> measure_polling(int readings);
/// Of 24 channels at 102.4 kHz, into a file.
std::vector<Figure> measure_recording(double duration_s);

}  // namespace rvbench::test
