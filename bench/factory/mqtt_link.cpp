#include "bench/factory/mqtt_link.hpp"

#include <MQTTClient.h>
#include <fmt/format.h>

#include <string_view>

#include "bench/factory/packet_store.hpp"
#include "bench/factory/result_message.hpp"
#include "bench/sha256.hpp"

namespace rvbench::bench {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int connect_timeout_s = 5;
constexpr std::chrono::seconds longest_wait_for_acknowledgement{20};
constexpr unsigned long look_again_ms = 5;
constexpr int farewell_timeout_ms = 1000;
constexpr int at_least_once = 1;
constexpr std::string_view online = "online", offline = "offline";

// Brackets keep the colons of an IPv6 address from that of the port.
std::string uri_of(const Broker& broker) {
  const bool is_ipv6 = broker.host.find(':') != std::string::npos;
  return fmt::format("{}://{}:{}", broker.ca.empty() ? "tcp" : "ssl",
                     is_ipv6 ? "[" + broker.host + "]" : broker.host, broker.port);
}

int note_tls_error(const char* text, std::size_t size, void* into) {
  static_cast<std::string*>(into)->append(text, size);
  return 0;
}

// Of an answer that names a reason: MQTT 3.1.1, 3.2.2.3.
std::string reason_of_refusal(int code) {
  switch (code) {
    case 1: return "the broker does not speak MQTT 3.1.1";
    case 2: return "the broker does not take this \"client_id\"";
    case 3: return "the broker is not ready";
    case 4: return "the broker does not take this \"user\" and password";
    case 5: return "the broker does not let this \"user\" in with this password";
    default: return "";
  }
}

}  // namespace

struct MqttLink::Paho {
  explicit Paho(Outbox& outbox) : store(outbox) {}

  PacketStore store;
  std::string tls_errors;
  MQTTClient client = nullptr;

  // Also takes what comes, of which there is nothing for us.
  void work(unsigned long time_ms) const {
    char* topic = nullptr;
    int size = 0;
    MQTTClient_message* message = nullptr;
    MQTTClient_receive(client, &topic, &size, &message, time_ms);
    if (message == nullptr) return;
    MQTTClient_freeMessage(&message);
    MQTTClient_free(topic);
  }

  void say_status(const Broker& broker, std::string_view status) const {
    MQTTClient_publish(client, broker.status_topic().c_str(), static_cast<int>(status.size()),
                       status.data(), at_least_once, true, nullptr);
  }
};

MqttLink::MqttLink(const Broker& broker, Outbox& outbox)
    : broker_(broker), outbox_(outbox), paho_(std::make_unique<Paho>(outbox)) {}

MqttLink::~MqttLink() { close(); }

void MqttLink::close() {
  if (is_up()) paho_->say_status(broker_, offline);
  hang_up();
}

void MqttLink::hang_up() {
  if (is_up()) MQTTClient_disconnect(paho_->client, farewell_timeout_ms);
  if (paho_->client != nullptr) MQTTClient_destroy(&paho_->client);
}

Status MqttLink::make_client() {
  paho_->store.set_restoring(true);
  const int made =
      MQTTClient_create(&paho_->client, uri_of(broker_).c_str(), broker_.client_id.c_str(),
                        MQTTCLIENT_PERSISTENCE_USER, paho_->store.for_paho());
  paho_->store.set_restoring(false);
  if (paho_->store.failed()) return *paho_->store.failed();
  if (made == MQTTCLIENT_SUCCESS) return Done{};
  return IoError{IoErrc::refused, fmt::format("MQTT client: {}", MQTTClient_strerror(made))};
}

// A session goes on only where both sides know of it.
Status MqttLink::connect() {
  auto is_old = open(broker_.qos == at_least_once);
  if (!is_old) return is_old.error();
  const auto under_way = outbox_.ids_of("sent");
  if (!under_way) return under_way.error();
  if (is_old.value() && under_way.value().empty()) {
    // The broker may remember numbers of messages that nobody follows any more, and take what is
    // sent under one of them for a repetition (MQTT 3.1.1, 4.3.3).
    hang_up();
    if (is_old = open(true); !is_old) return is_old.error();
    hang_up();
    if (is_old = open(false); !is_old) return is_old.error();
  } else if (!is_old.value() && !under_way.value().empty()) {
    // The broker knows nothing of them any more: the second half of a packet's way would be
    // answered as if all were well. They are due again, and nothing is under way from here on.
    if (const Status recalled = outbox_.recall(); !recalled) return recalled;
    hang_up();
    if (is_old = open(broker_.qos == at_least_once); !is_old) return is_old.error();
  }
  paho_->say_status(broker_, online);
  return outbox_.note_sent_again();
}

