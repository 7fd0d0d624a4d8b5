#include "bench/console.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "hal/formats/printable.hpp"

namespace rvbench::bench {
namespace {

const char* escape_of(Tone tone) {
  switch (tone) {
    case Tone::good: return "\x1b[1;32m";
    case Tone::bad: return "\x1b[1;31m";
    case Tone::warning: return "\x1b[1;33m";
    case Tone::faint: return "\x1b[2m";
    case Tone::strong: return "\x1b[1m";
  }
  return "";
}

// Of a variable of the environment; empty if it is not set.
std::string value_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

}  // namespace

Console system_console() {
  const std::string terminal = value_of("TERM");
  const bool escapes = value_of("NO_COLOR").empty() && !terminal.empty() && terminal != "dumb";
  Console console{std::cout, std::cerr, escapes && isatty(STDOUT_FILENO) == 1,
                  escapes && isatty(STDERR_FILENO) == 1};
  console.err_descriptor = STDERR_FILENO;
  if (isatty(STDOUT_FILENO) == 1) console.out_columns = terminal_columns(STDOUT_FILENO);
  return console;
}

void complain(Console& console, const std::string& text) {
  const std::string line = hal::formats::printable(text);
  console.err << line << '\n';
  console.complaints.push_back(line);
}

bool takes_a_line(const Console& console) {
  if (console.err_descriptor < 0) return true;
  pollfd err{console.err_descriptor, POLLOUT, 0};
  return ::poll(&err, 1, 0) > 0;  // also where nobody is left to read, which makes nobody wait
}

int terminal_columns(int descriptor) {
  winsize size{};
  const bool known = ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

std::string paint(const Console& console, Tone tone, std::string_view text) {
  if (!console.colour) return std::string(text);
  return std::string(escape_of(tone)) + std::string(text) + "\x1b[0m";
}

Tone tone_of(Outcome outcome) {
  if (outcome == Outcome::pass) return Tone::good;
  return outcome == Outcome::fail ? Tone::bad : Tone::warning;
}

int shown_width(std::string_view text) {
  int width = 0;
  for (const char byte : text) width += continues_character(byte) ? 0 : 1;
  return width;
}

std::string padded(std::string_view text, int columns) {
  return std::string(text) +
         std::string(std::size_t(std::max(0, columns - shown_width(text))), ' ');
}

std::string clipped_to(std::string_view text, int columns) {
  int width = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!continues_character(text[i]) && ++width > columns) return std::string(text.substr(0, i));
  }
  return std::string(text);
}

std::string as_cell(std::string_view text, int columns) {
  const std::string cell = hal::formats::printable(text);
  return shown_width(cell) <= columns ? cell : clipped_to(cell, columns - 1) + "…";
}

}  // namespace rvbench::bench
