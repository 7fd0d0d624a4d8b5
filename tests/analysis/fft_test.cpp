#include "analysis/fft.hpp"

#include <catch2/catch.hpp>
#include <complex>
#include <vector>

#include "hal/types/parallel_for.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::fft;
using analysis::inverse_fft;

namespace {

// The definition, one line at a time.
Eigen::VectorXcd dft(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  Eigen::VectorXcd lines = Eigen::VectorXcd::Zero(n / 2 + 1);
  for (Eigen::Index k = 0; k < lines.size(); ++k) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto turns = static_cast<double>(i * k % n) / static_cast<double>(n);
      lines[k] += x[i] * std::polar(1.0, -2 * std::numbers::pi * turns);
    }
  }
  return lines;
}

}  // namespace

TEST_CASE("fft is the discrete Fourier transform, at any length", "[analysis][fft][law]") {
  for (const Eigen::Index n : {1, 2, 3, 4, 7, 64, 101, 360, 1009}) {
    CAPTURE(n);
    const Eigen::VectorXd x = test::white_noise(n, 1);
    CHECK((fft(x) - dft(x)).cwiseAbs().maxCoeff() < 1e-11);
    CHECK((inverse_fft(fft(x), n) - x).cwiseAbs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("of complex samples the transform is linear in both parts, and comes back",
          "[analysis][fft][law]") {
  for (const Eigen::Index n : {1, 2, 7, 64, 101}) {
    CAPTURE(n);
    const Eigen::VectorXd real = test::white_noise(n, 1), imaginary = test::white_noise(n, 2);
    const std::complex<double> i(0, 1);
    const Eigen::VectorXcd x = real.cast<std::complex<double>>() + i * imaginary;
    const Eigen::VectorXcd lines = analysis::complex_fft(x);
    const Eigen::VectorXcd expected = dft(real) + i * dft(imaginary);
    CHECK((lines.head(n / 2 + 1) - expected).cwiseAbs().maxCoeff() < 1e-11);
    CHECK((analysis::inverse_complex_fft(lines) - x).cwiseAbs().maxCoeff() < 1e-14);
  }
  CHECK(analysis::complex_fft({}).size() == 0);
}

TEST_CASE("fast lengths have no factor but 2, 3 and 5", "[analysis][fft]") {
  CHECK(analysis::next_fast_length(1) == 1);
  CHECK(analysis::next_fast_length(7) == 8);
  CHECK(analysis::next_fast_length(720) == 720);
  CHECK(analysis::next_fast_length(1009) == 1024);
  CHECK(analysis::next_fast_length(297601) == 300000);
  CHECK_THROWS_AS(analysis::next_fast_length(0), std::invalid_argument);
}

TEST_CASE("more lengths than plans are kept all come out right", "[analysis][fft]") {
  for (int round = 0; round < 2; ++round) {
    for (Eigen::Index n = 2; n < 100; ++n) {
      const Eigen::VectorXd x = test::white_noise(n, 2);
      CHECK((inverse_fft(fft(x), n) - x).cwiseAbs().maxCoeff() < 1e-14);
    }
  }
}

TEST_CASE("an inverse of the wrong size is refused", "[analysis][fft][errors]") {
  CHECK_THROWS_AS(inverse_fft(Eigen::VectorXcd::Zero(5), 10), std::invalid_argument);
  CHECK_THROWS_AS(inverse_fft(Eigen::VectorXcd::Zero(1), 0), std::invalid_argument);
}

TEST_CASE("neither threads nor memory addresses change a bit", "[analysis][fft][threads]") {
  const Eigen::VectorXd x = test::white_noise(5003, 3);
  const std::vector<Eigen::Index> lengths{1024, 1009, 4960, 5000};
  std::vector<Eigen::VectorXcd> alone, together(32);
  for (const Eigen::Index n : lengths) alone.push_back(fft(x.head(n)));

  parallel_for(
      together.size(), [&](std::size_t i) { together[i] = fft(x.head(lengths[i % 4])); }, 4);
  for (std::size_t i = 0; i < together.size(); ++i) CHECK(together[i] == alone[i % 4]);

  Eigen::VectorXd shifted(x.size() + 1);
  shifted.tail(x.size()) = x;  // aligned differently from x
  CHECK(fft(shifted.segment(1, 4960)) == alone[2]);
}

TEST_CASE("a plan that makes room for another is not lost to a thread that uses it",
          "[analysis][fft][threads]") {
  constexpr std::size_t lengths = 100;  // more than there are plans kept
  std::vector<Eigen::VectorXcd> alone(lengths), at_once(lengths);
  const auto transformed = [](std::size_t i) {
    return fft(test::white_noise(static_cast<Eigen::Index>(i % 70 + 30), 3));
  };
  for (std::size_t i = 0; i < lengths; ++i) alone[i] = transformed(i);
  parallel_for(
      lengths, [&](std::size_t i) { at_once[i] = transformed(i); }, 4);
  for (std::size_t i = 0; i < lengths; ++i) CHECK(at_once[i] == alone[i]);
}
