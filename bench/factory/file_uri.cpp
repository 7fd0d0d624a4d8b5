#include "bench/factory/file_uri.hpp"

#include <fmt/format.h>

#include <string_view>

#include "bench/factory/host_name.hpp"

namespace rvbench::bench {
namespace {

bool is_unreserved(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("-._~/").find(c) != std::string_view::npos;
}

}  // namespace

std::string file_uri(const std::filesystem::path& file) {
  std::string uri = "file://" + host_name();
  for (const char c : std::filesystem::absolute(file).lexically_normal().string()) {
    uri += is_unreserved(c) ? std::string(1, c)
                            : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

}  // namespace rvbench::bench
