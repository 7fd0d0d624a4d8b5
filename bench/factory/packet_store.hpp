#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bench/factory/outbox.hpp"

namespace rvbench::bench {

/// The outbox as the store in which Paho keeps its packets, behind pointers of C.
///
/// Keys     "s-7" is the PUBLISH of message 7, "sc-7" the PUBREL that follows it at QoS 2
/// Threads  as the outbox
class PacketStore {
 public:
  explicit PacketStore(Outbox& outbox) : outbox_(outbox) {}

  /// What is published next; nothing: a message that is no result, and is not kept.
  void begin(const std::string& result_id, const std::string& payload_sha256);
  void end() { result_id_.clear(); }

  /// While Paho reads what is there, a packet that it throws away was not acknowledged.
  void set_restoring(bool restoring) { restoring_ = restoring; }

  /// Why the outbox did not take a step; nothing if it took them all.
  const std::optional<IoError>& failed() const { return failed_; }

  /// An MQTTClient_persistence, for MQTTClient_create(); lives as long as this object.
  void* for_paho();
  PacketStore(const PacketStore&) = delete;
  PacketStore& operator=(const PacketStore&) = delete;

  bool put(const std::string& key, const std::string& packet);
  bool remove(const std::string& key);
  bool clear();
  const Outbox& outbox() const { return outbox_; }

 private:
  bool is_done(const Status& status);

  Outbox& outbox_;
  std::string result_id_, payload_sha256_;
  bool restoring_ = false;
  std::optional<IoError> failed_;
  std::shared_ptr<void> for_paho_;  // of a type without a name that could be declared here
};

}  // namespace rvbench::bench
