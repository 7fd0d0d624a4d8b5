#include "bench/progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rvbench::bench {
namespace {

constexpr double redraw_s = 0.1;
constexpr int least_bar = 10;
constexpr int widest_bar = 30;
constexpr int room_for_left = 12;  // "1:00:00 left": fixed, so that the bar keeps its width
constexpr int least_doing = 15;

std::string clock_text(double seconds) {
  if (!std::isfinite(seconds)) return "";
  const auto whole = static_cast<long>(std::ceil(std::max(0.0, seconds)));
  if (whole >= 3600)
    return fmt::format("{}:{:02}:{:02} left", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02} left", whole / 60, whole % 60);
}

}  // namespace

std::string progress_line(std::string_view stage, double fraction, double left_s,
                          std::string_view doing, int columns) {
  const double shown = std::clamp(std::isfinite(fraction) ? fraction : 0.0, 0.0, 1.0);
  const std::string percent = fmt::format("{:3.0f} %", std::floor(100 * shown));
  const std::string left = clock_text(left_s);
  std::string line = fmt::format("{} {}", stage, percent);
  if (shown_width(line) > columns) return clipped_to(percent, columns);

  const int room_for_bar = columns - shown_width(line) - room_for_left - least_doing;
  if (room_for_bar >= least_bar) {
    const int width = std::min(room_for_bar, widest_bar);
    const auto full = static_cast<std::size_t>(std::lround(shown * width));
    line = fmt::format("{} [{}{}] {}", stage, std::string(full, '#'),
                       std::string(static_cast<std::size_t>(width) - full, '.'), percent);
  }
  if (!left.empty() && shown_width(line) + shown_width(left) + 2 <= columns) line += "  " + left;
  const int room_for_doing = columns - shown_width(line) - 2;
  if (room_for_doing >= 8 && !doing.empty()) line += "  " + clipped_to(doing, room_for_doing);
  return line;
}

ProgressBar::ProgressBar(Console& console, Style style) : ProgressBar(console, style, steady_s) {}

ProgressBar::ProgressBar(Console& console, Style style, SecondsSource now_s)
    : console_(console), style_(style), now_s_(std::move(now_s)) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(const std::string& stage, double fraction, const std::string& doing) {
  if (stage != stage_) start_stage(stage);
  if (watcher_) watcher_(stage, fraction, left_s(fraction), doing);
  if (style_ == Style::silent || !takes_a_line(console_)) return;
  if (style_ == Style::bar) {
    draw_bar(fraction, doing);
  } else {
    print_line(fraction, doing);
  }
}

void ProgressBar::clear() {
  if (!on_screen_ || !takes_a_line(console_)) return;
  console_.err << "\r\x1b[K\x1b[?25h" << std::flush;
  on_screen_ = false;
}

void ProgressBar::start_stage(const std::string& stage) {
  stage_ = stage;
  stage_began_s_ = now_s_();
  tenths_ = -1;
  drawn_s_ = stage_began_s_ - redraw_s;
}

void ProgressBar::draw_bar(double fraction, const std::string& doing) {
  if (now_s_() - drawn_s_ < redraw_s) return;
  drawn_s_ = now_s_();
  if (!on_screen_) console_.err << "\x1b[?25l";
  on_screen_ = true;
  // One column less than there are: a full line would wrap on some terminals.
  console_.err << '\r'
               << progress_line(stage_, fraction, left_s(fraction), doing, terminal_columns() - 1)
               << "\x1b[K" << std::flush;
}

void ProgressBar::print_line(double fraction, const std::string& doing) {
  const int tenths = static_cast<int>(std::floor(10 * fraction + 1e-9));
  if (tenths <= tenths_) return;
  tenths_ = tenths;
  console_.err << fmt::format("{}: {} %, {}\n", stage_, 10 * tenths, doing) << std::flush;
}

double ProgressBar::left_s(double fraction) const {
  const double elapsed_s = now_s_() - stage_began_s_;
  if (fraction < 0.01 || elapsed_s < 0.5) return std::nan("");
  return elapsed_s * (1 - fraction) / fraction;
}

ProgressBar::Style progress_style(const Console& console, bool json) {
  if (json) return ProgressBar::Style::silent;
  return console.err_is_terminal ? ProgressBar::Style::bar : ProgressBar::Style::lines;
}

}  // namespace rvbench::bench
