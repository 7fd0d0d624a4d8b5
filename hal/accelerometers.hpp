#pragma once

#include <Eigen/Core>
#include <vector>

#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

/// Scans in a row, without gaps: lost ones are there as NaN.
struct AccelerationBlock {
  using Scans = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  double t0_s = 0;                        ///< time of the first scan on the rig's clock
  Scans scans;                            ///< n x channels, m/s²
  int lost = 0;                           ///< scans that are NaN
  double time_uncertainty_s = not_known;  ///< of t0_s
};

/// All accelerometers of the bench, sampled by one clock.
///
/// Order    connect() → start() → read()* → stop()
/// Time     read() returns what has come since the last call, if only an empty block, and does not
///          wait for more: interlocks are not looked at meanwhile. It is an error if nothing new
///          came within the deadline given at construction
class Accelerometers {
 public:
  virtual ~Accelerometers() = default;
  virtual const std::vector<ChannelInfo>& channels() const = 0;  ///< unit "m/s²"
  virtual double range_m_s2() const = 0;  ///< full scale: samples there are clipped
  virtual double rate_Hz() const = 0;     ///< the rate the device really runs at
  /// How long after it a hole in the stream is told at the latest, by read(): 0 where the device
  /// tells each scan that it lost. A record is whole once later scans than that have come.
  virtual double hole_told_after_s() const { return 0; }
  virtual Status connect() = 0;
  virtual Status start() = 0;
  virtual Result<AccelerationBlock> read() = 0;
  virtual void stop() noexcept = 0;
};

}  // namespace rvbench::hal
