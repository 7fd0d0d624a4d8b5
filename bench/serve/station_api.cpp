#include "bench/serve/station_api.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/json_text.hpp"
#include "bench/serve/event_stream.hpp"
#include "bench/serve/page_file.hpp"
#include "bench/sha256.hpp"

namespace rvbench::bench {
namespace {

HttpAnswer not_logged(const IoError& why) {
  return json_answer(503, {{"error", "audit"}, {"reason", why.where}});
}

HttpAnswer conflict(const std::string& word) { return refusal(409, word); }

std::string cookie_of(const std::string& value, int seconds) {
  return std::string(session_cookie) + "=" + value +
         "; Path=/; HttpOnly; SameSite=Strict; Max-Age=" + std::to_string(seconds);
}

// Nobody's secrets in the log.
std::string without_secrets(const nlohmann::json& body) {
  nlohmann::json kept = body;
  kept.erase("token");
  return kept.empty() ? "" : ascii_json_line(kept);
}

nlohmann::json json_of(const Session& session) {
  return {{"name", session.user}, {"role", to_string(session.role)}, {"csrf", session.csrf}};
}

}  // namespace

bool is_from_afar(const HttpRequest& request) {
  for (const char* name : {"forwarded", "x-forwarded-for", "via", "x-real-ip"}) {
    if (request.headers.contains(name)) return true;
  }
  // A proxy that hands on no such header must hand on the name it is called by, or set its own: an
  // asker from afar can call it by this computer's.
  return !is_loopback(request.address) || !is_loopback(host_and_port(request.header("host")).host);
}

StationApi::StationApi(Station& station, EventHub& hub, Sessions& sessions, const Gate& gate,
                       AuditLog& audit, std::string program)
    : station_(station),
      hub_(hub),
      sessions_(sessions),
      gate_(gate),
      audit_(audit),
      program_(std::move(program)),
      nobody_(hash_of_token(random_hex(16))) {}

const std::vector<StationApi::Route>& StationApi::routes() {
  static const std::vector<Route> all{
      {"POST", "/api/logout", Role::viewer, &StationApi::log_out},
      {"GET", "/api/session", Role::viewer, &StationApi::session},
      {"GET", "/api/events", Role::viewer, &StationApi::events},
      {"POST", "/api/scan", Role::operating, &StationApi::scan, {{"text", FieldKind::text}}},
      {"POST",
       "/api/start",
       Role::operating,
       &StationApi::start,
       {{"serial", FieldKind::text}, {"retest", FieldKind::truth}}},
      {"POST", "/api/stop", Role::operating, &StationApi::stop},
      {"POST", "/api/clear", Role::operating, &StationApi::clear},
      {"GET", "/api/history", Role::viewer, &StationApi::history},
      {"GET", "/api/trend", Role::viewer, &StationApi::trend},
      {"POST",
       "/api/rejudge",
       Role::engineer,
       &StationApi::rejudge,
       {{"run", FieldKind::text}, {"limits", FieldKind::version}}},
      {"GET", "/api/limits", Role::viewer, &StationApi::limits},
      {"POST",
       "/api/limits/propose",
       Role::engineer,
       &StationApi::propose_limits,
       {{"limits", FieldKind::object},
        {"version", FieldKind::version},
        {"plan", FieldKind::text},
        {"per_point", FieldKind::truth}}},
      {"POST",
       "/api/limits/approve",
       Role::engineer,
       &StationApi::approve_limits,
       {{"version", FieldKind::version}}},
      {"POST",
       "/api/limits/activate",
       Role::engineer,
       &StationApi::activate_limits,
       {{"version", FieldKind::version}}},
      {"GET", "/api/audit", Role::engineer, &StationApi::audit}};
  return all;
}

HttpAnswer StationApi::answer(const HttpRequest& request) {
  const std::string method = request.method == "HEAD" ? "GET" : request.method;
  if (!request.path.starts_with("/api/")) {
    return method == "GET" ? page_file(request.path) : refusal(405, "method");
  }
  const auto body = fields_of(request.body);
  if (!body.is_object()) return refusal(400, "malformed");
  if (request.path == "/api/login") {
    return method == "POST" ? log_in(request, body) : refusal(405, "method");
  }
  const auto session = gate_.session_of(request);
  if (!session) return refusal(401, "login");
  if (request.path.starts_with("/api/runs/") && method == "GET") return run_file(request);
  const auto is_asked = [&](const Route& route) { return route.path == request.path; };
  const auto route = std::ranges::find_if(routes(), is_asked);
  if (route == routes().end()) return refusal(404, "not_found");
  if (route->method != method) return refusal(405, "method");
  if (session->role < route->least) {
    if (method == "POST") {
      (void)log(request, session->user, "refused " + request.path.substr(5), R"("role")");
    }
    return refusal(403, "role");
  }
  if (const std::string field = misplaced_field(body, route->fields); !field.empty()) {
    return wrong_field(field);
  }
  return (this->*route->handle)({request, *session, body});
}

StationViewer StationApi::viewer(const Call& call) const {
  return {call.session.role, is_from_afar(call.request)};
}

Status StationApi::log(const HttpRequest& request, const std::string& user,
                       const std::string& action, const std::string& detail) {
  return audit_.add({user, request.address, action, detail});
}

HttpAnswer StationApi::logged(const Call& call, const std::string& action,
                              const std::function<HttpAnswer()>& act) {
  const Status done = log(call.request, call.session.user, action, without_secrets(call.body));
  if (!done) return not_logged(done.error());
  HttpAnswer answer = act();
  if (answer.status >= 400) {
    (void)log(call.request, call.session.user, "refused " + action, answer.body);
  }
  return answer;
}

HttpAnswer StationApi::log_in(const HttpRequest& request, const nlohmann::json& body) {
  const std::string token = text_at(body, "token");
  if (token.empty() || token.size() > 200) return refusal(400, "malformed");
  const auto& users = station_.file().users;
  const auto user = std::ranges::find(users, user_of_token(token), &StationUser::name);
  const std::lock_guard lock(login_mutex_);
  const std::string who = user == users.end() ? "" : user->name;
  const std::string name_there = who + "@" + request.address;
  // Of 128 random bits it tells no more than its slow hash, and its holder waits for no guesser.
  const std::string known = sha256_of_text(token);
  const bool was_right = right_tokens_.contains(known);
  if (!was_right && (of_user_.must_wait(name_there) || of_address_.must_wait(request.address))) {
    HttpAnswer answer = refusal(429, "too_many_attempts");
    answer.headers = {{"Retry-After", "1"}};
    return answer;
  }
  // As much work where there is no such user: time tells nobody which names there are.
  const bool is_right =
      was_right || matches(token, user == users.end() ? nobody_ : user->token_hash);
  if (!is_right || user == users.end()) {
    of_user_.add(name_there);
    of_address_.add(request.address);
    (void)log(request, who, "refused login", "");
    return refusal(401, "bad_token");
  }
  right_tokens_.insert(known);
  const Status done = log(request, who, "login", "");
  if (!done) return not_logged(done.error());
  const std::string cookie = sessions_.begin(user->name, user->role);
  HttpAnswer answer = json_answer(200, json_of(*sessions_.find(cookie)));
  answer.headers = {{"Set-Cookie", cookie_of(cookie, int(Sessions::longest_s))}};
  return answer;
}

HttpAnswer StationApi::log_out(const Call& call) {
  return logged(call, "logout", [&] {
    sessions_.end(cookie_in(call.request.header("cookie"), session_cookie));
    HttpAnswer answer = json_answer(200, nlohmann::json::object());
    answer.headers = {{"Set-Cookie", cookie_of("", 0)}};
    return answer;
  });
}

HttpAnswer StationApi::session(const Call& call) { return json_answer(200, json_of(call.session)); }

HttpAnswer StationApi::scan(const Call& call) {
  return logged(call, "scan", [&] {
    const std::string text = text_at(call.body, "text");
    const std::string fault = station_.scan(text);
    if (fault == "running") return conflict(fault);
    if (!fault.empty()) return json_answer(422, {{"error", fault}, {"text", scanned_serial(text)}});
    return HttpAnswer{.body = station_.state(viewer(call)) + "\n"};
  });
}

HttpAnswer StationApi::start(const Call& call) {
  return logged(call, "start", [&] {
    const std::string fault =
        station_.start(text_at(call.body, "serial"), flag_at(call.body, "retest"), viewer(call));
    if (!fault.empty()) return conflict(fault);
    return json_answer(202, nlohmann::json::object());
  });
}

// Before it is logged: no log is worth a shaft that goes on turning.
HttpAnswer StationApi::stop(const Call& call) {
  const std::string fault = station_.stop();
  const HttpAnswer answer =
      fault.empty() ? json_answer(202, nlohmann::json::object()) : conflict(fault);
  (void)log(call.request, call.session.user, fault.empty() ? "stop" : "refused stop", answer.body);
  return answer;
}

HttpAnswer StationApi::clear(const Call& call) {
  return logged(call, "clear", [&] {
    const std::string fault = station_.clear();
    if (!fault.empty()) return conflict(fault);
    return HttpAnswer{.body = station_.state(viewer(call)) + "\n"};
  });
}

// Half of all connections stay free for those who ask for something.
HttpAnswer StationApi::events(const Call& call) {
  const auto most = static_cast<std::size_t>(station_.file().most_connections) / 2;
  if (listeners_ >= most) return refusal(503, "too_many_listeners");
  const std::string cookie = cookie_in(call.request.header("cookie"), session_cookie);
  return event_stream(
      hub_, listeners_, [this, viewer = viewer(call)] { return station_.state(viewer); },
      [this, cookie] { return sessions_.find(cookie).has_value(); });
}

}  // namespace rvbench::bench
