#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bench/progress_bar.hpp"
#include "sequences/sequencer.hpp"

namespace rvbench::bench {

/// The events in a log.jsonl. Lines that a killed run left half-written are none.
std::vector<std::pair<double, std::string>> events_in(const std::filesystem::path& file);

/// What a run tells while it goes: progress to the bar, events to log.jsonl, one JSON object a
/// line, each written out at once.
class RunLog final : public sequences::RunObserver {
 public:
  /// Appends to the file; what it holds are events of the same run before it was resumed. error()
  /// tells if it cannot be opened.
  RunLog(const std::filesystem::path& file, ProgressBar& bar);
  ~RunLog() override;
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  void progress(double done_s, double total_s, const std::string& doing) override;
  void event(double time_s, const std::string& text) override;

  /// Of the whole run. The rig's time starts anew with each part of it.
  const std::vector<std::pair<double, std::string>>& events() const { return events_; }

  int error() const {
    return error_;
  }  ///< errno of what could not be opened or written first, or 0

 private:
  void write(const std::string& text);

  int descriptor_;
  int error_ = 0;
  ProgressBar& bar_;
  std::vector<std::pair<double, std::string>> events_;
};

}  // namespace rvbench::bench
