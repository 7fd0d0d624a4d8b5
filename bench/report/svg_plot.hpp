#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace rvbench::bench {

struct PlotAxis {
  std::string label;  ///< with its unit: "frequency [Hz]"
  double min = 0;
  double max = 1;
};

/// A bar from 0, with a whisker from `low` to `high` if these differ.
struct PlotBar {
  double value = 0, low = 0, high = 0;
  std::string style;  ///< class of the style sheet
};

/// Bars side by side, with one label below.
struct PlotGroup {
  std::string label;
  std::vector<PlotBar> bars;
};

/// A line plot as one inline <svg>: axes with ticks, traces, and marks at places of interest.
/// Colours come from the style sheet of the page.
class SvgPlot {
 public:
  /// @throws std::invalid_argument if an axis is empty or not finite
  SvgPlot(std::string title, PlotAxis x, PlotAxis y, int width_px = 540, int height_px = 215);

  /// Samples at x0, x0 + dx, ... Where they are denser than the plot can show, each column draws
  /// its least and its greatest value: no peak is lost. A NaN interrupts the trace.
  /// @param style  class of the style sheet
  void add_trace(double x0, double dx, const Eigen::Ref<const Eigen::VectorXd>& y,
                 const std::string& style = "trace");

  /// The strip between two traces, as wide in each column as at its widest.
  void add_band(double x0, double dx, const Eigen::Ref<const Eigen::VectorXd>& low,
                const Eigen::Ref<const Eigen::VectorXd>& high);

  /// Group i between x = i and i + 1; their labels take the place of the ticks.
  void add_groups(const std::vector<PlotGroup>& groups);

  /// One dot per point. @throws std::invalid_argument if there are not as many y as x
  void add_dots(const std::vector<double>& x, const std::vector<double>& y,
                const std::string& style);

  /// A line at x, dashed unless its style has it otherwise, with a label on top; labels that would
  /// overlap go to further rows, and are left out (the line stays) when there is no room. The same
  /// mark twice is one.
  void add_mark(double x, std::string label, const std::string& style = "mark");

  std::string svg() const;

 private:
  struct Mark {
    double x = 0;
    std::string label, style;

    bool operator==(const Mark&) const = default;
  };

  double px(double x) const;
  double py(double y) const;
  std::string x_ticks() const;
  std::string axes() const;
  std::string marks() const;

  std::string title_;
  PlotAxis x_;
  PlotAxis y_;
  int width_px_;
  int height_px_;
  std::string traces_;
  std::string labels_;  ///< of groups; empty: ticks
  std::vector<Mark> marks_;
};

/// Round values that part [min, max] into about `count` steps of 1, 2 or 5 times a power of ten.
std::vector<double> round_ticks(double min, double max, int count);

/// An axis that holds all of y with a little air; symmetric about zero if y has both signs.
PlotAxis axis_around(std::string label, const Eigen::Ref<const Eigen::VectorXd>& y);

}  // namespace rvbench::bench
