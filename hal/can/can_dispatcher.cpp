#include "hal/can/can_dispatcher.hpp"

#include <deque>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "hal/can/waiting_frames.hpp"

namespace rvbench::hal {
namespace {

constexpr std::size_t mailbox_capacity = 4096;

class SharedBus {
 public:
  SharedBus(std::unique_ptr<CanTransport> bus, const std::vector<std::uint32_t>& ids)
      : bus_(std::move(bus)) {
    for (const std::uint32_t id : ids) mailboxes_[id];
  }

  Status open(std::uint32_t id) {
    mailboxes_.at(id).error.reset();  // the others' devices have yet to hear of theirs
    if (is_open_) return Done{};
    Status status = bus_->open();
    is_open_ = static_cast<bool>(status);
    return status;
  }

  // Whoever waits for frames hears that the bus was lost, also when it is opened before he asks.
  Status send(const CanFrame& frame) {
    Status sent = bus_->send(frame);
    if (!sent && sent.error().code == IoErrc::disconnected) note(sent.error());
    return sent;
  }

  Result<CanFrame> receive(std::uint32_t id) {
    empty_bus();
    Mailbox& mailbox = mailboxes_.at(id);
    if (!mailbox.frames.empty()) {
      const CanFrame frame = mailbox.frames.front();
      mailbox.frames.pop_front();
      return frame;
    }
    if (mailbox.error) return *std::exchange(mailbox.error, std::nullopt);
    return IoError{IoErrc::timeout, "CAN: receive"};
  }

 private:
  struct Mailbox {
    std::deque<CanFrame> frames;
    std::optional<IoError> error;  // of the bus, to be told once, after the frames
  };

  void empty_bus() {
    const Status emptied =
        take_waiting_frames(*bus_, [this](const CanFrame& frame) { return deliver(frame); });
    if (!emptied) note(emptied.error());
  }

  Status deliver(const CanFrame& frame) {
    const auto found = mailboxes_.find(frame.id);
    if (found == mailboxes_.end()) return Done{};
    std::deque<CanFrame>& frames = found->second.frames;
    if (frames.size() == mailbox_capacity) frames.pop_front();
    frames.push_back(frame);
    return Done{};
  }

  // A bus that was lost can be opened anew.
  void note(const IoError& error) {
    if (error.code == IoErrc::disconnected) is_open_ = false;
    for (auto& [id, mailbox] : mailboxes_) mailbox.error = error;
  }

  std::unique_ptr<CanTransport> bus_;
  std::map<std::uint32_t, Mailbox> mailboxes_;
  bool is_open_ = false;
};

class Port final : public CanTransport {
 public:
  Port(std::shared_ptr<SharedBus> bus, std::uint32_t id) : bus_(std::move(bus)), id_(id) {}

  Status open() override { return bus_->open(id_); }
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
