#include "analysis/tpa/frf_draws.hpp"

#include <cmath>
#include <complex>

#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

// How often each of n comes when n are drawn.
Eigen::VectorXf drawn_counts(Index n, std::mt19937_64& engine) {
  Eigen::VectorXf counts = Eigen::VectorXf::Zero(n);
  std::uniform_int_distribution<Index> any(0, n - 1);
  for (Index i = 0; i < n; ++i) ++counts[any(engine)];
  return counts;
}

void add_draw(const ColumnDeviations& hits, Index column, std::mt19937_64& engine,
              FrfMatrix& frfs) {
  const Index n = Index(hits.size());
  if (n < 2) return;
  const Eigen::VectorXf counts = drawn_counts(n, engine);
  Eigen::MatrixXcf error = Eigen::MatrixXcf::Zero(frfs.values.rows, frfs.values.lines);
  for (Index hit = 0; hit < n; ++hit) {
    if (counts[hit] > 0) error += counts[hit] * hits[std::size_t(hit)];
  }
  error *= float(std::sqrt(1 / (double(n) * double(n - 1))));
  for (Index line = 0; line < frfs.values.lines; ++line) {
    frfs.values[line].col(column) += error.col(line).cast<std::complex<double>>();
  }
}

}  // namespace

FrfDraw draws_within_variances(const FrfMatrix& frfs) {
  return [&frfs](std::mt19937_64& engine) {
    FrfMatrix other = frfs;
    const Index pairs = frfs.variances.rows();
    std::normal_distribution<double> part(0, std::sqrt(0.5));
    for (Index pair = 0; pair < pairs; ++pair) {
      const double real = part(engine);
      const std::complex<double> error(real, part(engine));
      for (Index line = 0; line < frfs.values.lines; ++line) {
        other.values.values[line * pairs + pair] += error * std::sqrt(frfs.variances(pair, line));
      }
    }
    return other;
  };
}

FrfDraw draws_of_hits(const FrfMatrix& frfs, const std::vector<ColumnDeviations>& columns) {
  constexpr Require require{"draws_of_hits"};
  require(Index(columns.size()) == frfs.values.columns, "hits of other columns");
  for (const ColumnDeviations& hits : columns) {
    for (const Eigen::MatrixXcf& hit : hits) {
      require(hit.rows() == frfs.values.rows && hit.cols() == frfs.values.lines,
              "a hit of other rows or lines");
    }
  }
  return [&frfs, &columns](std::mt19937_64& engine) {
    FrfMatrix other = frfs;
    for (std::size_t column = 0; column < columns.size(); ++column) {
      add_draw(columns[column], Index(column), engine, other);
    }
    return other;
  };
}

}  // namespace rvbench::analysis
