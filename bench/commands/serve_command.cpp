#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <system_error>
#include <thread>

#include "bench/commands/commands.hpp"
#include "bench/fault_lines.hpp"
#include "bench/file_lock.hpp"
#include "bench/json_text.hpp"
#include "bench/results/audit_index.hpp"
#include "bench/serve/http_server.hpp"
#include "bench/serve/station_api.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/text_file.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

constexpr std::chrono::milliseconds tick_every{50};

// What a station is called by on its own computer, and what its file adds.
std::vector<std::string> hosts_of(const StationFile& station) {
  std::vector<std::string> hosts = station.hosts;
  hosts.insert(hosts.end(), {"localhost", "127.0.0.1", "[::1]"});
  return hosts;
}

class ServeCommand final : public Command {
 public:
  std::string name() const override { return "serve"; }
  std::string summary() const override { return "the operator's page of an end-of-line station"; }
  std::string examples() const override {
    return "  rvbench serve                                  a simulated station, to try\n"
           "  rvbench serve --make-token anna --role engineer\n"
           "  rvbench serve --station station.json --out runs\n"
           "  rvbench check runs/.station/audit.jsonl        who did what: is it all there?\n"
           "Without --station it runs the plan quick in simulation, and prints a token to log in\n"
           "with. SIGTERM and Ctrl-C end the page, not a test: that goes on to its own end.\n";
  }
  std::vector<Option> options() override {
    return {
        {"--station", "station file", &station_},
        {"--out", "folder of run folders; default: that of the station file, or runs", &out_},
        {"--port",
         "to listen at, 0 for any that is free; default: the station file's, or 8080",
         &port_,
         false,
         {},
         65535},
        {"--bind", "address to listen at; any but this computer's own must be the station file's",
         &bind_},
        {"--make-token", "print a token for this user, and the entry of the station file",
         &new_user_},
        {"--role",
         "of that user: viewer, operator or engineer; default: operator",
         &role_,
         false,
         {"viewer", "operator", "engineer"}}};
  }
  int run(Console& console) override;

 private:
  int print_token(Console& console) const;
  std::optional<StationFile> station(Console& console, int& refused);
  int serve(Console& console, const StationFile& file);

  std::string station_, out_, bind_, new_user_;
  std::string role_ = "operator";
  std::optional<std::uint64_t> port_;
};

int ServeCommand::print_token(Console& console) const {
  if (!is_user_name(new_user_)) {
    return refuse_usage(console, "serve: --make-token " + hal::in_quotes(new_user_) +
                                     ": expected letters, digits, '-' and '_', at most 32");
  }
  const std::string token = make_token(new_user_);
  const nlohmann::ordered_json entry = hal::json_object(
      {{"name", new_user_}, {"role", role_}, {"token_hash", hash_of_token(token)}});
  console.out << "Token, to be kept by " << new_user_ << " alone; it is not kept here:\n  " << token
              << "\nEntry for \"users\" of the station file:\n  " << json_line(entry) << '\n';
  return exit_codes::done;
}

// Of the file, or one to try with a token that is printed.
std::optional<StationFile> ServeCommand::station(Console& console, int& refused) {
  if (!station_.empty()) {
    auto read = read_station(station_);
    if (read.index() == 0) return std::get<0>(std::move(read));
    refused = refuse_file(console, station_, with_lines(station_, std::get<1>(read)));
    return std::nullopt;
  }
  StationFile trial;
  trial.name = "simulated station";
  trial.plan = "quick";
  trial.rig = "sim";
  const std::string token = make_token("trial");
  trial.users = {{"trial", Role::engineer, hash_of_token(token)}};
  console.err << "rvbench: serve: no --station: a simulated one; log in with\n  " << token << '\n';
  return trial;
}

int ServeCommand::run(Console& console) {
  if (!new_user_.empty()) return print_token(console);
  int refused = exit_codes::done;
  auto file = station(console, refused);
  if (!file) return refused;
  if (!out_.empty()) file->runs = out_;
  if (port_) file->port = static_cast<int>(*port_);
  if (!bind_.empty() && bind_ != file->bind && !is_loopback(bind_)) {
    return refuse_usage(console, "serve: --bind " + bind_ +
                                     ": others could reach the station there; if they shall, say "
                                     "\"bind\" and \"hosts\" in the station file");
  }
  if (!bind_.empty()) file->bind = bind_;
  try {
    return serve(console, *file);
  } catch (const std::system_error& error) {
    return refuse_usage(console, "serve: " + reason_of(error));
  }
}

