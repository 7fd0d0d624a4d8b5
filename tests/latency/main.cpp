#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>

#include "tests/latency/figures.hpp"

namespace {

using rvbench::test::Figure;

// Whether all are within their limits.
bool print(const std::vector<Figure>& figures, bool is_short) {
  bool within = true;
  for (const Figure& figure : figures) {
    const double limit = is_short ? figure.short_limit : figure.limit;
    const bool is_within = limit == 0 || figure.value <= limit;
    within = within && is_within;
    const std::string told = limit == 0 ? "" : fmt::format("limit {:g}", limit);
    fmt::print("{:<60} {:10.3f} {:<4} {}{}\n", figure.what, figure.value, figure.unit, told,
               is_within ? "" : "   ABOVE ITS LIMIT");
  }
  std::fflush(stdout);
  return within;
}

}  // namespace

int main(int argc, char** argv) {
  bool is_short = false;
  std::vector<std::string> only;
  CLI::App app{
      "How fast the bench is where that matters, in real time, over real protocols on the "
      "loopback,\n"
      "one core kept busy by something else."};
  app.add_flag("--short", is_short, "a few of each, and limits for a machine that others use");
  app.add_option("--only", only, "trips, link, release, lateness, polling, recording");
  CLI11_PARSE(app, argc, argv);
  using namespace rvbench::test;
  const std::vector<std::pair<std::string, std::function<std::vector<Figure>()>>> all{
      {"trips", [&] { return measure_trips(is_short ? 102 : 1000); }},
      {"link", [&] { return measure_link_loss(is_short ? 1 : 20); }},
      {"release", [&] { return measure_release(is_short ? 1 : 5); }},
      {"lateness", [&] { return measure_lateness(is_short ? 1 : 30); }},
      {"polling", [&] { return measure_polling(is_short ? 100 : 20'000); }},
      {"recording", [&] { return measure_recording(is_short ? 1 : 20); }}};
  bool within = true;
  try {
    for (const auto& [name, measure] : all) {
      if (only.empty() || std::ranges::find(only, name) != only.end())
        within = print(measure(), is_short) && within;
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "rvbench_latency: {}\n", error.what());
    return 1;
  }
  return within ? 0 : 1;
}
