#include "bench/commands/shaft_question.hpp"

#include <poll.h>
#include <unistd.h>

namespace rvbench::bench {
namespace {

constexpr int question_ms = 100;  // how often somebody who is asked may give it up

}  // namespace

std::string why_not_to_turn(Console& console, const std::stop_token& stop) {
  if (::isatty(STDIN_FILENO) == 0) {
    return "the shaft would turn, and there is no terminal to ask at: give --yes if the bench is "
           "clear";
  }
  console.err << "The shaft will turn. Is the bench clear, and the reducer free of load?\n"
                 "Type yes to go on: "
              << std::flush;
  std::string answer;
  while (!stop.stop_requested() && answer.find('\n') == std::string::npos) {
    pollfd terminal{STDIN_FILENO, POLLIN, 0};
    if (::poll(&terminal, 1, question_ms) <= 0) continue;
    char typed = '\n';
    if (::read(STDIN_FILENO, &typed, 1) <= 0) typed = '\n';  // the end: nobody will answer
    answer += typed;
  }
  return answer == "yes\n" ? "" : "the shaft was not cleared to turn: answer yes, or give --yes";
}

}  // namespace rvbench::bench
