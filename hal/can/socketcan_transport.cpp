#include "hal/can/socketcan_transport.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace rvbench::hal {
namespace {

constexpr int longest_leaving_ms = 2;  // a frame takes 0.6 ms at 250 kbit/s, and may have to wait

IoErrc code_from_errno(int error) {
  switch (error) {
    case EAGAIN: return IoErrc::timeout;
    case ENOBUFS: return IoErrc::overrun;
    default: return IoErrc::disconnected;
  }
}

// What the kernel tells beside a frame.
struct Remarks {
  double age_s = 0;
  std::uint32_t dropped = 0;  // frames lost on this socket so far
};

Remarks remarks_of(msghdr& message) {
  Remarks remarks;
  for (cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr; c = CMSG_NXTHDR(&message, c)) {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SO_TIMESTAMPNS) {
      timespec arrived{};
      timespec now{};
      std::memcpy(&arrived, CMSG_DATA(c), sizeof arrived);
      ::clock_gettime(CLOCK_REALTIME, &now);
      // The wall clock may be set meanwhile: an age below 0 makes no sense.
      remarks.age_s = std::max(0.0, static_cast<double>(now.tv_sec - arrived.tv_sec) +
                                        1e-9 * static_cast<double>(now.tv_nsec - arrived.tv_nsec));
    } else if (c->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&remarks.dropped, CMSG_DATA(c), sizeof remarks.dropped);
    }
  }
  return remarks;
}

