#include "tests/factory/subscriber.hpp"

#include <MQTTClient.h>

#include <stdexcept>

namespace rvbench::test {

using std::chrono::milliseconds;

Subscriber::Subscriber(int port, const std::string& topic) {
  const std::string uri = "tcp://127.0.0.1:" + std::to_string(port);
  static int count = 0;  // a broker closes the connection of who has the same name
  const std::string name = "subscriber" + std::to_string(++count);
  MQTTClient_create(&client_, uri.c_str(), name.c_str(), MQTTCLIENT_PERSISTENCE_NONE, nullptr);
  MQTTClient_connectOptions options = MQTTClient_connectOptions_initializer;
  if (MQTTClient_connect(client_, &options) != MQTTCLIENT_SUCCESS ||
      MQTTClient_subscribe(client_, topic.c_str(), 2) != MQTTCLIENT_SUCCESS) {
    throw std::runtime_error("cannot subscribe at " + uri);
  }
}

Subscriber::~Subscriber() { MQTTClient_destroy(&client_); }

std::vector<Received> Subscriber::messages(std::size_t count) {
  (void)wait_until([&] {
    if (messages_.size() < count) take(milliseconds(50));
    return messages_.size() >= count;
  });
  take(milliseconds(100));
  return messages_;
}

std::vector<nlohmann::json> Subscriber::results(std::size_t count) {
  std::vector<nlohmann::json> results;
  for (const Received& message : messages(count)) {
    results.push_back(nlohmann::json::parse(message.payload));
  }
  return results;
}

void Subscriber::take(milliseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) {
    char* topic = nullptr;
    int size = 0;
    MQTTClient_message* message = nullptr;
    MQTTClient_receive(client_, &topic, &size, &message, 10);
    if (message == nullptr) continue;
    messages_.push_back({topic,
                         {static_cast<const char*>(message->payload),
                          static_cast<std::size_t>(message->payloadlen)},
                         message->retained != 0});
    MQTTClient_freeMessage(&message);
    MQTTClient_free(topic);
  }
}

}  // namespace rvbench::test
