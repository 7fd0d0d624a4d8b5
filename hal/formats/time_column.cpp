#include "hal/formats/time_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "hal/formats/even_grid.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr Eigen::Index fewest_nameless = 100;  // fewer may rise evenly by chance

struct TimeName {
  std::string_view name;  // in lower case, without blanks and brackets
  double unit_s;
};
constexpr std::array time_names = {
    TimeName{"time", 1},       TimeName{"t", 1},       TimeName{"times", 1},
    TimeName{"time_s", 1},     TimeName{"ts", 1},      TimeName{"t_s", 1},
    TimeName{"timesec", 1},    TimeName{"seconds", 1}, TimeName{"timems", 1e-3},
    TimeName{"time_ms", 1e-3}, TimeName{"t_ms", 1e-3}, TimeName{"tms", 1e-3}};

std::optional<double> unit_of(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    if (std::string_view(" ()[],").find(c) != std::string_view::npos) continue;
    plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const auto known = std::ranges::find(time_names, plain, &TimeName::name);
  return known == time_names.end() ? std::nullopt : std::optional<double>(known->unit_s);
}

}  // namespace

void set_rate_by_time_column(bool has_names, Recording& table) {
  for (const Channel& column : table.channels) {
    const Eigen::VectorXd& x = column.samples;
    const auto unit_s = has_names ? unit_of(column.info.name) : std::optional<double>(1);
    const std::optional<double> step = unit_s ? even_step(x) : std::nullopt;
    const bool is_time =
        step && (has_names || (x[0] == 0 && *step < 1 && x.size() >= fewest_nameless));
    if (is_time) {
      const double rate_Hz = 1 / (*step * *unit_s);
      if (!has_names) {
        table.notes.push_back(
            fmt::format("rate {:.6g} Hz from {}, taken as time in s", rate_Hz, column.info.name));
      }
      for (Channel& channel : table.channels) channel.rate_Hz = rate_Hz;
      return;
    }
    if (!has_names) return;
  }
}

}  // namespace rvbench::hal::formats
