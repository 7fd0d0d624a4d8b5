#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "hal/can_transport.hpp"

/// Lines of the LAWICEL ASCII protocol <-> frames and answers. Pure functions of bytes.
///
/// A line ends with CR; BEL is a line of its own. What the adapter says:
///
///     tIIILDD..   a data frame, 11 bits; T, r and R: other frames (29 bits, remote). Four more
///                 digits are the adapter's time stamp
///     z, Z, CR    the frame is taken; CR alone also answers commands
///     BEL         the command is declined
///     Fhh         status flags, as of an SJA1000
///     sXrrrttt    the controller's state: a, w, p or b (bus-off), and its error counters
///     eNc..       N errors on the bus: o and O are overruns
///     V.., N..    version, serial number
///
/// Sources: LAWICEL, CAN232 and CANUSB manuals, "F" and "t"; Linux, drivers/net/can/slcan, of
/// which s and e are extensions.
namespace rvbench::hal::slcan_frames {

/// Status flags, as F tells them; bus_off is ours: the protocol has only s for it.
enum Flags : unsigned {
  receive_queue_full = 0x01,
  send_queue_full = 0x02,
  error_warning = 0x04,
  data_overrun = 0x08,
  error_passive = 0x20,
  arbitration_lost = 0x40,
  bus_error = 0x80,
  bus_off = 0x100
};

enum class LineKind {
  garbled,      ///< no line of the protocol
  frame,        ///< a data frame with 11-bit identifier
  other_frame,  ///< any other frame
  done,         ///< CR alone
  sent,         ///< z or Z
  declined,     ///< BEL
  flags,        ///< answer to F
  remark,       ///< s or e: flags that nobody asked for
  version       ///< V or N
};

struct Line {
  LineKind kind = LineKind::garbled;
  CanFrame frame = {};
  unsigned flags = 0;
};

/// What a line without its CR says.
Line line_from(std::string_view text);

/// Cuts lines out of bytes that come in pieces.
class LineReader {
 public:
  void add(std::string_view bytes);

  /// The next whole line. One that grows longer than any of the protocol is garbled to its end.
  std::optional<Line> next();
  void clear();

 private:
  std::string bytes_;
  std::size_t from_ = 0;  ///< before it all is cut
  bool is_overlong_ = false;
};

/// "t1232AABB" and CR.
/// @throws std::invalid_argument if the identifier has more than 11 bits, or more than 8 bytes
std::string command_from(const CanFrame& frame);

/// "S5" and CR; nothing if no S command sets this bit rate.
std::optional<std::string> command_from_bitrate(int bitrate_kbit_s);

}  // namespace rvbench::hal::slcan_frames
