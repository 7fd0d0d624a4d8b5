#include "analysis/frf/hit_deviations.hpp"

#include <complex>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

// Of one hit: y·x* and |x|², at the lines of the band.
struct HitProducts {
  Eigen::MatrixXcd cross;  // responses x lines
  Eigen::RowVectorXd power;
};

HitProducts products_of(const FrfRecord& hit, const BandLines& lines) {
  const Eigen::VectorXcd force = fft(hit.excitations.col(0)).segment(lines.first, lines.count);
  HitProducts products{Eigen::MatrixXcd(hit.responses.cols(), lines.count),
                       force.cwiseAbs2().transpose()};
  for (Index response = 0; response < hit.responses.cols(); ++response) {
    products.cross.row(response) = fft(hit.responses.col(response))
                                       .segment(lines.first, lines.count)
                                       .cwiseProduct(force.conjugate())
                                       .transpose();
  }
  return products;
}

void require_alike(const std::vector<FrfRecord>& hits) {
  constexpr Require require{"hit_deviations"};
  require(!hits.empty(), "no hit");
  for (const FrfRecord& hit : hits) {
    require(hit.excitations.cols() == 1, hit.source + ": not one excitation");
    require(hit.excitations.rows() == hits[0].excitations.rows() &&
                hit.responses.rows() == hit.excitations.rows() &&
                hit.responses.cols() == hits[0].responses.cols() && hit.rate_Hz == hits[0].rate_Hz,
            hit.source + ": rate, length or channels are not those of the first hit");
  }
}

}  // namespace

std::vector<Eigen::MatrixXcf> hit_deviations(const std::vector<FrfRecord>& hits,
                                             const FrfBand& band) {
  constexpr Require require{"hit_deviations"};
  require_alike(hits);
  const Index samples = hits[0].responses.rows();
  const BandLines lines = lines_of(band, 0, hits[0].rate_Hz / double(samples));
  require(lines.count > 0 && lines.first + lines.count <= samples / 2 + 1,
          "the band is not within the lines");
  std::vector<HitProducts> products;
  HitProducts sum{Eigen::MatrixXcd::Zero(hits[0].responses.cols(), lines.count),
                  Eigen::RowVectorXd::Zero(lines.count)};
  for (const FrfRecord& hit : hits) {
    products.push_back(products_of(hit, lines));
    sum.cross += products.back().cross;
    sum.power += products.back().power;
  }
  const auto is_driven = sum.power.array() > 0;
  const Eigen::VectorXd inverse = is_driven.select(sum.power.cwiseInverse(), 0.0).transpose();
  const Eigen::MatrixXcd average = sum.cross * inverse.asDiagonal();
  std::vector<Eigen::MatrixXcf> deviations;
  for (const HitProducts& hit : products) {
    deviations.push_back(((hit.cross - average * hit.power.transpose().asDiagonal()) *
                          (double(hits.size()) * inverse).asDiagonal())
                             .cast<std::complex<float>>());
  }
  return deviations;
}

}  // namespace rvbench::analysis
