#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

namespace rvbench::analysis::examples {

struct Axis {
  std::string label;  ///< with its unit
  double min = 0;
  double max = 1;
};

/// Values at even steps.
struct Trace {
  std::string name;
  double first = 0;
  double step = 1;
  Eigen::VectorXd values;
};

struct Mark {
  double at = 0;
  std::string label;
};

/// Up to three traces over one another.
struct Panel {
  std::string title;
  Axis x, y;
  std::vector<Trace> traces;
  std::vector<Mark> marks = {};
};

/// Bars side by side, in groups: of the names, in their order.
struct Bars {
  std::string title;
  Axis y;
  std::vector<std::string> names;
  struct Group {
    std::string label;
    std::vector<double> values;
  };
  std::vector<Group> groups;
};

/// Rows of cells as wide as the axis together; the first row is the lowest.
struct Map {
  std::string title;
  Axis x;
  std::string y_label;
  double most = 1;  ///< where the colour ends; it begins at 0
  struct Row {
    std::string label;  ///< empty: none
    Eigen::VectorXd cells;
  };
  std::vector<Row> rows;
};

using Plot = std::variant<Panel, Bars, Map>;

/// Something that the method found, beside what the signal was made with.
struct Figure {
  std::string what;
  std::string known;  ///< "–" if the signal does not say
  std::string found;
};

/// A method at work on a signal that is known.
struct Example {
  std::string name;  ///< of the page, the plot, and the source file that it stands in
  std::string title;
  std::string text;                  ///< the signal, and what is asked
  std::vector<std::string> headers;  ///< where the functions are, from analysis/ on
  std::vector<Figure> figures;
  std::vector<Plot> plots;
};

/// All of them, in the order in which they are to be read.
std::vector<Example> all_examples();

/// A value with so many decimals, for a figure.
std::string rounded(double value, int decimals);

/// A p-value as a figure: "below 1e-15" where its digits mean nothing.
std::string p_value_text(double p_value);

}  // namespace rvbench::analysis::examples
