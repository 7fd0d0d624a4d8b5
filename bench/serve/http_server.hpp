#pragma once

#include <memory>
#include <string>

#include "bench/serve/http.hpp"

namespace rvbench::bench {

/// HTTP/1.1, one request a connection: none that lingers, none to be smuggled behind another.
///
/// Refused before the handler is asked: other methods than GET, HEAD and POST (405), a target of
/// more than 1024 bytes (414), ranges (416), a POST that is not JSON (415), states no length (411),
/// or too great a one (413), and headers that must not come twice (400).
///
/// Order    bind() → serve() → stop()
/// Threads  serve() returns after stop(), which any thread may call; gate and handler are called
///          from several, each of them at a low priority: neither holds up who measures
class HttpServer {
 public:
  HttpServer(HttpLimits limits, HttpGate gate, HttpHandler handler);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// @param port  0: any that is free
  /// @return the port; 0 if there is none to be had
  int bind(const std::string& address, int port);
  void serve();
  void stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rvbench::bench
