#include "bench/status_line.hpp"

#include <utility>

namespace rvbench::bench {
namespace {

constexpr double refresh_s = 1;

}  // namespace

StatusLine::StatusLine(Console& console) : StatusLine(console, steady_s) {}

StatusLine::StatusLine(Console& console, SecondsSource now_s)
    : console_(console), now_s_(std::move(now_s)) {}

bool StatusLine::is_due() const {
  return console_.err_is_terminal && takes_a_line(console_) && now_s_() - shown_s_ >= refresh_s;
}

void StatusLine::show(const std::string& text) {
  if (!is_due()) return;
  shown_s_ = now_s_();
  // One column less than there are: a full line would wrap on some terminals.
  const std::string line = clipped_to(text, terminal_columns() - 1);
  if (is_above_) {
    // Save the cursor, which may be behind half a word that somebody types; up, anew, and back.
    console_.err << "\x1b"
                 << "7\x1b[1A\r" << line << "\x1b[K\x1b"
                 << "8" << std::flush;
  } else {
    console_.err << line << std::endl;
  }
  is_above_ = true;
}

}  // namespace rvbench::bench