// Connects. @return whether the broker goes on with a session of before
Result<bool> MqttLink::open(bool clean) {
  if (const Status made = make_client(); !made) return made.error();
  const std::string status_topic = broker_.status_topic();
  MQTTClient_willOptions will = MQTTClient_willOptions_initializer;
  will.topicName = status_topic.c_str();
  will.message = offline.data();
  will.retained = true;
  will.qos = at_least_once;
  MQTTClient_SSLOptions tls = MQTTClient_SSLOptions_initializer;
  tls.trustStore = broker_.ca.c_str();
  tls.verify = true;  // also that the name in the certificate is the host's
  tls.disableDefaultTrustStore = true;
  tls.ssl_error_cb = note_tls_error;
  tls.ssl_error_context = &paho_->tls_errors;
  MQTTClient_connectOptions options = MQTTClient_connectOptions_initializer;
  options.keepAliveInterval = broker_.keep_alive_s;
  options.cleansession = clean;
  options.reliable = false;  // else "online" would have to be acknowledged first
  options.will = &will;
  options.username = broker_.user.empty() ? nullptr : broker_.user.c_str();
  options.password = broker_.password.empty() ? nullptr : broker_.password.c_str();
  options.connectTimeout = connect_timeout_s;
  options.MQTTVersion = MQTTVERSION_3_1_1;
  options.ssl = broker_.ca.empty() ? nullptr : &tls;
  const int code = MQTTClient_connect(paho_->client, &options);
  if (code != MQTTCLIENT_SUCCESS) return why_not_connected(code);
  return options.returned.sessionPresent != 0;
}

IoError MqttLink::why_not_connected(int code) const {
  const std::string where = "MQTT broker at " + broker_.address() + ": ";
  if (const std::string reason = reason_of_refusal(code); !reason.empty()) {
    return {IoErrc::refused, where + reason};
  }
  if (!paho_->tls_errors.empty()) {
    std::string detail = paho_->tls_errors;
    while (!detail.empty() && detail.back() == '\n') detail.pop_back();
    return {IoErrc::refused, where +
                                 "no TLS with it, its certificate must be signed by what \"ca\" "
                                 "holds and name this host (" +
                                 detail + ")"};
  }
  return {IoErrc::disconnected, where + "nobody answers there"};
}

bool MqttLink::is_up() const {
  return paho_->client != nullptr && MQTTClient_isConnected(paho_->client) != 0;
}

Status MqttLink::send(const OutboxEntry& due, const std::stop_token& stop) {
  const std::string payload = payload_to_send(due);
  if (const Status noted = outbox_.note_attempt(due.result_id); !noted) return noted;
  paho_->store.begin(due.result_id, sha256_of_text(payload));
  const int code =
      MQTTClient_publish(paho_->client, broker_.topic.c_str(), static_cast<int>(payload.size()),
                         payload.data(), broker_.qos, false, nullptr);
  paho_->store.end();
  if (paho_->store.failed()) return *paho_->store.failed();
  if (code != MQTTCLIENT_SUCCESS) {
    return IoError{IoErrc::disconnected,
                   "MQTT broker at " + broker_.address() + ": the result could not be sent"};
  }
  return wait_for(due.result_id, stop);
}

Status MqttLink::finish(const std::vector<std::string>& result_ids, const std::stop_token& stop) {
  for (const std::string& id : result_ids) {
    if (const Status done = wait_for(id, stop); !done) return done;
  }
  return Done{};
}

Status MqttLink::wait_for(const std::string& result_id, const std::stop_token& stop) {
  const auto end = Clock::now() + longest_wait_for_acknowledgement;
  const std::string where = "MQTT broker at " + broker_.address() + ": ";
  for (;;) {
    const auto is_there = outbox_.is_acknowledged(result_id);
    if (!is_there) return is_there.error();
    if (is_there.value()) return Done{};
    if (paho_->store.failed()) return *paho_->store.failed();
    if (!is_up()) return IoError{IoErrc::disconnected, where + "the link was lost"};
    if (stop.stop_requested()) return IoError{IoErrc::timeout, where + "told to stop"};
    if (Clock::now() >= end) return IoError{IoErrc::timeout, where + "no acknowledgement"};
    paho_->work(look_again_ms);
  }
}

void MqttLink::idle(milliseconds time) { paho_->work(static_cast<unsigned long>(time.count())); }

}  // namespace rvbench::bench
