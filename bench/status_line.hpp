#pragma once

#include <string>

#include "bench/console.hpp"
#include "bench/seconds_source.hpp"

namespace rvbench::bench {

/// How things stand, on a line of its own above the one that somebody types on, written anew once a
/// second. Nothing where standard error is no terminal.
class StatusLine {
 public:
  explicit StatusLine(Console& console);
  StatusLine(Console& console, SecondsSource now_s);

  bool is_due() const;  ///< whether show() would write
  void show(const std::string& text);
  /// Something else was printed: the next line comes below it.
  void move_down() { is_above_ = false; }

 private:
  Console& console_;
  SecondsSource now_s_;
  double shown_s_ = -1e9;
  bool is_above_ = false;  ///< the last line is the one above the cursor
};

}  // namespace rvbench::bench
