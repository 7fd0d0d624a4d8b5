#include "analysis/frf/cross_spectra.hpp"

#include <cmath>

#include "analysis/fft.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {

namespace {

Eigen::MatrixXcd spectra_of(const Eigen::MatrixXd& samples) {
  Eigen::MatrixXcd spectra(samples.rows() / 2 + 1, samples.cols());
  for (Eigen::Index c = 0; c < samples.cols(); ++c) spectra.col(c) = fft(samples.col(c));
  return spectra;
}

CrossSpectra none_of(Eigen::Index samples, Eigen::Index excitations, Eigen::Index responses,
                     double rate_Hz) {
  const Eigen::Index lines = samples / 2 + 1;
  CrossSpectra sum;
  sum.step_Hz = rate_Hz / double(samples);
  sum.excitations.assign(std::size_t(lines), Eigen::MatrixXcd::Zero(excitations, excitations));
  sum.cross.assign(std::size_t(lines), Eigen::MatrixXcd::Zero(responses, excitations));
  sum.responses.setZero(lines, responses);
  return sum;
}

void add(CrossSpectra& sum, const Eigen::MatrixXd& excitations, const Eigen::MatrixXd& responses) {
  const Eigen::MatrixXcd x = spectra_of(excitations).transpose();
  const Eigen::MatrixXcd y = spectra_of(responses).transpose();
  for (Eigen::Index k = 0; k < sum.lines(); ++k) {
    sum.excitations[std::size_t(k)] += x.col(k) * x.col(k).adjoint();
    sum.cross[std::size_t(k)] += y.col(k) * x.col(k).adjoint();
  }
  sum.responses += y.cwiseAbs2().transpose();
  ++sum.records;
}

CrossSpectra mean_of(CrossSpectra sum, double averages) {
  const double share = 1.0 / sum.records;
  for (Eigen::MatrixXcd& line : sum.excitations) line *= share;
  for (Eigen::MatrixXcd& line : sum.cross) line *= share;
  sum.responses *= share;
  sum.averages = averages;
  return sum;
}

Eigen::ArrayXd hann(Eigen::Index n) {
  const Eigen::ArrayXd along = Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1)) / double(n);
  return 0.5 * (1 - (units::two_pi * along).cos());
}

double independent_blocks(const Eigen::ArrayXd& window, Eigen::Index step, int blocks) {
  const Eigen::Index n = window.size();
  double shared = 0;
  for (Eigen::Index k = 1; k < blocks && k * step < n; ++k) {
    const Eigen::Index common = n - k * step;
    const double rho = (window.head(common) * window.tail(common)).sum() / window.square().sum();
    shared += (1 - double(k) / blocks) * rho * rho;
  }
  return blocks / (1 + 2 * shared);
}

}  // namespace

CrossSpectra hit_spectra(const std::vector<FrfRecord>& records) {
  constexpr Require require{"hit_spectra"};
  require(!records.empty(), "no record");
  const FrfRecord& first = records.front();
  CrossSpectra sum = none_of(first.excitations.rows(), first.excitations.cols(),
                             first.responses.cols(), first.rate_Hz);
  for (const FrfRecord& record : records) {
    require(record.rate_Hz == first.rate_Hz &&
                record.excitations.rows() == first.excitations.rows() &&
                record.responses.rows() == first.excitations.rows() &&
                record.excitations.cols() == first.excitations.cols() &&
                record.responses.cols() == first.responses.cols(),
            record.source + ": rate, length or channels are not those of the first record");
    require(record.excitations.allFinite() && record.responses.allFinite(),
            record.source + ": not finite");
    add(sum, record.excitations, record.responses);
  }
  return mean_of(std::move(sum), double(records.size()));
}

CrossSpectra block_spectra(const FrfRecord& record, const BlockAverage& average) {
  constexpr Require require{"block_spectra"};
  require(average.overlap >= 0 && average.overlap < 1, "overlap must be in [0, 1)");
  require(record.excitations.rows() == record.responses.rows(), "channels differ in length");
  const auto block = Eigen::Index(std::lround(average.block_s * record.rate_Hz));
  require(block >= 16 && block <= record.responses.rows(),
          "a block must have 16 samples and fit into the record");
  require(record.excitations.allFinite() && record.responses.allFinite(),
          record.source + ": not finite");
  const auto step =
      std::max<Eigen::Index>(1, Eigen::Index(std::lround(double(block) * (1 - average.overlap))));
  const Eigen::ArrayXd window = hann(block);
  const auto windowed = [&](const Eigen::MatrixXd& samples, Eigen::Index from) {
    Eigen::MatrixXd part = samples.middleRows(from, block);
    part.rowwise() -= part.colwise().mean().eval();
    part.array().colwise() *= window;
    return part;
  };
  CrossSpectra sum =
      none_of(block, record.excitations.cols(), record.responses.cols(), record.rate_Hz);
  for (Eigen::Index from = 0; from + block <= record.responses.rows(); from += step) {
    add(sum, windowed(record.excitations, from), windowed(record.responses, from));
  }
  const double averages = independent_blocks(window, step, sum.records);
  return mean_of(std::move(sum), averages);
}

}  // namespace rvbench::analysis
