#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/bus_monitor.hpp"
#include "hal/rig.hpp"
#include "sequences/scribe.hpp"

namespace rvbench::sequences {

/// Tells whether the buses of a rig were in order over a record: whether any counter of what goes
/// wrong has moved between begin() and end(). Counters that cannot be read are not in order.
///
/// Time  no call waits for a bus, which may take 0.3 s to answer: whoever reads the counters must
///       not let the values that he watches grow old meanwhile. In real time a thread of its own
///       reads them, and is_ready() tells when it has; in virtual time begin() and end() do
class BusWatch {
 public:
  explicit BusWatch(hal::Rig& rig);
  ~BusWatch();  ///< as finish()
  BusWatch(const BusWatch&) = delete;
  BusWatch& operator=(const BusWatch&) = delete;

  void begin();
  void end();
  /// The record begins now. A begin() that has not been read by now would not tell of what went
  /// wrong meanwhile: it counts as never read.
  void open_record();
  bool is_ready() const;  ///< what was begun, or ended, last has been read

  /// Waits a moment for what is being read.
  /// @return false if a bus hangs: its reader goes on for ever, and the rig must outlive it
  bool finish() noexcept;

  /// "can0: bus_error +3, rx_dropped +1; can1: ..."; empty if all was in order. What has not been
  /// read by now is not.
  std::string verdict() const;

 private:
  using Look = std::vector<Result<hal::BusCounters>>;
  struct Looks;

  void look(std::optional<Look> Looks::*into);
  int record_now() const;

  hal::Rig& rig_;
  const std::shared_ptr<Looks> looks_;  // also the reader's, who may come too late
  std::unique_ptr<Scribe> reader_;      // none in virtual time
  bool has_hung_ = false;
};

}  // namespace rvbench::sequences
