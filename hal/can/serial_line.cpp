#include "hal/can/serial_line.hpp"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>

namespace rvbench::hal {
namespace {

constexpr std::size_t most_bytes = 65536;

const std::map<int, speed_t>& speeds() {
  static const std::map<int, speed_t> known{
      {9600, B9600},       {19200, B19200},     {38400, B38400},    {57600, B57600},
      {115200, B115200},   {230400, B230400},   {460800, B460800},  {921600, B921600},
      {1000000, B1000000}, {2000000, B2000000}, {3000000, B3000000}};
  return known;
}

IoError failure(const std::string& operation, int error) {
  return {IoErrc::disconnected, operation + " (" + std::strerror(error) + ")"};
}

}  // namespace

bool SerialLine::knows_baud(int baud) { return speeds().contains(baud); }

Status SerialLine::open(const std::string& device, int baud) {
  close();
  file_ = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) return failure("open", errno);
  termios settings{};
  const speed_t speed = speeds().at(baud);
  int error = 0;
  if (::tcgetattr(file_, &settings) != 0) {
    error = errno;
  } else {
    ::cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
    if (::cfsetspeed(&settings, speed) != 0 || ::tcsetattr(file_, TCSANOW, &settings) != 0 ||
        ::tcflush(file_, TCIOFLUSH) != 0) {
      error = errno;
    }
  }
  if (error == 0) return Done{};
  close();
  return failure("open: set the line", error);
}

void SerialLine::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

Status SerialLine::write(std::string_view bytes) {
  const auto written = ::write(file_, bytes.data(), bytes.size());
  if (written == static_cast<ssize_t>(bytes.size())) return Done{};
  return failure("write", written < 0 ? errno : EAGAIN);
}

Result<std::string> SerialLine::read() {
  std::string bytes;
  std::array<char, 4096> chunk{};
  while (bytes.size() < most_bytes) {
    const auto count = ::read(file_, chunk.data(), chunk.size());
    if (count > 0) {
      bytes.append(chunk.data(), static_cast<std::size_t>(count));
      continue;
    }
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) break;
    // What came before the line hung up is still good; the next call tells.
    if (bytes.empty()) return failure("read: the line hung up", count < 0 ? errno : EIO);
    break;
  }
  return bytes;
}

void SerialLine::wait(std::chrono::milliseconds longest) const {
  pollfd line{file_, POLLIN, 0};
  (void)::poll(&line, 1, std::max(0, static_cast<int>(longest.count())));  // below 0 is forever
}

}  // namespace rvbench::hal
