#include "bench/network_address.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <memory>

namespace rvbench::bench {
namespace {

std::string number_of(const addrinfo& at) {
  std::array<char, NI_MAXHOST> text{};
  const int failed = ::getnameinfo(at.ai_addr, at.ai_addrlen, text.data(), text.size(), nullptr, 0,
                                   NI_NUMERICHOST);
  return failed != 0 ? "" : text.data();
}

// One server listens on both protocols of a computer as a rule, under one port.
std::string without_protocol(const std::string& number) {
  const std::string mapped = "::ffff:";
  if (number == "::1") return "127.0.0.1";
  return number.starts_with(mapped) ? number.substr(mapped.size()) : number;
}

}  // namespace

std::vector<std::string> addresses_of(const std::string& host) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;  // each once
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0) return {host};
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owned(found, &::freeaddrinfo);
  std::vector<std::string> numbers;
  for (const addrinfo* at = found; at != nullptr; at = at->ai_next) {
    const std::string number = without_protocol(number_of(*at));
    if (!number.empty()) numbers.push_back(number);
  }
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers.empty() ? std::vector{host} : numbers;
}

}  // namespace rvbench::bench
