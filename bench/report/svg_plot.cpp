#include "bench/report/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "bench/xml_text.hpp"

namespace rvbench::bench {
namespace {

constexpr int left_px = 64;
constexpr int right_px = 14;
constexpr int top_px = 57;  // the title and three rows of mark labels
constexpr int bottom_px = 38;
constexpr int label_row_px = 11;
constexpr int label_rows = 3;
constexpr int least_row_px = 14;  // from one label of the y axis to the next
constexpr double label_character_px = 6.2;

void check(const PlotAxis& axis) {
  if (!std::isfinite(axis.min) || !std::isfinite(axis.max) || !(axis.max > axis.min)) {
    throw std::invalid_argument(
        fmt::format("SvgPlot: axis \"{}\" from {} to {} is empty", axis.label, axis.min, axis.max));
  }
}

std::string tick_text(double value) {
  return fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

// Collects points into SVG path data; a break starts a new stroke.
class Path {
 public:
  void point(double x_px, double y_px) {
    data_ += fmt::format("{}{:.1f},{:.1f}", pen_down_ ? "L" : "M", x_px, y_px);
    pen_down_ = true;
  }
  void lift() { pen_down_ = false; }
  const std::string& data() const { return data_; }

 private:
  std::string data_;
  bool pen_down_ = false;
};

}  // namespace

SvgPlot::SvgPlot(std::string title, PlotAxis x, PlotAxis y, int width_px, int height_px)
    : title_(std::move(title)),
      x_(std::move(x)),
      y_(std::move(y)),
      width_px_(width_px),
      height_px_(height_px) {
  check(x_);
  check(y_);
}

double SvgPlot::px(double x) const {
  return left_px + (x - x_.min) / (x_.max - x_.min) * (width_px_ - left_px - right_px);
}

double SvgPlot::py(double y) const {
  const double share = std::clamp((y - y_.min) / (y_.max - y_.min), 0.0, 1.0);
  return height_px_ - bottom_px - share * (height_px_ - top_px - bottom_px);
}

void SvgPlot::add_trace(double x0, double dx, const Eigen::Ref<const Eigen::VectorXd>& y,
                        const std::string& style) {
  const auto first = static_cast<Eigen::Index>(std::max(0.0, std::ceil((x_.min - x0) / dx)));
  const auto last =
      std::min(y.size() - 1, static_cast<Eigen::Index>(std::floor((x_.max - x0) / dx)));
  Path path;
  for (Eigen::Index i = first; i <= last;) {
    const auto column = std::floor(px(x0 + double(i) * dx));
    double least = y[i];
    double greatest = y[i];
    Eigen::Index next = i;
    while (next <= last && std::floor(px(x0 + double(next) * dx)) <= column) {
      least = std::fmin(least, y[next]);
      greatest = std::fmax(greatest, y[next]);
      ++next;
    }
    if (std::isnan(least)) {
      path.lift();
    } else if (least == greatest) {
      path.point(px(x0 + double(i) * dx), py(least));
    } else {
      path.point(column, py(least));
      path.point(column, py(greatest));
    }
    i = next;
  }
  traces_ += "<path class=\"" + style + "\" d=\"" + path.data() + "\"/>";
}

void SvgPlot::add_band(double x0, double dx, const Eigen::Ref<const Eigen::VectorXd>& low,
                       const Eigen::Ref<const Eigen::VectorXd>& high) {
  std::string there, back;
  for (Eigen::Index i = 0; i < low.size();) {
    const double at = std::floor(px(x0 + double(i) * dx));
    double least = low[i], greatest = high[i];
    for (; i < low.size() && std::floor(px(x0 + double(i) * dx)) <= at; ++i) {
      least = std::fmin(least, low[i]);
      greatest = std::fmax(greatest, high[i]);
    }
    if (std::isnan(least)) continue;
    there += fmt::format("{}{:.1f},{:.1f}", there.empty() ? "M" : "L", at, py(greatest));
    back.insert(0, fmt::format("L{:.1f},{:.1f}", at, py(least)));
  }
  traces_ += "<path class=\"band\" d=\"" + there + back + "Z\"/>";
}

void SvgPlot::add_groups(const std::vector<PlotGroup>& groups) {
  constexpr double gap = 0.2;  // of a group: between it and the next
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto from = static_cast<double>(g) + gap / 2;
    const double width = (1 - gap) / static_cast<double>(groups[g].bars.size());
    for (std::size_t b = 0; b < groups[g].bars.size(); ++b) {
      const PlotBar& bar = groups[g].bars[b];
      const double left_at = px(from + static_cast<double>(b) * width);
      const double right_at = px(from + static_cast<double>(b + 1) * width) - 1;
      if (std::isnan(bar.value)) continue;
      traces_ += fmt::format(
          R"(<rect class="bar {}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)",
          bar.style, left_at, py(bar.value), right_at - left_at, py(0) - py(bar.value));
      if (!(bar.high > bar.low)) continue;
      traces_ += fmt::format(R"(<path class="whisker" d="M{0:.1f},{1:.1f}V{2:.1f}"/>)",
                             (left_at + right_at) / 2, py(bar.low), py(bar.high));
    }
    labels_ += fmt::format(R"(<text x="{:.1f}" y="{}" class="mid">{}</text>)",
                           px(static_cast<double>(g) + 0.5), height_px_ - bottom_px + 13,
                           xml_escaped(groups[g].label));
  }
}

