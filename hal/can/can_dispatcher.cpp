#include "hal/can/can_dispatcher.hpp"

#include <deque>
#include <map>
#include <stdexcept>
#include <utility>

namespace rvbench::hal {
namespace {

constexpr std::size_t mailbox_capacity = 4096;

class SharedBus {
 public:
  SharedBus(std::unique_ptr<CanTransport> bus, const std::vector<std::uint32_t>& ids)
      : bus_(std::move(bus)) {
    for (const std::uint32_t id : ids) mailboxes_[id];
  }

  Status open() {
    if (is_open_) return Done{};
    Status status = bus_->open();
    is_open_ = static_cast<bool>(status);
    return status;
  }

  Status send(const CanFrame& frame) { return bus_->send(frame); }

  Result<CanFrame> receive(std::uint32_t id) {
    std::deque<CanFrame>& mailbox = mailboxes_.at(id);
    Result<CanFrame> next = bus_->receive();
    for (; next; next = bus_->receive()) deliver(next.value());
    if (mailbox.empty()) return fail(next.error());
    const CanFrame frame = mailbox.front();
    mailbox.pop_front();
    return frame;
  }

 private:
  void deliver(const CanFrame& frame) {
    const auto found = mailboxes_.find(frame.id);
    if (found == mailboxes_.end()) return;
    if (found->second.size() == mailbox_capacity) found->second.pop_front();
    found->second.push_back(frame);
  }

  // A bus that was lost can be opened anew.
  IoError fail(const IoError& error) {
    if (error.code == IoErrc::disconnected) is_open_ = false;
    return error;
  }

  std::unique_ptr<CanTransport> bus_;
  std::map<std::uint32_t, std::deque<CanFrame>> mailboxes_;
  bool is_open_ = false;
};

class Port final : public CanTransport {
 public:
  Port(std::shared_ptr<SharedBus> bus, std::uint32_t id) : bus_(std::move(bus)), id_(id) {}

  Status open() override { return bus_->open(); }
  Status send(const CanFrame& frame) override { return bus_->send(frame); }
  Result<CanFrame> receive() override { return bus_->receive(id_); }

 private:
  std::shared_ptr<SharedBus> bus_;
  std::uint32_t id_;
};

}  // namespace

std::vector<std::unique_ptr<CanTransport>> split_by_id(std::unique_ptr<CanTransport> bus,
                                                       const std::vector<std::uint32_t>& ids) {
  if (!bus) throw std::invalid_argument("split_by_id: bus is null");
  const auto shared = std::make_shared<SharedBus>(std::move(bus), ids);
  std::vector<std::unique_ptr<CanTransport>> ports;
  for (const std::uint32_t id : ids) ports.push_back(std::make_unique<Port>(shared, id));
  return ports;
}

}  // namespace rvbench::hal
