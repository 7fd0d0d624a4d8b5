#include "hal/can/in_process_transport.hpp"

#include <deque>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace rvbench::hal {
namespace {

// One direction of the bus.
class FrameQueue {
 public:
  explicit FrameQueue(std::size_t capacity) : capacity_(capacity) {}

  void push(const CanFrame& frame) {
    const std::lock_guard lock(mutex_);
    if (frames_.size() == capacity_) frames_.pop_front();
    frames_.push_back(frame);
  }

  bool pop(CanFrame& frame) {
    const std::lock_guard lock(mutex_);
    if (frames_.empty()) return false;
    frame = frames_.front();
    frames_.pop_front();
    return true;
  }

 private:
  const std::size_t capacity_;
  std::mutex mutex_;
  std::deque<CanFrame> frames_;
};

class InProcessEnd final : public CanTransport {
 public:
  InProcessEnd(std::shared_ptr<FrameQueue> in, std::shared_ptr<FrameQueue> out,
               std::function<double()> now_s)
      : in_(std::move(in)), out_(std::move(out)), now_s_(std::move(now_s)) {}

  Status open() override { return Done{}; }

  Status send(const CanFrame& frame) override {
    CanFrame stamped = frame;
    stamped.time_s = now_s_();
    out_->push(stamped);
    return Done{};
  }

  Result<CanFrame> receive() override {
    CanFrame frame;
    if (!in_->pop(frame)) return IoError{IoErrc::timeout, "CAN in process: receive"};
    return frame;
  }

 private:
  std::shared_ptr<FrameQueue> in_;
  std::shared_ptr<FrameQueue> out_;
  std::function<double()> now_s_;
};

}  // namespace

InProcessBus make_in_process_bus(std::function<double()> now_s, std::size_t capacity) {
  if (!now_s) throw std::invalid_argument("make_in_process_bus: now_s is empty");
  if (capacity == 0) throw std::invalid_argument("make_in_process_bus: capacity is 0, at least 1");
  auto to_bench = std::make_shared<FrameQueue>(capacity);
  auto to_nodes = std::make_shared<FrameQueue>(capacity);
  return {std::make_unique<InProcessEnd>(to_bench, to_nodes, now_s),
          std::make_unique<InProcessEnd>(to_nodes, to_bench, now_s)};
}

}  // namespace rvbench::hal
