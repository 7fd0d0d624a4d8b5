#include "analysis/tpa/sensor_change.hpp"

#include <complex>

#include "analysis/tpa/line_svd.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

// A sensor alone: its sign. Two: their swap.
struct Candidate {
  Index first = 0, second = 0;
  double unexplained = 0;  // sum over the lines

  bool is_swap() const { return first != second; }
};

std::vector<Candidate> candidates_of(const std::vector<DegreeOfFreedom>& places) {
  std::vector<Candidate> candidates;
  for (Index i = 0; i < Index(places.size()); ++i) {
    candidates.push_back({i, i});
    for (Index j = i + 1; j < Index(places.size()); ++j) {
      if (places[std::size_t(i)].point == places[std::size_t(j)].point)
        candidates.push_back({i, j});
    }
  }
  return candidates;
}

// tr(P·S), both Hermitian.
double outside(const Eigen::MatrixXcd& projector, const Eigen::MatrixXcd& cross) {
  return projector.conjugate().cwiseProduct(cross).sum().real();
}

Eigen::MatrixXcd undone(Eigen::MatrixXcd cross, const Candidate& candidate) {
  if (candidate.is_swap()) {
    cross.row(candidate.first).swap(cross.row(candidate.second));
    cross.col(candidate.first).swap(cross.col(candidate.second));
  } else {
    cross.row(candidate.first) *= -1;
    cross.col(candidate.first) *= -1;
  }
  return cross;
}

}  // namespace

std::optional<SensorChange> find_sensor_change(const FrfMatrix& frfs,
                                               const OperatingSpectra& operating,
                                               const SensorRoles& roles,
                                               std::vector<bool> is_used) {
  constexpr Require require{"find_sensor_change"};
  const LineMatrices values = rows_of(frfs, roles.indicators()).values;
  const LineMatrices responses = rows_of(operating, roles.indicators()).values;
  require(values.rows > values.columns, "no more indicators than paths, nothing is outside");
  require(values.lines == responses.lines, "the spectra are not on the lines of the FRFs");
  if (is_used.empty()) is_used.assign(std::size_t(values.lines), true);
  require(Index(is_used.size()) == values.lines, "as many marks as lines are not given");
  const LineSvd svd = line_svd(values);
  std::vector<Candidate> candidates = candidates_of(roles.indicators());
  double before = 0, lines = 0;
  for (Index line = 0; line < values.lines; ++line) {
    const double power = responses[line].squaredNorm();
    if (!is_used[std::size_t(line)] || !(power > 0)) continue;
    const auto left = svd.left[line];
    const Eigen::MatrixXcd projector =
        Eigen::MatrixXcd::Identity(values.rows, values.rows) - left * left.adjoint();
    const Eigen::MatrixXcd cross = responses[line] * responses[line].adjoint() / power;
    before += outside(projector, cross);
    for (Candidate& candidate : candidates) {
      candidate.unexplained += outside(projector, undone(cross, candidate));
    }
    ++lines;
  }
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates) {
    if (best == nullptr || candidate.unexplained < best->unexplained) best = &candidate;
  }
  if (best == nullptr || !(best->unexplained < before / 2)) return std::nullopt;
  const auto place = [&](Index i) { return roles.indicators()[std::size_t(i)]; };
  SensorChange change{place(best->first), std::nullopt, before / lines, best->unexplained / lines};
  if (best->is_swap()) change.swapped_with = place(best->second);
  return change;
}

}  // namespace rvbench::analysis
