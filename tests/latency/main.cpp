#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <map>

#include "tests/latency/figures.hpp"

namespace {

using rvbench::test::Figure;

// Whether all are within their limits.
bool print(const std::vector<Figure>& figures) {
  bool within = true;
  for (const Figure& figure : figures) {
    const std::string limit =
        figure.limit > 0 ? fmt::format("limit {:g}{}", figure.limit,
                                       figure.value <= figure.limit ? "" : "   ABOVE ITS LIMIT")
                         : "";
    within = within && !(figure.limit > 0 && figure.value > figure.limit);
    fmt::print("{:<60} {:10.3f} {:<4} {}\n", figure.what, figure.value, figure.unit, limit);
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
  app.add_flag("--short", is_short, "a few of each: whether it works, not how fast it is");
  app.add_option("--only", only, "trips, link, release, lateness, polling, recording");
  CLI11_PARSE(app, argc, argv);
  using namespace rvbench::test;
  const std::vector<std::pair<std::string, std::function<std::vector<Figure>()>>> all{
      {"trips", [&] { return measure_trips(is_short ? 6 : 1000); }},
      {"link", [&] { return measure_link_loss(is_short ? 1 : 20); }},
      {"release", [&] { return measure_release(is_short ? 1 : 5); }},
      {"lateness", [&] { return measure_lateness(is_short ? 1 : 30); }},
      {"polling", [&] { return measure_polling(is_short ? 100 : 20'000); }},
      {"recording", [&] { return measure_recording(is_short ? 1 : 20); }}};
  bool within = true;
  try {
    for (const auto& [name, measure] : all) {
      if (only.empty() || std::ranges::find(only, name) != only.end())
        within = print(measure()) && within;
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "rvbench_latency: {}\n", error.what());
    return 1;
  }
  return within || is_short ? 0 : 1;
}
