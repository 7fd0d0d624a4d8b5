#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sim/iio_server.hpp"
#include "sim/scan_ring.hpp"

namespace rvbench::sim {

/// What one client of an IioServer has asked for, and the answers. Text in, bytes out: it knows no
/// sockets.
class IioSession {
 public:
  IioSession(const IioFrontEnd& front_end, ScanRing& ring) : front_end_(front_end), ring_(ring) {}

  /// The answer to one line; nothing if the client says good-bye.
  std::optional<std::string> answer(const std::string& line);

  /// Bytes that follow a WRITE command; they come before the next line.
  std::size_t awaited_bytes() const { return awaited_bytes_; }
  std::string answer_to_bytes();  ///< once they have come

 private:
  std::string open(std::string_view scans, std::string_view mask);
  std::string read_scans(std::string_view bytes);
  std::string read_attribute(std::string_view words) const;

  const IioFrontEnd& front_end_;
  ScanRing& ring_;
  std::string mask_;  ///< as the client wrote it
  std::uint64_t enabled_ = 0;
  std::int64_t next_ = -1;  ///< scan to be read; -1: not open
  std::size_t awaited_bytes_ = 0;
};

}  // namespace rvbench::sim