void warn(Console& console, const std::string& text) {
  console.err << "rvbench: serve: warning: " << text << std::endl;
}

// The first line of every log: one that takes the place of another says so.
void begin_audit(Console& console, AuditLog& audit, const std::filesystem::path& file,
                 bool was_served) {
  if (!audit.is_new()) return;
  if (was_served) {
    warn(console, file.string() + ": the station was served before, its log is gone: begun anew");
  }
  const Status done = audit.add(
      {"", "", "begun", was_served ? R"("the station was served before, its log is gone")" : ""});
  if (!done) warn(console, done.error().where);
}

// The station and all that answers for it, in the order in which they need each other.
class Service {
 public:
  /// @throws std::system_error
  explicit Service(const StationFile& file)
      : file_(file), station_(file, program_, hub_), audit_(audit_log_of(file.runs)) {}

  Station& station() { return station_; }
  AuditLog& audit() { return audit_; }

  /// @return the port; 0 if it is not to be had
  int bind() {
    const int port = server_.bind(file_.bind, file_.port);
    if (port == 0) return 0;
    gate_.emplace(hosts_of(file_), port, sessions_);
    api_.emplace(station_, hub_, sessions_, *gate_, audit_, program_);
    return port;
  }

  void serve(const std::stop_token& stop) {
    std::thread serving([this] { server_.serve(); });
    while (!stop.stop_requested()) {
      station_.tick();
      std::this_thread::sleep_for(tick_every);
    }
    hub_.close();
    api_->end();
    server_.stop();
    serving.join();
  }

 private:
  const StationFile file_;
  const std::string program_ = std::filesystem::read_symlink("/proc/self/exe").string();
  EventHub hub_;
  Station station_;
  AuditLog audit_;
  Sessions sessions_;
  std::optional<Gate> gate_;
  std::optional<StationApi> api_;
  HttpServer server_{{.connections = static_cast<std::size_t>(file_.most_connections),
                      .body_bytes = static_cast<std::size_t>(file_.most_body_bytes)},
                     [this](const HttpRequest& request) { return gate_->refused(request); },
                     [this](const HttpRequest& request) { return api_->answer(request); }};
};

void warn_of_log(Console& console, const std::filesystem::path& log) {
  const auto checked = check_audit(log);
  if (!checked || checked->broken_line == 0) return;
  warn(console, fmt::format("{}:{}: {}", log.string(), checked->broken_line, checked->fault));
}

int ServeCommand::serve(Console& console, const StationFile& file) {
  const StopOnSignal signals;
  const std::filesystem::path keep = station_folder(file.runs);
  std::filesystem::create_directories(keep);
  const bool was_served = !std::filesystem::is_empty(keep);
  const auto alone = FileLock::take(keep / "serve.lock");
  if (!alone) {
    return refuse_usage(console,
                        "serve: another rvbench serves " + file.runs.string() + " already");
  }
  Service service(file);
  warn_of_log(console, audit_log_of(file.runs));
  begin_audit(console, service.audit(), audit_log_of(file.runs), was_served);
  const int port = service.bind();
  if (port == 0) {
    return refuse_usage(console, fmt::format("serve: port {} of {} is not to be had: another "
                                             "program has it, or it asks for more rights",
                                             file.port, file.bind));
  }
  if (!is_loopback(file.bind)) {
    warn(console, "other computers reach " + file.bind +
                      "; what they send can be read on its way unless a TLS proxy is before it");
  }
  const Station& station = service.station();
  if (station.is_running()) {
    console.err << "rvbench: serve: a test of " << station.serial() << " is running: found again\n";
  }
  const bool is_ipv6 = file.bind.find(':') != std::string::npos;
  console.err << fmt::format("rvbench: serve: {} at http://{}:{}/", file.name,
                             is_ipv6 ? "[" + file.bind + "]" : file.bind, port)
              << std::endl;
  service.serve(signals.token());
  console.err << (station.is_running()
                      ? "rvbench: serve: ended; the test of " + station.serial() +
                            " goes on, and stops its shaft itself: serve finds it again\n"
                      : "rvbench: serve: ended\n");
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_serve_command() { return std::make_unique<ServeCommand>(); }

}  // namespace rvbench::bench
