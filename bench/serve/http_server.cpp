#include "bench/serve/http_server.hpp"

#include <httplib.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <thread>

#include "bench/lower_case.hpp"
#include "bench/serve/timed_stream.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t longest_target = 1024;
constexpr int low_priority = 10;

thread_local bool is_worker = false;

// So many workers as connections; what comes beyond is answered by who accepts them, at once.
class Workers final : public httplib::TaskQueue {
 public:
  explicit Workers(std::size_t most) : most_(most), pool_(most) {}
  void enqueue(std::function<void()> serve) override {
    if (busy_ >= most_) return serve();
    ++busy_;
    pool_.enqueue([this, serve = std::move(serve)] {
      // Of this thread alone. It stays an ordinary one where that fails.
      if (!is_worker) ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), low_priority);
      is_worker = true;
      serve();
      --busy_;
    });
  }
  void shutdown() override { pool_.shutdown(); }

 private:
  const std::size_t most_;
  std::atomic<std::size_t> busy_ = 0;
  httplib::ThreadPool pool_;
};

HttpRequest plain(const httplib::Request& from) {
  HttpRequest request{from.method, from.path};
  for (const auto& [name, value] : from.headers) request.headers.emplace(lower_case(name), value);
  for (const auto& [name, value] : from.params) request.query.emplace(name, value);
  request.body = from.body;
  request.address = from.remote_addr;
  return request;
}

// What no client of ours sends, and what the library would make too much of.
std::optional<HttpAnswer> refused_form(const httplib::Request& request, const HttpLimits& limits) {
  if (request.method != "GET" && request.method != "HEAD" && request.method != "POST") {
    return refusal(405, "method");
  }
  if (request.target.size() > longest_target) return refusal(414, "target_too_long");
  if (request.has_header("Range")) return refusal(416, "ranges");
  for (const char* name : {"Host", "Content-Length", "Content-Type", "Cookie", "Origin"}) {
    if (request.get_header_value_count(name) > 1) return refusal(400, "header_twice");
  }
  for (const auto& [name, value] : request.params) {
    const bool is_cut = value.find('\0') != std::string::npos;  // where others end a text
    if (is_cut || request.params.count(name) > 1) return wrong_field(name);
  }
  const bool is_post = request.method == "POST";
  const bool has_length = request.has_header("Content-Length");
  if (is_post && (request.has_header("Transfer-Encoding") || !has_length)) {
    return refusal(411, "length_required");
  }
  const std::string length = has_length ? request.get_header_value("Content-Length") : "0";
  std::size_t bytes = 0;
  const auto [stop, error] = std::from_chars(length.data(), length.data() + length.size(), bytes);
  if (error == std::errc::result_out_of_range || bytes > limits.body_bytes) {
    return refusal(413, "body_too_large");
  }
  if (error != std::errc() || stop != length.data() + length.size()) {
    return refusal(400, "content_length");
  }
  if (!is_post) return std::nullopt;
  const std::string type = request.get_header_value("Content-Type");
  if (request.has_header("Content-Encoding") ||
      lower_case(type.substr(0, type.find(';'))) != "application/json") {
    return refusal(415, "expected_json");
  }
  return std::nullopt;
}

// Nothing from elsewhere, in nobody's frame, and nothing kept. An answer may state its own policy.
const std::vector<std::pair<std::string, std::string>>& common_headers() {
  static const std::vector<std::pair<std::string, std::string>> headers{
      {"Content-Security-Policy",
       "default-src 'self'; object-src 'none'; base-uri 'none'; form-action 'self'; "
       "frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Permissions-Policy", "camera=(), geolocation=(), microphone=()"},
      {"Cache-Control", "no-store"}};
  return headers;
}

void fill(httplib::Response& response, HttpAnswer answer) {
  response.status = answer.status;
  for (const auto& [name, value] : common_headers()) {
    const auto is_stated = [&name = name](const auto& own) { return own.first == name; };
    if (std::ranges::none_of(answer.headers, is_stated)) response.set_header(name, value);
  }
  for (const auto& [name, value] : answer.headers) response.set_header(name, value);
  if (!answer.part) return response.set_content(answer.body, answer.type);
  response.set_chunked_content_provider(answer.type, [part = std::move(answer.part)](
                                                         std::size_t, httplib::DataSink& sink) {
    return part([&sink](const std::string& text) { return sink.write(text.data(), text.size()); });
  });
}

}  // namespace

class HttpServer::Impl final : public httplib::Server {
 public:
  Impl(HttpLimits limits, HttpGate gate, HttpHandler handler)
      : limits_(limits), gate_(std::move(gate)), handler_(std::move(handler)) {
    new_task_queue = [this] { return new Workers(limits_.connections); };
    // Not SO_REUSEPORT, with which a second server would share the port unseen.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      (void)::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    set_payload_max_length(limits_.body_bytes);
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      auto refused = refused_form(request, limits_);
      if (!refused) refused = gate_(plain(request));
      if (!refused) return HandlerResponse::Unhandled;
      fill(response, std::move(*refused));
      return HandlerResponse::Handled;
    });
    const auto answer = [this](const httplib::Request& request, httplib::Response& response) {
      fill(response, handler_(plain(request)));
    };
    Get(".*", answer);
    Post(".*", answer);
    set_exception_handler([](const httplib::Request&, httplib::Response& response,
                             const std::exception_ptr&) {
      fill(response, refusal(500, "internal_error"));  // what it was is nobody's business out there
    });
    set_error_handler([](const httplib::Request&, httplib::Response& response) {
      if (response.body.empty()) fill(response, refusal(response.status, "bad_request"));
    });
  }

  std::atomic<bool> has_ended = false;

 private:
  bool process_and_close_socket(socket_t socket) override {
    TimedStream stream(socket, limits_);
    const int yes = 1;
    (void)::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    if (!is_worker) {
      static const std::string busy =
          "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 1\r\nContent-Length: 0\r\n"
          "Connection: close\r\n\r\n";
      (void)::send(socket, busy.data(), busy.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      ::close(socket);
      return false;
    }
    bool is_closed = false;
    const bool done = process_request(stream, true, is_closed, [](httplib::Request&) {});
    close_gently(socket);
    return done;
  }

  const HttpLimits limits_;
  const HttpGate gate_;
  const HttpHandler handler_;
};

HttpServer::HttpServer(HttpLimits limits, HttpGate gate, HttpHandler handler)
    : impl_(std::make_unique<Impl>(limits, std::move(gate), std::move(handler))) {}
HttpServer::~HttpServer() = default;

int HttpServer::bind(const std::string& address, int port) {
  if (port == 0) return std::max(0, impl_->bind_to_any_port(address));
  return impl_->bind_to_port(address, port) ? port : 0;
}

void HttpServer::serve() {
  impl_->listen_after_bind();
  impl_->has_ended = true;
}

// The library forgets a stop that comes before it listens.
void HttpServer::stop() {
  while (!impl_->is_running() && !impl_->has_ended) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  impl_->stop();
}

}  // namespace rvbench::bench
