#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "bench/console.hpp"
#include "bench/seconds_source.hpp"

namespace rvbench::bench {

/// One line of exactly fitting width: "measure  [#####.....]  52 %  1:07 left  record 605 rpm".
/// A narrow terminal loses the bar first, then what is done; never the percentage.
/// @param left_s  NaN if not known yet
std::string progress_line(std::string_view stage, double fraction, double left_s,
                          std::string_view doing, int columns);

/// Shows how far a long job is: a bar on a terminal, else a plain line every tenth of the way.
/// A terminal that has been stopped with Ctrl-S misses what would be shown: the job goes on.
/// The cursor is hidden while a bar is shown and restored by clear() and the destructor.
class ProgressBar {
 public:
  enum class Style { bar, lines, silent };

  ProgressBar(Console& console, Style style);
  ProgressBar(Console& console, Style style, SecondsSource now_s);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// A new stage starts the estimate of the time left anew.
  void show(const std::string& stage, double fraction, const std::string& doing);
  void clear();

  /// Tells another as well, in whatever style, each time that show() is called; left_s is NaN where
  /// it is not known yet. It must not wait for anybody.
  using Watcher = std::function<void(const std::string& stage, double fraction, double left_s,
                                     const std::string& doing)>;
  void tell(Watcher watcher) { watcher_ = std::move(watcher); }

 private:
  void start_stage(const std::string& stage);
  void draw_bar(double fraction, const std::string& doing);
  void print_line(double fraction, const std::string& doing);
  double left_s(double fraction) const;

  Console& console_;
  Style style_;
  SecondsSource now_s_;
  std::string stage_;
  double stage_began_s_ = 0;
  double drawn_s_ = 0;
  int tenths_ = -1;
  bool on_screen_ = false;
  Watcher watcher_;
};

/// Silent with --json; a bar on a terminal; else lines.
ProgressBar::Style progress_style(const Console& console, bool json);

}  // namespace rvbench::bench
