#pragma once

#include <sys/types.h>

#include <cstdio>
#include <mutex>
#include <string>

namespace rvbench::hal {

/// While it lives, what C code prints on `stderr` is kept and shown to nobody: libiio 0.24 has no
/// other way to tell why it makes no context. std::cerr keeps the stream that it began with.
///
/// Threads  any; one at a time listens, another waits for its end. What other threads print by way
///          of `stderr` meanwhile is taken for libiio's, and the stream that they print on is never
///          closed: one that has just fetched it may print a moment later
class CapturedComplaints {
 public:
  CapturedComplaints() : turn_(ear().turn) {
    const std::lock_guard lock(ear().mutex);
    ear().heard.clear();
    if (ear().stream != nullptr) {
      __atomic_exchange(&stderr, &ear().stream, &shown_, __ATOMIC_ACQ_REL);
    }
  }
  ~CapturedComplaints() {
    if (shown_ != nullptr) __atomic_store(&stderr, &shown_, __ATOMIC_RELEASE);
  }
  CapturedComplaints(const CapturedComplaints&) = delete;
  CapturedComplaints& operator=(const CapturedComplaints&) = delete;

  /// In one line, each once: "Bad URI: 'usb:'; ..."; "" if nothing was said.
  std::string text() const {
    const std::lock_guard lock(ear().mutex);
    std::string all, rest = ear().heard;
    for (auto end = rest.find('\n'); end != std::string::npos; end = rest.find('\n')) {
      std::string line = rest.substr(0, end);
      rest.erase(0, end + 1);
      if (line.starts_with("ERROR: ")) line.erase(0, 7);
      if (!line.empty() && all.find(line) == std::string::npos) {
        all += (all.empty() ? "" : "; ") + line;
      }
    }
    return all;
  }

 private:
  struct Ear {
    Ear() : stream(::fopencookie(this, "w", {nullptr, hear, nullptr, nullptr})) {
      if (stream != nullptr) std::setvbuf(stream, nullptr, _IONBF, 0);
    }
    static ssize_t hear(void* ear, const char* text, std::size_t size) {
      auto& own = *static_cast<Ear*>(ear);
      const std::lock_guard lock(own.mutex);
      own.heard.append(text, size);
      return static_cast<ssize_t>(size);
    }
    std::mutex turn;   // of who listens
    std::mutex mutex;  // of what was heard
    std::string heard;
    std::FILE* stream;
  };
  // Lives as long as the process: threads that are not waited for may still print.
  static Ear& ear() {
    static Ear& only = *new Ear;
    return only;
  }

  const std::lock_guard<std::mutex> turn_;
  std::FILE* shown_ = nullptr;
};

}  // namespace rvbench::hal
