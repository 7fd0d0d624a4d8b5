#include "bench/factory/broker_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>

#include "bench/factory/host_name.hpp"
#include "bench/file_kind.hpp"
#include "bench/text_file.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t longest_topic = 200;  // MQTT allows 65535 bytes; brokers of clouds, 256

// Why it is no name of one topic to publish to (MQTT 3.1.1, 4.7); "" if it is.
std::string topic_fault(const std::string& topic) {
  if (topic.size() > longest_topic) return fmt::format("is longer than {} bytes", longest_topic);
  if (topic.find_first_of("+#") != std::string::npos) return "must not hold the wildcards + and #";
  if (topic.find('\0') != std::string::npos) return "must not hold a character 0";
  if (topic.starts_with('$')) return "must not begin with $: such topics are the broker's own";
  return "";
}

std::string read_station(hal::ConfigReader& root) {
  std::string station = root.text("station_name", host_name());
  const bool is_level = !station.empty() && station.find('/') == std::string::npos;
  if (!is_level || !topic_fault(station).empty()) {
    root.fault("station_name",
               "must be one level of a topic: not empty, without / + # and a first $");
  }
  return station;
}

std::string read_topic(hal::ConfigReader& root, const std::string& station) {
  std::string topic = root.text("topic", "rvbench/" + station + "/result");
  const auto slash = topic.rfind('/');
  if (slash == std::string::npos || slash + 1 == topic.size()) {
    root.fault("topic", "needs two levels at least: \"status\" takes the place of the last");
  } else if (topic.substr(slash) == "/status") {
    root.fault("topic", "must not end in /status, where the station says whether it is online");
  }
  if (const std::string fault = topic_fault(topic); !fault.empty()) root.fault("topic", fault);
  return topic;
}

std::string read_ca(hal::ConfigReader& root, const std::filesystem::path& folder) {
  auto tls = root.optional_object("tls");
  if (!tls) return "";
  const std::filesystem::path ca = folder / tls->text("ca");
  if (!read_file(ca)) {
    tls->fault("ca", hal::in_quotes(ca.string()) + " is no file, or cannot be read");
  }
  return ca.string();
}

std::string read_password(hal::ConfigReader& root, const std::filesystem::path& folder) {
  if (!root.has("password_file")) return "";
  const std::filesystem::path file = folder / root.text("password_file");
  const std::string shown = hal::in_quotes(file.string());
  struct stat status {};
  const auto text = read_file(file);
  if (!text || ::stat(file.c_str(), &status) != 0) {
    root.fault("password_file", shown + " is no file, or cannot be read");
    return "";
  }
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    root.fault("password_file", shown + " is open to others: chmod 600 it");
  }
  const std::string password = text->substr(0, text->find_first_of("\r\n"));
  if (password.empty()) root.fault("password_file", shown + " holds no password in its first line");
  return password;
}

}  // namespace

std::string Broker::status_topic() const { return topic.substr(0, topic.rfind('/')) + "/status"; }

std::string Broker::address() const { return fmt::format("{}:{}", host, port); }

std::variant<Broker, std::vector<hal::ConfigFault>> read_broker(const std::string& file) {
  using Faults = std::vector<hal::ConfigFault>;
  hal::ConfigReader root = hal::ConfigReader::from_file(file);
  if (auto fault = other_kind_fault(root, "broker")) return Faults{*fault};
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  Broker broker;
  broker.host = root.text("host");
  broker.ca = read_ca(root, folder);
  broker.port = root.integer("port", {1, 65535}, broker.ca.empty() ? 1883 : 8883);
  broker.user = root.text("user", "");
  broker.password = read_password(root, folder);
  if (root.has("password_file") && broker.user.empty()) {
    root.fault("password_file", "needs a \"user\" whose password it is");
  }
  const std::string station = read_station(root);
  broker.client_id = root.text("client_id", "rvbench-" + station);
  if (broker.client_id.empty()) root.fault("client_id", "must not be empty");
  broker.qos = root.integer("qos", {1, 2}, broker.qos);
  broker.topic = read_topic(root, station);
  broker.step = root.text("step", "");
  broker.keep_alive_s = root.integer("keep_alive_s", {1, 3600}, broker.keep_alive_s);
  root.finish();
  if (!root.faults().empty()) return root.faults();
  return broker;
}

std::vector<hal::ConfigFault> remarks_on(const Broker& broker) {
  const bool is_here =
      broker.host == "localhost" || broker.host == "127.0.0.1" || broker.host == "::1";
  if (broker.password.empty() || !broker.ca.empty() || is_here) return {};
  return {{0, "/password_file", "without \"tls\" everybody on the network can read the password"}};
}

}  // namespace rvbench::bench
