#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace rvbench::bench {

/// A mailbox between a run and whoever watches it: a UNIX datagram socket. Who sends never waits:
/// what the mailbox has no room for is lost, and so is all that is sent while nobody has it open.
///
/// Limits   a letter of more than 100 000 bytes is not sent
/// Threads  one caller at a time
class LiveSocket {
 public:
  /// A mailbox of that name, in place of what was there. Only this user may send to it.
  /// @throws std::system_error
  static LiveSocket open(const std::filesystem::path& file);
  /// To send to a mailbox that may come, go and come again. @throws std::system_error: no socket
  static LiveSocket to(const std::filesystem::path& file);

  LiveSocket(LiveSocket&& other) noexcept;
  LiveSocket& operator=(LiveSocket&&) = delete;
  ~LiveSocket();

  bool send(const std::string& letter) noexcept;  ///< false: it was lost
  std::optional<std::string> next();              ///< a letter that has come; never waits

 private:
  LiveSocket(int socket, int folder, std::string name);

  int socket_;
  int folder_;  // a path may be longer than the address of a socket: it is named from here
  std::string name_;
};

}  // namespace rvbench::bench
