#include "hal/can/socketcan_transport.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <utility>

namespace rvbench::hal {
namespace {

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

SocketcanTransport::~SocketcanTransport() { close(); }

Status SocketcanTransport::open() {
  close();
  socket_ = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  if (socket_ < 0) {
    const bool absent = errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT;
    return failure(absent ? "open: this kernel has no CAN support" : "open", errno);
  }
  Status status = configure();
  if (status) status = bind_to_interface();
  if (!status) close();
  return status;
}

Status SocketcanTransport::configure() {
  std::vector<can_filter> filters;
  for (const std::uint32_t id : ids_) {
    filters.push_back({id, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  const can_err_mask_t errors = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;
  const int on = 1;
  const auto size = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
  if (::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), size) != 0 ||
      ::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors) != 0 ||
      ::setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on) != 0 ||
      ::setsockopt(socket_, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on) != 0) {
    return failure("open: set options", errno);
  }
  return Done{};
}

Status SocketcanTransport::bind_to_interface() {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface_.c_str()));
  if (address.can_ifindex == 0) return failure("open: no such interface", errno);
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return failure("open: bind", errno);
  }
  dropped_ = 0;
  return Done{};
}

Status SocketcanTransport::send(const CanFrame& frame) {
  if (socket_ < 0) return failure("send", ENOTCONN);
  can_frame raw{};
  raw.can_id = frame.id & CAN_SFF_MASK;
  raw.can_dlc = std::min<std::uint8_t>(frame.length, CAN_MAX_DLEN);
  std::copy(frame.data.begin(), frame.data.end(), raw.data);
  if (::write(socket_, &raw, sizeof raw) != sizeof raw) return failure("send", errno);
  return Done{};
}

Result<CanFrame> SocketcanTransport::receive() {
  if (socket_ < 0) return failure("receive", ENOTCONN);
  can_frame raw{};
  iovec buffer{&raw, sizeof raw};
  alignas(cmsghdr) std::array<char, 128> control{};
  msghdr message{};
  message.msg_iov = &buffer;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  if (::recvmsg(socket_, &message, 0) != sizeof raw) return failure("receive", errno);
  if ((raw.can_id & CAN_ERR_FLAG) != 0) {
    close();
    return failure("receive: the controller went bus-off", ENETDOWN);
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

IoError SocketcanTransport::failure(const char* operation, int error) const {
  return {code_from_errno(error),
          fmt::format("CAN {}: {} ({})", interface_, operation, std::strerror(error))};
}

void SocketcanTransport::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

}  // namespace rvbench::hal
