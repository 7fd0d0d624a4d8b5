#include "tests/serve/served_station.hpp"

#include <fmt/format.h>

#include <map>

#include "bench/serve/tokens.hpp"
#include "bench/text_file.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench::test {
namespace {

std::filesystem::path written(const ScratchFolder& scratch, const std::string& keys,
                              const std::string& rig) {
  // Each takes a tenth of a second to make: once for all tests.
  static const std::map<std::string, std::string> hashes{
      {"vera", bench::hash_of_token(token_of("vera"))},
      {"otto", bench::hash_of_token(token_of("otto"))},
      {"anna", bench::hash_of_token(token_of("anna"))}};
  const auto user = [](const char* name, const char* role) {
    return fmt::format(R"({{"name": "{}", "role": "{}", "token_hash": "{}"}})", name, role,
                       hashes.at(name));
  };
  bench::write_file(
      scratch.path() / "station.json",
      fmt::format(R"({{"station": "EOL 3", "rig": "{}", {}, "users": [{}, {}, {}]}})", rig, keys,
                  user("vera", "viewer"), user("otto", "operator"), user("anna", "engineer")));
  return scratch.path();
}

}  // namespace

std::string quick_at_top_speed() {
  const auto quick = bench::read_file(source_dir() / "sequences/plans/quick.json");
  auto plan = nlohmann::ordered_json::parse(quick.value());
  plan["main"][0]["speeds_rpm"] = {1815};
  return plan.dump(2);
}

std::string token_of(const std::string& user) { return user + "." + std::string(32, 'a'); }

ServedStation::ServedStation(const ScratchFolder& scratch, const std::string& keys,
                             const std::string& rig)
    : program_(written(scratch, keys, rig),
               {rvbench_path(), "serve", "--station", "station.json", "--port", "0"}) {
  const std::string before = "http://127.0.0.1:";
  if (!program_.says(before) || !program_.says("/\n")) {
    throw std::runtime_error("no station: " + program_.said());
  }
  const std::string said = program_.said();
  port_ = static_cast<std::uint16_t>(std::stoi(said.substr(said.find(before) + before.size())));
}

HttpHeaders ServedStation::cookie() const {
  return {{"Cookie", cookie_.empty() ? "" : "rvbench_session=" + cookie_}};
}

HttpReply ServedStation::get(const std::string& target) {
  return ask_server(port_, http_request("GET", target, port_, cookie()));
}

HttpReply ServedStation::post(const std::string& target, const std::string& body,
                              const HttpHeaders& headers) {
  HttpHeaders all = cookie();
  all["X-CSRF-Token"] = csrf_;
  for (const auto& [name, value] : headers) all[name] = value;
  return ask_server(port_, http_request("POST", target, port_, all, body));
}

HttpReply ServedStation::log_in(const std::string& user) {
  forget_login();
  HttpReply reply = post("/api/login", fmt::format(R"({{"token":"{}"}})", token_of(user)));
  const std::string before = "rvbench_session=";
  const std::size_t at = reply.head.find(before);
  if (reply.status != 200 || at == std::string::npos) return reply;
  cookie_ = reply.head.substr(at + before.size(), 64);
  csrf_ = nlohmann::json::parse(reply.body).at("csrf");
  return reply;
}

Socket ServedStation::listen() {
  Socket socket = connected_to(port_);
  (void)send_all(socket, http_request("GET", "/api/events", port_, cookie()));
  return socket;
}

nlohmann::json last_event(const std::string& stream, const std::string& name) {
  const std::string before = "event: " + name + "\ndata: ";
  const std::size_t at = stream.rfind(before);
  if (at == std::string::npos) return {};
  const std::size_t data = at + before.size();
  return nlohmann::json::parse(stream.substr(data, stream.find('\n', data) - data), nullptr, false);
}

}  // namespace rvbench::test
