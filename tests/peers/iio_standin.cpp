// iio_standin PORT RATE CHANNELS [FORMAT]: Debian's own iiod over a make-believe device. In a mount
// namespace of its own, plain files stand for the kernel's attributes and a pipe for its buffer;
// iiod and libiio are those of the distribution. Needs root. Says "serving at PORT" once it does.
//
// Sample of scan n in channel c: (n modulo 65536) times 32 plus c; scale 0.25. FORMAT as Linux
// writes it: le:s32/32>>0, or be:s24/32>>8 with a byte behind each sample that is none of it.
// SIGUSR1: the device falls silent, or goes on. SIGUSR2: iiod is killed.
#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/loopback.hpp"

namespace {

using namespace rvbench;
namespace fs = std::filesystem;

const fs::path device = "/sys/bus/iio/devices/iio:device0";
const char* const buffer_node = "/dev/iio:device0";

volatile sig_atomic_t is_silent = 0, kill_iiod = 0, is_over = 0;

[[noreturn]] void refuse(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text << '\n';
}

void mount_here(const char* from, const fs::path& to, const char* type, unsigned long flags) {
  if (::mount(from, to.c_str(), type, flags, nullptr) != 0) refuse("mount " + to.string());
}

// /sys/bus and /dev of this process and its children only.
void hide_the_real_ones() {
  if (::unshare(CLONE_NEWNS) != 0) refuse("unshare (is this root?)");
  mount_here("none", "/", nullptr, MS_REC | MS_PRIVATE);
  mount_here("bus", "/sys/bus", "tmpfs", 0);
  const fs::path dev = "/sys/bus/dev";
  fs::create_directory(dev);
  mount_here("dev", dev, "tmpfs", 0);
  for (const char* node : {"null", "zero", "random", "urandom"}) {
    std::ofstream(dev / node).flush();
    mount_here((fs::path("/dev") / node).c_str(), dev / node, nullptr, MS_BIND);
  }
  mount_here(dev.c_str(), "/dev", nullptr, MS_MOVE);
  fs::remove(dev);
}

void make_device(const std::string& rate, int channels, const std::string& format) {
  put(device / "name", "standin");
  put(device / "sampling_frequency", rate);
  for (int i = 0; i < channels; ++i) {
    const std::string input = "in_voltage" + std::to_string(i);
    put(device / (input + "_raw"), "0");
    put(device / (input + "_scale"), "0.25");
    put(device / "scan_elements" / (input + "_en"), "0");
    put(device / "scan_elements" / (input + "_index"), std::to_string(i));
    put(device / "scan_elements" / (input + "_type"), format);
  }
  put(device / "buffer/enable", "0");
  put(device / "buffer/length", "4096");
  put(device / "buffer/watermark", "1");
  if (::mkfifo(buffer_node, 0600) != 0) refuse("mkfifo");
}

pid_t start_iiod(const char* port) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::execlp("iiod", "iiod", "-p", port, nullptr);
  std::perror("iiod");
  ::_exit(127);
}

// What the kernel would do: scans of the enabled channels at their rate, in a buffer of as many as
// libiio asked for; those that find it full are lost. The pipe adds 1 MB to it.
class Feeder {
 public:
  Feeder(double rate_Hz, int channels, bool is_be_24)
      : rate_Hz_(rate_Hz),
        channels_(channels),
        is_be_24_(is_be_24),
        fifo_(::open(buffer_node, O_RDWR | O_NONBLOCK)) {
    (void)::fcntl(fifo_, F_SETPIPE_SZ, 1 << 20);
  }

  void tick() {
    const bool is_enabled = reads_one(device / "buffer/enable") && is_silent == 0;
    const auto now = std::chrono::steady_clock::now();
    if (is_enabled && !was_enabled_) start(now);
    was_enabled_ = is_enabled;
    if (!is_enabled) return;
    const double passed_s = std::chrono::duration<double>(now - started_).count();
    for (const long due = long(passed_s * rate_Hz_); made_ < due;) {
      const long count = std::min(due - made_, 512L);
      feed(count);
      made_ += count;
    }
  }

  long lost() const { return lost_; }

 private:
  static bool reads_one(const fs::path& file) {
    std::ifstream in(file);
    return in.get() == '1';
  }

  void start(std::chrono::steady_clock::time_point now) {
    started_ = now;
    made_ = 0;
    std::vector<char> old(1 << 16);
    while (::read(fifo_, old.data(), old.size()) > 0) continue;
    waiting_.clear();
    std::ifstream(device / "buffer/length") >> buffer_scans_;
    enabled_.clear();
    for (int i = 0; i < channels_; ++i) {
      const std::string input = "in_voltage" + std::to_string(i) + "_en";
      if (reads_one(device / "scan_elements" / input)) enabled_.push_back(i);
    }
  }

  void feed(long count) {
    for (long scan = made_; scan < made_ + count; ++scan) {
      if (waiting_.size() >= 4 * enabled_.size() * buffer_scans_) {
        ++lost_;
        continue;
      }
      for (const int channel : enabled_) append(std::uint32_t(scan % 65536 * 32 + channel));
    }
    const ssize_t sent = ::write(fifo_, waiting_.data(), waiting_.size());
    if (sent > 0) waiting_.erase(waiting_.begin(), waiting_.begin() + sent);
  }

  void append(std::uint32_t sample) {
    const std::uint32_t bits = is_be_24_ ? sample << 8U | 0x5AU : sample;
    for (unsigned byte = 0; byte < 4; ++byte) {
      waiting_.push_back(char(bits >> 8U * (is_be_24_ ? 3 - byte : byte) & 0xFFU));
    }
  }

  const double rate_Hz_;
  const int channels_;
  const bool is_be_24_;
  const int fifo_;
  bool was_enabled_ = false;
  std::chrono::steady_clock::time_point started_;
  long made_ = 0, lost_ = 0;
  std::vector<int> enabled_;
  std::size_t buffer_scans_ = 0;
  std::vector<char> waiting_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "usage: iio_standin PORT RATE CHANNELS [FORMAT]\n");
    return 2;
  }
  ::signal(SIGUSR1, [](int) { is_silent = !is_silent; });
  ::signal(SIGUSR2, [](int) { kill_iiod = 1; });
  ::signal(SIGTERM, [](int) { is_over = 1; });
  try {
    // A converter goes on whatever else its computer does. Without the right to that it may lose.
    const sched_param first{.sched_priority = 1};
    (void)::sched_setscheduler(0, SCHED_RR, &first);
    const std::string format = argc == 5 ? argv[4] : "le:s32/32>>0";
    hide_the_real_ones();
    make_device(argv[2], std::stoi(argv[3]), format);
    Feeder feeder(std::stod(argv[2]), std::stoi(argv[3]), format == "be:s24/32>>8");
    const pid_t iiod = start_iiod(argv[1]);
    bool has_told = false;
    while (is_over == 0) {
      feeder.tick();
      if (!has_told && test::connected_to(std::uint16_t(std::stoi(argv[1])))) {
        fmt::print(stderr, "serving at {}\n", argv[1]);
        has_told = true;
      }
      if (kill_iiod != 0) ::kill(iiod, SIGKILL);
      if (::waitpid(iiod, nullptr, WNOHANG) == iiod) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(iiod, SIGKILL);
    fmt::print(stderr, "{} scans lost\n", feeder.lost());
  } catch (const std::exception& error) {
    fmt::print(stderr, "iio_standin: {}\n", error.what());
    return 1;
  }
  return 0;
}