void SvgPlot::add_dots(const std::vector<double>& x, const std::vector<double>& y,
                       const std::string& style) {
  if (x.size() != y.size()) throw std::invalid_argument("SvgPlot::add_dots: x and y differ");
  for (std::size_t i = 0; i < x.size(); ++i) {
    traces_ += fmt::format(R"(<circle class="dot {}" cx="{:.1f}" cy="{:.1f}" r="2.6"/>)", style,
                           px(x[i]), py(y[i]));
  }
}

void SvgPlot::add_mark(double x, std::string label, const std::string& style) {
  Mark mark{x, std::move(label), style};
  const bool known = std::ranges::find(marks_, mark) != marks_.end();
  if (x >= x_.min && x <= x_.max && !known) marks_.push_back(std::move(mark));
}

std::string SvgPlot::x_ticks() const {
  if (!labels_.empty()) return labels_;
  const int bottom = height_px_ - bottom_px;
  std::string text;
  for (const double tick : round_ticks(x_.min, x_.max, 8)) {
    text += fmt::format(R"(<path class="grid" d="M{0:.1f},{1}V{2}"/>)"
                        R"(<text x="{0:.1f}" y="{3}" class="mid">{4}</text>)",
                        px(tick), top_px, bottom, bottom + 13, tick_text(tick));
  }
  return text;
}

std::string SvgPlot::axes() const {
  const int bottom = height_px_ - bottom_px;
  std::string text = x_ticks();
  const int y_ticks = std::clamp((bottom - top_px) / least_row_px, 1, 6);
  for (const double tick : round_ticks(y_.min, y_.max, y_ticks)) {
    text += fmt::format(R"(<path class="grid" d="M{0},{1:.1f}H{2}"/>)"
                        R"(<text x="{3}" y="{4:.1f}" class="end">{5}</text>)",
                        left_px, py(tick), width_px_ - right_px, left_px - 5, py(tick) + 3.5,
                        tick_text(tick));
  }
  text += fmt::format(R"(<rect class="frame" x="{}" y="{}" width="{}" height="{}"/>)", left_px,
                      top_px, width_px_ - left_px - right_px, bottom - top_px);
  text += fmt::format(R"(<text x="{:.1f}" y="{}" class="mid">{}</text>)", px((x_.min + x_.max) / 2),
                      height_px_ - 6, xml_escaped(x_.label));
  const double middle = (top_px + bottom) / 2.0;
  return text + fmt::format(
                    R"x(<text transform="translate(13,{:.1f}) rotate(-90)" class="mid">{}</text>)x",
                    middle, xml_escaped(y_.label));
}

std::string SvgPlot::marks() const {
  auto sorted = marks_;
  std::ranges::stable_sort(sorted, {}, &Mark::x);
  double row_ends_px[label_rows] = {};
  std::string text;
  for (const auto& [x, label, style] : sorted) {
    const double at = px(x);
    text += fmt::format(R"(<path class="{}" d="M{:.1f},{}V{}"/>)", style, at, top_px,
                        height_px_ - bottom_px);
    const double half = label_character_px * double(label.size()) / 2;
    const double centre = std::clamp(at, half, width_px_ - half);
    for (int row = 0; row < label_rows; ++row) {
      if (centre - half < row_ends_px[row]) continue;
      row_ends_px[row] = centre + half + 10;
      text += fmt::format(R"(<text x="{:.1f}" y="{}" class="mid {}label">{}</text>)", centre,
                          top_px - 4 - row * label_row_px, style, xml_escaped(label));
      break;
    }
  }
  return text;
}

std::string SvgPlot::svg() const {
  return fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">)"
                     R"(<text x="{}" y="{}" class="title">{}</text>)",
                     width_px_, height_px_, xml_escaped(title_), left_px,
                     marks_.empty() ? top_px - 6 : 14, xml_escaped(title_)) +
         axes() + traces_ + marks() + "</svg>\n";
}

std::vector<double> round_ticks(double min, double max, int count) {
  // Nearer to each other than a double can count in steps: values that differ by rounding alone.
  const double finest = 1e-12 * std::fmax(std::abs(min), std::abs(max));
  if (!(max - min > finest) || !std::isfinite(max - min)) return {min};
  const double rough = (max - min) / count;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / decade;
  const double step = decade * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
  std::vector<double> ticks;
  for (double i = std::ceil(min / step - 1e-9); i * step <= max + 1e-9 * step; ++i)
    ticks.push_back(i * step);
  return ticks;
}

PlotAxis axis_around(std::string label, const Eigen::Ref<const Eigen::VectorXd>& y) {
  double least = 0;
  double greatest = 0;
  for (const double value : y) {
    least = std::fmin(least, value);
    greatest = std::fmax(greatest, value);
  }
  if (least < 0) {
    greatest = std::max(greatest, -least);
    least = -greatest;
  }
  if (!(greatest > 0)) greatest = 1;  // a silent channel still gets a plot
  return {std::move(label), 1.05 * least, 1.05 * greatest};
}

}  // namespace rvbench::bench
