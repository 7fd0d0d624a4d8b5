#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

namespace rvbench::hal {

/// While it lives, what C code prints on `stderr` is kept and shown to nobody: libiio has no other
/// way to tell why it makes no context. std::cerr keeps the stream that it began with.
///
/// Threads  one object at a time in a process
class CapturedComplaints {
 public:
  CapturedComplaints() : stream_(::open_memstream(&text_, &size_)) {
    if (stream_ != nullptr) shown_ = std::exchange(stderr, stream_);
  }
  ~CapturedComplaints() {
    if (stream_ == nullptr) return;
    stderr = shown_;
    std::fclose(stream_);
    std::free(text_);
  }
  CapturedComplaints(const CapturedComplaints&) = delete;
  CapturedComplaints& operator=(const CapturedComplaints&) = delete;

  /// In one line, each once: "Bad URI: 'usb:'; ..."; "" if nothing was said.
  std::string text() const {
    if (stream_ == nullptr) return "";
    std::fflush(stream_);
    std::string all, rest(text_, size_);
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
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* stream_;
  std::FILE* shown_ = nullptr;
};

}  // namespace rvbench::hal
