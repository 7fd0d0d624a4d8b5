#include "analysis/frf/unlike_hits.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

namespace {

using Eigen::Index;

struct HitSpectra {
  Eigen::VectorXcd force;
  Eigen::MatrixXcd responses;  // lines x responses
};

HitSpectra spectra_of(const FrfRecord& hit) {
  HitSpectra spectra{fft(hit.excitations.col(0)), {}};
  spectra.responses.resize(spectra.force.size(), hit.responses.cols());
  for (Index c = 0; c < hit.responses.cols(); ++c) {
    spectra.responses.col(c) = fft(hit.responses.col(c));
  }
  return spectra;
}

double distance(const HitSpectra& a, const HitSpectra& b) {
  double apart = 0, power = 0;
  for (Index c = 0; c < a.responses.cols(); ++c) {
    const Eigen::ArrayXcd one = a.responses.col(c).array() * b.force.array();
    const Eigen::ArrayXcd other = b.responses.col(c).array() * a.force.array();
    apart += (one - other).abs2().sum();
    power += (one.abs() * other.abs()).sum();
  }
  return power > 0 ? std::sqrt(apart / power) : 0;
}

double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + (std::ptrdiff_t(values.size()) - 1) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Eigen::VectorXd distances_to_others(const std::vector<FrfRecord>& hits) {
  constexpr Require require{"distances_to_others"};
  const auto count = Index(hits.size());
  if (count < 3) return Eigen::VectorXd::Zero(count);
  std::vector<HitSpectra> spectra;
  for (const FrfRecord& hit : hits) {
    require(hit.excitations.cols() == 1, hit.source + ": not one excitation");
    require(hit.excitations.rows() == hits[0].excitations.rows() &&
                hit.responses.rows() == hit.excitations.rows() &&
                hit.responses.cols() == hits[0].responses.cols(),
            hit.source + ": length or channels are not those of the first hit");
    spectra.push_back(spectra_of(hit));
  }
  Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(count, count);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < i; ++j) {
      apart(i, j) = apart(j, i) = distance(spectra[std::size_t(i)], spectra[std::size_t(j)]);
    }
  }
  Eigen::VectorXd distances(count);
  for (Index i = 0; i < count; ++i) {
    std::vector<double> others;
    for (Index j = 0; j < count; ++j) {
      if (j != i) others.push_back(apart(i, j));
    }
    distances[i] = lower_median(std::move(others));
  }
  return distances;
}

}  // namespace rvbench::analysis
