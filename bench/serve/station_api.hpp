#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "bench/serve/attempts.hpp"
#include "bench/serve/audit_log.hpp"
#include "bench/serve/gate.hpp"
#include "bench/serve/http.hpp"
#include "bench/serve/json_fields.hpp"
#include "bench/serve/station.hpp"

namespace rvbench::bench {

/// What the page and other programs may ask of a station: README, "The station", lists it.
///
/// Every call that changes something is in the audit log before it is done; where it cannot be
/// written, nothing is done (503 "audit").
///
/// Threads  any
class StationApi {
 public:
  /// All must outlive it. @param program  rvbench itself, for what its other commands answer
  StationApi(Station& station, EventHub& hub, Sessions& sessions, const Gate& gate, AuditLog& audit,
             std::string program);

  HttpAnswer answer(const HttpRequest& request);
  /// Answers what waits for other programs at once: the station ends.
  void end() { ending_.request_stop(); }

 private:
  struct Call {
    const HttpRequest& request;
    const Session& session;
    const nlohmann::json& body;
  };
  struct Route {
    std::string method, path;
    Role least;
    HttpAnswer (StationApi::*handle)(const Call&);
    Fields fields = {};  ///< of the body
  };
  static const std::vector<Route>& routes();

  HttpAnswer log_in(const HttpRequest& request, const nlohmann::json& body);
  HttpAnswer log_out(const Call& call);
  HttpAnswer session(const Call& call);
  HttpAnswer scan(const Call& call);
  HttpAnswer start(const Call& call);
  HttpAnswer stop(const Call& call);
  HttpAnswer clear(const Call& call);
  HttpAnswer events(const Call& call);
  HttpAnswer history(const Call& call);
  HttpAnswer trend(const Call& call);
  HttpAnswer rejudge(const Call& call);
  HttpAnswer limits(const Call& call);
  HttpAnswer propose_limits(const Call& call);
  HttpAnswer approve_limits(const Call& call);
  HttpAnswer activate_limits(const Call& call);
  HttpAnswer limits_step(const Call& call, const std::string& step);
  HttpAnswer audit(const Call& call);
  HttpAnswer run_file(const HttpRequest& request) const;

  /// Does it once it is in the log. @param act  returns "" or the word for why it was not done
  HttpAnswer logged(const Call& call, const std::string& action,
                    const std::function<HttpAnswer()>& act);
  Status log(const HttpRequest& request, const std::string& user, const std::string& action,
             const std::string& detail);
  HttpAnswer ask(std::vector<std::string> words, double longest_s = 20) const;
  HttpAnswer ask_long(std::vector<std::string> words) const;  ///< for minutes, or 503 "busy"
  StationViewer viewer(const Call& call) const;

  Station& station_;
  EventHub& hub_;
  Sessions& sessions_;
  const Gate& gate_;
  AuditLog& audit_;
  const std::string program_;
  const std::string nobody_;  // a hash that no token has, for names that nobody has

  std::mutex login_mutex_;  // one at a time: each takes 64 MiB
  FailedAttempts of_user_{5}, of_address_{30};
  std::set<std::string> right_tokens_;  // that somebody logged in with, by their SHA-256
  std::atomic<std::size_t> listeners_ = 0;
  mutable std::atomic<int> long_jobs_ = 0;
  std::stop_source ending_;
};

/// Whether a request comes from another computer, itself or through a proxy on this one.
bool is_from_afar(const HttpRequest& request);

}  // namespace rvbench::bench