std::vector<can_filter> filters_for(const std::vector<std::uint32_t>& ids) {
  std::vector<can_filter> filters;
  filters.reserve(ids.size());
  for (const std::uint32_t id : ids) {
    filters.push_back({id, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  return filters;
}

template <typename T>
bool set(int socket, int level, int option, const T& value) {
  return ::setsockopt(socket, level, option, &value, sizeof value) == 0;
}

}  // namespace

SocketcanTransport::SocketcanTransport(std::string interface, std::vector<std::uint32_t> ids,
                                       const Clock& clock)
    : interface_(std::move(interface)), ids_(std::move(ids)), clock_(clock) {
  if (interface_.empty() || interface_.size() >= IFNAMSIZ) {
    throw std::invalid_argument(
        fmt::format("SocketcanTransport: interface \"{}\" must have 1 to {} characters", interface_,
                    IFNAMSIZ - 1));
  }
  for (const std::uint32_t id : ids_) {
    if (id > CAN_SFF_MASK) {
      throw std::invalid_argument(
          fmt::format("SocketcanTransport: identifier 0x{:X} is above 0x7FF", id));
    }
  }
}

SocketcanTransport::~SocketcanTransport() {
  is_leaving_ = false;
  close();
}

Status SocketcanTransport::open() {
  if (!has_left()) {
    return failure("open: a frame from before is still on its way; ip link set down drops it",
                   EAGAIN);
  }
  close();
  const auto receiver = open_socket();
  if (!receiver) return receiver.error();
  receiver_ = receiver.value();
  const auto sender = open_socket();
  if (!sender) {
    close();
    return sender.error();
  }
  sender_ = sender.value();
  Status status = configure_receiver();
  if (status && !is_on_bus()) status = failure("open: not on the bus", ENETDOWN);
  if (!status) close();
  return status;
}

// Of an interface that is down, or a controller that went bus-off, the kernel takes frames and
// drops them without a word. The carrier goes and comes with the bus; IFF_RUNNING may be a second
// late. It cannot be read of an interface that is down.
bool SocketcanTransport::is_on_bus() const {
  std::ifstream file("/sys/class/net/" + interface_ + "/carrier");
  int carrier = 0;
  return !file.is_open() || (file >> carrier && carrier == 1);
}

Result<int> SocketcanTransport::open_socket() {
  const int opened = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  if (opened < 0) {
    const bool absent = errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT;
    return failure(absent ? "open: this kernel has no CAN support" : "open", errno);
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface_.c_str()));
  const char* what = "open: no such interface";
  // Nothing comes in before the filters are set.
  if (address.can_ifindex != 0 &&
      ::setsockopt(opened, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0) == 0 &&
      ::bind(opened, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    return opened;
  }
  if (address.can_ifindex != 0) what = "open: bind";
  const IoError error = failure(what, errno);
  ::close(opened);
  return error;
}

Status SocketcanTransport::configure_receiver() {
  const std::vector<can_filter> filters = filters_for(ids_);
  const can_err_mask_t errors =
      CAN_ERR_BUSOFF | CAN_ERR_RESTARTED | CAN_ERR_CRTL | CAN_ERR_TX_TIMEOUT;
  const int on = 1;
  if (!set(receiver_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors) ||
      !set(receiver_, SOL_SOCKET, SO_TIMESTAMPNS, on) ||
      !set(receiver_, SOL_SOCKET, SO_RXQ_OVFL, on) ||
      !set(sender_, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, on) ||
      ::setsockopt(receiver_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                   static_cast<socklen_t>(filters.size() * sizeof(can_filter))) != 0) {
    return failure("open: set options", errno);
  }
  return Done{};
}

// From now on the sender hears frames of this identifier, its own among them.
Status SocketcanTransport::watch_own(std::uint32_t id) {
  if (std::ranges::find(sent_ids_, id) != sent_ids_.end()) return Done{};
  sent_ids_.push_back(id);
  const std::vector<can_filter> filters = filters_for(sent_ids_);
  if (::setsockopt(sender_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                   static_cast<socklen_t>(filters.size() * sizeof(can_filter))) != 0) {
    return failure("send: set filter", errno);
  }
  return Done{};
}

// Whether the frame that was sent before has been on the bus; waits for it a little.
bool SocketcanTransport::has_left() {
  pollfd waiting{sender_, POLLIN, 0};
  while (is_leaving_ && ::poll(&waiting, 1, longest_leaving_ms) > 0) {
    can_frame raw{};
    iovec buffer{&raw, sizeof raw};
    msghdr message{};
    message.msg_iov = &buffer;
    message.msg_iovlen = 1;
    if (::recvmsg(sender_, &message, 0) != sizeof raw) {
      // The interface is down, and what it had to send is dropped.
      if (errno != EAGAIN) is_leaving_ = false;
      break;
    }
    // Frames of others with the same identifier come without this mark.
    if ((message.msg_flags & MSG_CONFIRM) != 0) is_leaving_ = false;
  }
  return !is_leaving_;
}

Status SocketcanTransport::send(const CanFrame& frame) {
  if (receiver_ < 0) return failure("send", ENOTCONN);
  if (!has_left()) return failure("send: the frame before is still on its way", EAGAIN);
  Status watched = watch_own(frame.id & CAN_SFF_MASK);
  if (!watched) return watched;
  can_frame raw{};
  raw.can_id = frame.id & CAN_SFF_MASK;
  raw.can_dlc = std::min<std::uint8_t>(frame.length, CAN_MAX_DLEN);
  std::copy(frame.data.begin(), frame.data.end(), raw.data);
  if (::write(sender_, &raw, sizeof raw) == sizeof raw) {
    is_leaving_ = true;
    return Done{};
  }
  if (errno != ENOBUFS || !is_passive_) return failure("send", errno);
  close();
  return failure("send: the queue is full, and nobody on the bus listens", ENETDOWN);
}

Result<CanFrame> SocketcanTransport::receive() {
  if (receiver_ < 0) return failure("receive", ENOTCONN);
  can_frame raw{};
  iovec buffer{&raw, sizeof raw};
  alignas(cmsghdr) std::array<char, 128> control{};
  msghdr message{};
  message.msg_iov = &buffer;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  for (;;) {
    if (::recvmsg(receiver_, &message, 0) != sizeof raw) return failure("receive", errno);
    if ((raw.can_id & CAN_ERR_FLAG) == 0) break;
    const auto error = bus_error(raw.can_id, raw.data[1]);
    if (error) return *error;
    message.msg_controllen = control.size();
  }
  const Remarks remarks = remarks_of(message);
  if (std::exchange(dropped_, remarks.dropped) != remarks.dropped) {
    return failure("receive: the kernel dropped frames", ENOBUFS);
  }
  CanFrame frame{.id = raw.can_id & CAN_SFF_MASK, .length = raw.can_dlc};
  std::copy(std::begin(raw.data), std::end(raw.data), frame.data.begin());
  frame.time_s = clock_.now_s() - remarks.age_s;
  return frame;
}

// What an error frame means: the end of the link, lost frames, or only a note.
std::optional<IoError> SocketcanTransport::bus_error(std::uint32_t kind, std::uint8_t controller) {
  if ((kind & CAN_ERR_CRTL) != 0) {
    // A frame that tells of an overflow may tell nothing of the state.
    constexpr unsigned passive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
    constexpr unsigned warning = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;
    if ((controller & (passive | warning | CAN_ERR_CRTL_ACTIVE)) != 0) {
      is_passive_ = (controller & passive) != 0;
    }
  }
  const char* lost = nullptr;
  if ((kind & CAN_ERR_TX_TIMEOUT) != 0) lost = "receive: the controller cannot send";
  if ((kind & CAN_ERR_RESTARTED) != 0) lost = "receive: the controller was restarted";
  if ((kind & CAN_ERR_BUSOFF) != 0) lost = "receive: the controller went bus-off";
  if (lost != nullptr) {
    // Off the bus, a controller drops the frame that it had to send.
    if ((kind & (CAN_ERR_BUSOFF | CAN_ERR_RESTARTED)) != 0) is_leaving_ = false;
    close();
    return failure(lost, ENETDOWN);
  }
  constexpr unsigned overflow = CAN_ERR_CRTL_RX_OVERFLOW | CAN_ERR_CRTL_TX_OVERFLOW;
  if ((kind & CAN_ERR_CRTL) != 0 && (controller & overflow) != 0) {
    return failure("receive: the controller lost frames", ENOBUFS);
  }
  return std::nullopt;
}

IoError SocketcanTransport::failure(const char* operation, int error) const {
  return {code_from_errno(error),
          fmt::format("CAN {}: {} ({})", interface_, operation, std::strerror(error))};
}

// The sender goes on listening for a frame that has not left yet: see open().
void SocketcanTransport::close() {
  if (receiver_ >= 0) ::close(receiver_);
  receiver_ = -1;
  dropped_ = 0;
  is_passive_ = false;
  if (is_leaving_) return;
  if (sender_ >= 0) ::close(sender_);
  sender_ = -1;
  sent_ids_.clear();
}

}  // namespace rvbench::hal
