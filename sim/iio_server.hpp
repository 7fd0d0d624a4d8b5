#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal/accelerometers.hpp"

namespace rvbench::sim {

/// What the simulated front end is, to those who ask over the network.
struct IioFrontEnd {
  std::string device = "rvbench-daq";
  std::vector<std::string> labels;  ///< one per input, as on the drawing: "accel_1x"
  double rate_Hz = 0;               ///< the only one that it has
  double m_s2_per_count = 1e-4;     ///< the `scale` of its inputs
  /// Of every input, beside these or in their place, as it is told: {"offset", "-32768"}. One
  /// without text cannot be read (EIO).
  std::map<std::string, std::string> attributes = {};
};

/// The DAQ of a simulated bench as a network context of Linux industrial I/O: any libiio client
/// reads it as "ip:127.0.0.1:<port>". Inputs are "accel0", "accel1", ..., 32 bits signed, which its
/// `scale` makes m/s².
///
/// Protocol  that of iiod, version 0.24, as far as clients that read need it
/// Time      push() never waits; a client that falls ten seconds behind is told EOVERFLOW
/// Threads   one pushes; clients are served in threads of their own
class IioServer {
 public:
  /// @param port  on 127.0.0.1; 0: the kernel chooses
  /// @throws std::invalid_argument if there is no input or the rate is not positive,
  ///         std::runtime_error if no socket can be had
  explicit IioServer(const IioFrontEnd& front_end, std::uint16_t port = 0);
  ~IioServer();
  IioServer(const IioServer&) = delete;
  IioServer& operator=(const IioServer&) = delete;

  std::uint16_t port() const;

  /// @param scans  n x inputs, m/s²; a lost one (NaN) is told as full scale
  void push(const hal::AccelerationBlock::Scans& scans);

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace rvbench::sim
