#pragma once

#include <Eigen/Core>
#include <vector>

namespace rvbench::analysis {

/// A complex matrix for each line of frequency. Layout: column by column, line after line, without
/// gaps: element (row, column) of a line is values[(line·columns + column)·rows + row].
struct LineMatrices {
  Eigen::Index rows = 0;
  Eigen::Index columns = 0;
  Eigen::Index lines = 0;
  Eigen::VectorXcd values;

  LineMatrices() = default;
  /// All zero.
  LineMatrices(Eigen::Index row_count, Eigen::Index column_count, Eigen::Index line_count)
      : rows(row_count),
        columns(column_count),
        lines(line_count),
        values(Eigen::VectorXcd::Zero(row_count * column_count * line_count)) {}

  /// Not set: for whoever sets each element.
  static LineMatrices unset(Eigen::Index row_count, Eigen::Index column_count,
                            Eigen::Index line_count) {
    LineMatrices made;
    made.rows = row_count;
    made.columns = column_count;
    made.lines = line_count;
    made.values.resize(row_count * column_count * line_count);
    return made;
  }

  Eigen::Map<const Eigen::MatrixXcd> operator[](Eigen::Index line) const {
    return {values.data() + line * rows * columns, rows, columns};
  }
  Eigen::Map<Eigen::MatrixXcd> operator[](Eigen::Index line) {
    return {values.data() + line * rows * columns, rows, columns};
  }
};

/// These columns, in this order; one may be there twice.
/// Shape   as many columns, all lines. Units  of the whole
/// Errors  throws std::invalid_argument of a column that is not there. Source  definition
LineMatrices columns_of(const LineMatrices& all, const std::vector<Eigen::Index>& columns);

/// 1 / RMS of each row over the lines that are used, up to a factor that all have in common: the
/// loudest has 1, and a silent one no more than one of a millionth of the loudest.
/// @param is_used  one per line; empty for all
/// Shape   rows. Units  none. Errors  none thrown: all silent are alike. Source  definition
Eigen::VectorXd inverse_rms(const LineMatrices& rows, const std::vector<bool>& is_used = {});

}  // namespace rvbench::analysis
