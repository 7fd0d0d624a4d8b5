#include "bench/factory/packet_store.hpp"

#include <MQTTClientPersistence.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace rvbench::bench {
namespace {

constexpr const char* publish_key = "s-";

int code_of(bool done) { return done ? 0 : MQTTCLIENT_PERSISTENCE_ERROR; }

PacketStore& store_at(void* handle) { return *static_cast<PacketStore*>(handle); }

// Paho 1.3 takes memory that it gets from here for its own, but frees none that it did not allocate
// itself: what a connection finds under way, a packet and its keys, is lost to the process.
void* lost_to_paho(std::size_t size) { return std::malloc(size); }

char* text_for_paho(const std::string& bytes) {
  auto* copy = static_cast<char*>(lost_to_paho(bytes.size() + 1));
  if (copy != nullptr) std::memcpy(copy, bytes.c_str(), bytes.size() + 1);
  return copy;
}

int open_store(void** handle, const char*, const char*, void* context) {
  *handle = context;
  return 0;
}

int close_store(void*) { return 0; }

int put_packet(void* handle, char* key, int count, char* buffers[], int sizes[]) {
  std::string packet;
  for (int i = 0; i < count; ++i) packet.append(buffers[i], static_cast<std::size_t>(sizes[i]));
  return code_of(store_at(handle).put(key, packet));
}

int get_packet(void* handle, char* key, char** buffer, int* size) {
  const auto packet = store_at(handle).outbox().packet(key);
  if (!packet) return MQTTCLIENT_PERSISTENCE_ERROR;
  *buffer = text_for_paho(*packet);
  *size = static_cast<int>(packet->size());
  return code_of(*buffer != nullptr);
}

int remove_packet(void* handle, char* key) { return code_of(store_at(handle).remove(key)); }

int list_keys(void* handle, char*** keys, int* count) {
  const std::vector<std::string> there = store_at(handle).outbox().packet_keys();
  *count = static_cast<int>(there.size());
  *keys = nullptr;
  if (there.empty()) return 0;
  *keys = static_cast<char**>(lost_to_paho(there.size() * sizeof(char*)));
  if (*keys == nullptr) return MQTTCLIENT_PERSISTENCE_ERROR;
  for (std::size_t i = 0; i < there.size(); ++i) (*keys)[i] = text_for_paho(there[i]);
  return 0;
}

int clear_store(void* handle) { return code_of(store_at(handle).clear()); }

int has_key(void* handle, char* key) {
  return code_of(store_at(handle).outbox().packet(key).has_value());
}

int number_in(const std::string& key) {
  int number = 0;
  const std::size_t dash = key.find('-') + 1;
  std::from_chars(key.data() + dash, key.data() + key.size(), number);
  return number;
}

}  // namespace

void* PacketStore::for_paho() {
  if (!for_paho_) {
    for_paho_ = std::make_shared<MQTTClient_persistence>(
        MQTTClient_persistence{this, open_store, close_store, put_packet, get_packet, remove_packet,
                               list_keys, clear_store, has_key});
  }
  return for_paho_.get();
}

void PacketStore::begin(const std::string& result_id, const std::string& payload_sha256) {
  result_id_ = result_id;
  payload_sha256_ = payload_sha256;
}

bool PacketStore::put(const std::string& key, const std::string& packet) {
  if (key.starts_with(publish_key)) {
    if (result_id_.empty()) return true;
    return is_done(outbox_.note_sent(result_id_, number_in(key), payload_sha256_, key, packet));
  }
  const bool follows_a_result =
      outbox_.packet(publish_key + std::to_string(number_in(key))).has_value();
  return !follows_a_result || is_done(outbox_.keep_packet(key, packet));
}

bool PacketStore::remove(const std::string& key) {
  if (!key.starts_with(publish_key)) return is_done(outbox_.forget_packet(key));
  return is_done(restoring_ ? outbox_.recall() : outbox_.acknowledge(key));
}

bool PacketStore::clear() { return is_done(outbox_.recall()); }

bool PacketStore::is_done(const Status& status) {
  if (!status && !failed_) failed_ = status.error();
  return static_cast<bool>(status);
}

}  // namespace rvbench::bench
