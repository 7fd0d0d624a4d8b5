#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bench/commands/commands.hpp"
#include "bench/factory/publisher.hpp"
#include "bench/fault_lines.hpp"
#include "bench/file_lock.hpp"
#include "bench/json_text.hpp"
#include "bench/stop_on_signal.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const OutboxEntry& entry) {
  return hal::json_object({{"result_id", entry.result_id},
                           {"folder", entry.folder},
                           {"message_id", entry.message_id},
                           {"payload_sha256", entry.payload_sha256},
                           {"sends", entry.sends}});
}

class PublishCommand final : public Command {
 public:
  std::string name() const override { return "publish"; }
  std::string summary() const override { return "sends results to the factory's MQTT broker"; }
  std::string examples() const override {
    return "  rvbench publish --broker mqtt.json\n"
           "  rvbench publish --broker mqtt.json --follow     stays, and sends what comes\n"
           "  rvbench publish --out /srv/runs --broker mqtt.json --json\n"
           "mqtt.json, of which all but \"host\" may be left out:\n"
           "  {\"host\": \"broker.example\", \"port\": 8883, \"tls\": {\"ca\": "
           "\"factory_ca.pem\"},\n"
           "   \"user\": \"bench3\", \"password_file\": \"mqtt_password\", \"client_id\": "
           "\"bench3\",\n"
           "   \"qos\": 2, \"station_name\": \"bench3\", \"topic\": \"rvbench/bench3/result\",\n"
           "   \"step\": \"EOL-20\", \"keep_alive_s\": 30}\n"
           "Every judged run that has not been acknowledged is sent, oldest first. What is due\n"
           "waits in the folder's outbox.db while the broker is away (exit 30).\n";
  }
  std::vector<Option> options() override {
    return {
        {"--out", "folder of run folders; default: " + out_, &out_},
        {"--broker", "broker file: where to, and as whom", &broker_, true},
        {"--follow", "stay, and send results as they come, until Ctrl-C or SIGTERM", &follow_},
        {"--json",
         "one JSON document on standard output; with --follow a line for each acknowledged result",
         &json_}};
  }
  int run(Console& console) override;

 private:
  int publish(Console& console, const Broker& broker);
  int end(Console& console, const Broker& broker, const Outbox& outbox, const Ending& ending) const;
  std::string waiting(std::size_t left) const;

  std::string out_ = "runs";
  std::string broker_;
  bool follow_ = false, json_ = false;
  Json acknowledged_ = Json::array(), skipped_ = Json::array();
};

int PublishCommand::run(Console& console) {
  std::error_code unknown;
  if (!std::filesystem::is_directory(out_, unknown)) {
    return refuse_usage(console, "publish: no folder " + out_);
  }
  const auto file = read_broker(broker_);
  if (file.index() == 1) return refuse_file(console, broker_, std::get<1>(file));
  const Broker& broker = std::get<0>(file);
  remark(console, "warning", broker_, with_lines(broker_, remarks_on(broker)));
  try {
    const std::filesystem::path lock = std::filesystem::path(out_) / outbox_lock_name;
    if (const auto alone = FileLock::take(lock)) return publish(console, broker);
  } catch (const std::system_error& error) {
    return refuse_usage(console, std::string("publish: ") + error.what());
  }
  return refuse_usage(console, "publish: another rvbench publish is at work in " + out_);
}

int PublishCommand::publish(Console& console, const Broker& broker) {
  const StopOnSignal signals;
  auto opened = Outbox::open(out_);
  if (!opened) return refuse_data(console, "publish: " + describe(opened.error()));
  Outbox outbox = std::move(opened).value();
  const auto acknowledged = [&](const OutboxEntry& entry) {
    if (json_ && follow_) {
      console.out << json_line(json_of(entry)) << '\n' << std::flush;
    } else if (json_) {
      acknowledged_.push_back(json_of(entry));
    } else {
      console.out << fmt::format("acknowledged: {}, ResultId {}{}\n", entry.folder, entry.result_id,
                                 entry.sends > 1 ? ", sent before" : "")
                  << std::flush;
    }
  };
  const auto skipped = [&](const SkippedRun& run) {
    skipped_.push_back(hal::json_object({{"folder", run.folder}, {"reason", run.why}}));
    console.err << "rvbench: warning: not sent: " << run.folder << ": " << run.why << '\n';
  };
  const auto link = [&](const std::string& how) {
    if (follow_) console.err << "rvbench publish: " << how << std::endl;
  };
  Publisher publisher(out_, broker, outbox, {acknowledged, skipped, link});
  Status status = Done{};
  if (follow_) {
    publisher.follow(signals.token());
  } else {
    status = publisher.publish(signals.token());
  }
  if (follow_) return exit_codes::done;
  Ending ending{skipped_.empty() ? Outcome::pass : Outcome::invalid, ErrorKind::none, ""};
  if (!status) ending = {Outcome::error, ErrorKind::device_lost, status.error().where};
  if (signals.token().stop_requested()) ending = {Outcome::aborted, ErrorKind::none, "interrupted"};
  return end(console, broker, outbox, ending);
}

std::string PublishCommand::waiting(std::size_t left) const {
  if (left == 0) return "nothing is left to be sent";
  return fmt::format("{} in {}, to be sent the next time",
                     left == 1 ? "1 result waits" : fmt::format("{} results wait", left),
                     (std::filesystem::path(out_) / outbox_name).string());
}

// Also where not all was sent: what has been acknowledged is not told again.
int PublishCommand::end(Console& console, const Broker& broker, const Outbox& outbox,
                        const Ending& ending) const {
  const Result<std::size_t> left = outbox.left();
  if (!ending.reason.empty()) {
    console.err << "rvbench: publish: " << ending.reason
                << (left ? "; " + waiting(left.value()) : "") << '\n';
  }
  if (json_) {
    Json told = hal::json_object({{"broker", broker.address()},
                                  {"topic", broker.topic},
                                  {"acknowledged", acknowledged_},
                                  {"left", left ? Json(left.value()) : Json()},
                                  {"skipped", skipped_}});
    if (!ending.reason.empty()) {  // as of any command that was refused
      told["verdict"] = nullptr;
      told["reason"] = ending.reason;
      told["error_kind"] = to_string(ending.error_kind);
    }
    told["exit_code"] = exit_code(ending);
    console.out << json_text(told);
  }
  return exit_code(ending);
}

}  // namespace

std::unique_ptr<Command> make_publish_command() { return std::make_unique<PublishCommand>(); }

}  // namespace rvbench::bench
