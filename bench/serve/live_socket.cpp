#include "bench/serve/live_socket.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace rvbench::bench {
namespace {

constexpr std::size_t longest_letter = 100'000;

std::optional<sockaddr_un> address_of(int folder, const std::string& name) {
  const std::string path = fmt::format("/proc/self/fd/{}/{}", folder, name);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) return std::nullopt;
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw std::system_error(errno, std::generic_category(), file.string());
}

}  // namespace

LiveSocket::LiveSocket(int socket, int folder, std::string name)
    : socket_(socket), folder_(folder), name_(std::move(name)) {}

LiveSocket LiveSocket::to(const std::filesystem::path& file) {
  const std::filesystem::path parent = std::filesystem::absolute(file).parent_path();
  const int folder = ::open(parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) refuse(parent);
  LiveSocket made(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0), folder,
                  file.filename().string());
  if (made.socket_ < 0) refuse(file);
  return made;
}

LiveSocket LiveSocket::open(const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  LiveSocket made = to(file);
  const auto address = address_of(made.folder_, made.name_);
  if (!address) {
    errno = ENAMETOOLONG;
    refuse(file);
  }
  // The mode of the socket is that of the file that bind() makes.
  (void)::fchmod(made.socket_, 0600);
  if (::bind(made.socket_, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0) {
    refuse(file);
  }
  return made;
}

LiveSocket::LiveSocket(LiveSocket&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      folder_(std::exchange(other.folder_, -1)),
      name_(std::move(other.name_)) {}

LiveSocket::~LiveSocket() {
  if (socket_ >= 0) ::close(socket_);
  if (folder_ >= 0) ::close(folder_);
}

bool LiveSocket::send(const std::string& letter) noexcept {
  const auto address = address_of(folder_, name_);
  if (!address || letter.size() > longest_letter) return false;
  return ::sendto(socket_, letter.data(), letter.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                  reinterpret_cast<const sockaddr*>(&*address),
                  sizeof *address) == static_cast<ssize_t>(letter.size());
}

std::optional<std::string> LiveSocket::next() {
  std::string letter(longest_letter, '\0');
  const ssize_t got = ::recv(socket_, letter.data(), letter.size(), MSG_DONTWAIT);
  if (got < 0) return std::nullopt;
  letter.resize(static_cast<std::size_t>(got));
  return letter;
}

}  // namespace rvbench::bench
