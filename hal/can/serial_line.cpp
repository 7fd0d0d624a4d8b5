#include "hal/can/serial_line.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/file.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <utility>

#include "hal/real_time.hpp"

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
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close();
    return IoError{IoErrc::disconnected, "open: another program has the line"};
  }
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
  if (error == 0 && (wake_ = ::eventfd(0, EFD_CLOEXEC)) < 0) error = errno;
  if (error != 0) {
    close();
    return failure("open: set the line", error);
  }
  waiting_.clear();
  error_ = 0;
  reader_.start([this](const std::stop_token& stop) { listen(stop); });
  return Done{};
}

void SerialLine::close() {
  reader_.request_stop();
  if (wake_ >= 0) (void)::eventfd_write(wake_, 1);
  reader_.stop();
  // What an adapter that hangs has not taken would hold close() up for half a minute.
  if (file_ >= 0) (void)::tcflush(file_, TCOFLUSH);
  for (int* file : {&file_, &wake_}) {
    if (*file >= 0) ::close(*file);
    *file = -1;
  }
}

Status SerialLine::write(std::string_view bytes) {
  const auto written = ::write(file_, bytes.data(), bytes.size());
  if (written == static_cast<ssize_t>(bytes.size())) return Done{};
  return failure("write", written < 0 ? errno : EAGAIN);
}

// While the reader has the lock nothing is there yet.
Result<std::string> SerialLine::read() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return std::string();
  // What came before the line hung up is still good; the next call tells.
  if (waiting_.empty() && error_ != 0) return failure("read: the line hung up", error_);
  if (const std::string_view thrown = reader_.thrown(); waiting_.empty() && !thrown.empty()) {
    return IoError{IoErrc::disconnected, "read: nobody listens: " + std::string(thrown)};
  }
  changed_.notify_all();  // there is room again
  return std::exchange(waiting_, {});
}

bool SerialLine::wait(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, longest, [this] {
    return !waiting_.empty() || error_ != 0 || !reader_.thrown().empty();
  });
}

// What nobody fetches stays in the line once there is enough of it.
void SerialLine::listen(const std::stop_token& stop) {
  (void)make_this_thread_urgent();  // so is who reads
  for (int error = 0; error == 0 && !stop.stop_requested();) {
    std::string bytes;
    if (!take(bytes, error)) continue;
    std::unique_lock lock(mutex_);
    waiting_ += bytes;
    error_ = error;
    changed_.notify_all();
    changed_.wait(lock, stop, [this] { return waiting_.size() < most_bytes; });
  }
}

// Waits for bytes, and takes them. @return false if there is no news
bool SerialLine::take(std::string& bytes, int& error) const {
  std::array<pollfd, 2> watched{{{file_, POLLIN, 0}, {wake_, POLLIN, 0}}};
  if (::poll(watched.data(), watched.size(), -1) < 0) return false;
  if (watched[1].revents != 0) return false;
  std::array<char, 4096> chunk{};
  const auto count = ::read(file_, chunk.data(), chunk.size());
  if (count > 0) {
    bytes.assign(chunk.data(), static_cast<std::size_t>(count));
    return true;
  }
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return false;
  error = count < 0 ? errno : EIO;
  return true;
}

}  // namespace rvbench::hal
