#include "hal/can/socketcan_counters.hpp"

#include <fmt/format.h>
#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

namespace rvbench::hal {
namespace {

using Counts = std::map<std::string, std::uint64_t>;
using Bytes = std::span<const char>;

struct Request {
  nlmsghdr header;
  ifinfomsg link;
};

class Socket {
 public:
  Socket() : file_(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE)) {
    const timeval patience{0, 50'000};
    if (file_ >= 0) ::setsockopt(file_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  ~Socket() {
    if (file_ >= 0) ::close(file_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int file() const { return file_; }

 private:
  int file_;
};

// The content of an attribute; empty if there is none of that type.
Bytes attribute(Bytes attributes, unsigned short type) {
  while (attributes.size() >= sizeof(rtattr)) {
    rtattr head{};
    std::memcpy(&head, attributes.data(), sizeof head);
    if (head.rta_len < sizeof head || head.rta_len > attributes.size()) return {};
    if ((head.rta_type & NLA_TYPE_MASK) == type) {
      return attributes.subspan(sizeof head, head.rta_len - sizeof head);
    }
    attributes =
        attributes.subspan(std::min<std::size_t>(RTA_ALIGN(head.rta_len), attributes.size()));
  }
  return {};
}

// A kernel that is older than the header tells less, a newer one more.
template <typename T>
T structure_from(Bytes content) {
  T value{};
  std::memcpy(&value, content.data(), std::min(sizeof value, content.size()));
  return value;
}

void count_interface(Bytes content, Counts& counts) {
  const auto stats = structure_from<rtnl_link_stats64>(content);
  counts["rx_errors"] = stats.rx_errors;
  counts["tx_errors"] = stats.tx_errors;
  counts["rx_dropped"] = stats.rx_dropped;
  counts["tx_dropped"] = stats.tx_dropped;
  counts["rx_length_errors"] = stats.rx_length_errors;
  counts["rx_over_errors"] = stats.rx_over_errors;
  counts["rx_crc_errors"] = stats.rx_crc_errors;
  counts["rx_frame_errors"] = stats.rx_frame_errors;
  counts["rx_fifo_errors"] = stats.rx_fifo_errors;
  counts["rx_missed_errors"] = stats.rx_missed_errors;
  counts["tx_aborted_errors"] = stats.tx_aborted_errors;
  counts["tx_carrier_errors"] = stats.tx_carrier_errors;
  counts["tx_fifo_errors"] = stats.tx_fifo_errors;
}

void count_controller(Bytes content, Counts& counts) {
  const auto stats = structure_from<can_device_stats>(content);
  // Some drivers, sja1000 among them, count a lost arbitration as an error of sending: nothing is
  // wrong then. What is, is in bus_error.
  counts.erase("tx_errors");
  counts["bus_error"] = stats.bus_error;
  counts["error_warning"] = stats.error_warning;
  counts["error_passive"] = stats.error_passive;
  counts["bus_off"] = stats.bus_off;
  counts["restarts"] = stats.restarts;
}

// Nothing if the answer is none about an interface.
std::optional<Counts> counts_from(Bytes answer) {
  constexpr std::size_t before_attributes = NLMSG_ALIGN(sizeof(Request));
  nlmsghdr header{};
  if (answer.size() < before_attributes) return std::nullopt;
  std::memcpy(&header, answer.data(), sizeof header);
  if (header.nlmsg_type != RTM_NEWLINK || header.nlmsg_len > answer.size()) return std::nullopt;
  const Bytes attributes = answer.first(header.nlmsg_len).subspan(before_attributes);
  const Bytes stats = attribute(attributes, IFLA_STATS64);
  if (stats.empty()) return std::nullopt;
  Counts counts;
  count_interface(stats, counts);
  const Bytes info = attribute(attributes, IFLA_LINKINFO);
  const Bytes kind = attribute(info, IFLA_INFO_KIND);
  const Bytes controller = attribute(info, IFLA_INFO_XSTATS);
  // What the extra counters mean, depends on the kind; the name ends with a zero.
  if (!controller.empty() && std::string_view(kind.data(), kind.size()).starts_with("can")) {
    count_controller(controller, counts);
  }
  return counts;
}

}  // namespace

Result<BusCounters> SocketcanCounters::read() {
  const unsigned index = ::if_nametoindex(interface_.c_str());
  if (index == 0) return failure("count: no such interface", errno);
  const Socket socket;
  if (socket.file() < 0) return failure("count: open netlink", errno);
  Request request{};
  request.header = {sizeof request, RTM_GETLINK, NLM_F_REQUEST, 1, 0};
  request.link.ifi_family = AF_UNSPEC;
  request.link.ifi_index = static_cast<int>(index);
  if (::send(socket.file(), &request, sizeof request, 0) != sizeof request) {
    return failure("count: ask", errno);
  }
  std::array<char, 32768> answer{};
  const auto size = ::recv(socket.file(), answer.data(), answer.size(), 0);
  if (size < 0) return failure("count: no answer", errno);
  auto counts = counts_from(Bytes(answer).first(static_cast<std::size_t>(size)));
  if (!counts) return failure("count: no counters in the answer", EBADMSG);
  return BusCounters{interface_, std::move(*counts)};
}

IoError SocketcanCounters::failure(const char* operation, int error) const {
  return {IoErrc::disconnected,
          fmt::format("CAN {}: {} ({})", interface_, operation, std::strerror(error))};
}

}  // namespace rvbench::hal
