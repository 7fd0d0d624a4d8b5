#include "analysis/frf/frf_estimate.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/signals.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using test::white_noise;

namespace {

constexpr double rate_Hz = 1000;
constexpr Eigen::Index block = 256;
constexpr Eigen::Index lines = 120;  // without the first and last ones, where the mean is taken out

FrfSetup channels(std::size_t excitations, std::size_t responses) {
  FrfSetup setup;
  for (std::size_t i = 0; i < excitations; ++i) setup.excitations.push_back({{"in", "+X"}, "N"});
  for (std::size_t i = 0; i < responses; ++i) setup.responses.push_back({{"out", "+X"}, "m/s²"});
  return setup;
}

/// A gain of 2, of white force, with white noise of given power on either channel.
struct GainOfTwo {
  double force_noise = 0, response_noise = 0;
  int blocks = 100;
  unsigned seed = 1;
  double overlap = 0;

  EstimatedResponse estimated(FrfEstimator estimator) const {
    const Eigen::Index n = block * blocks;
    const Eigen::VectorXd force = white_noise(n, seed);
    const FrfRecord record{"gain", rate_Hz,
                           force + std::sqrt(force_noise) * white_noise(n, seed + 100000),
                           2 * force + std::sqrt(response_noise) * white_noise(n, seed + 200000)};
    const CrossSpectra spectra =
        block_spectra(record, {.block_s = block / rate_Hz, .overlap = overlap});
    return estimate_responses(spectra, channels(1, 1), estimator, "test").responses.at(0);
  }

  std::complex<double> mean(FrfEstimator estimator) const {
    return estimated(estimator).response.values.segment(4, lines).mean();
  }
};

}  // namespace

// 120 lines of 400 blocks: the mean is known within a few tenths of a percent.
SCENARIO("noise biases each estimator as the closed form says", "[analysis][frf]") {
  GIVEN("noise on the force, a quarter of its power") {
    const GainOfTwo gain{.force_noise = 0.25, .blocks = 400};
    THEN("H1 is low by 1 + 1/SNR, H2 is right, Hv is their geometric mean") {
      CHECK(std::abs(gain.mean(FrfEstimator::h1)) == Approx(2 / 1.25).epsilon(0.01));
      CHECK(std::abs(gain.mean(FrfEstimator::h2)) == Approx(2).epsilon(0.01));
      CHECK(std::abs(gain.mean(FrfEstimator::hv)) == Approx(2 / std::sqrt(1.25)).epsilon(0.01));
      CHECK(gain.estimated(FrfEstimator::h1).response.coherence.segment(4, lines).mean() ==
            Approx(1 / 1.25).epsilon(0.01));
    }
  }
  GIVEN("noise on the response, half of its power") {
    const GainOfTwo gain{.response_noise = 2, .blocks = 400};
    THEN("H1 is right, H2 is high by 1 + 1/SNR, Hv is their geometric mean") {
      CHECK(std::abs(gain.mean(FrfEstimator::h1)) == Approx(2).epsilon(0.01));
      CHECK(std::abs(gain.mean(FrfEstimator::h2)) == Approx(2 * 1.5).epsilon(0.01));
      CHECK(std::abs(gain.mean(FrfEstimator::hv)) == Approx(2 * std::sqrt(1.5)).epsilon(0.01));
    }
  }
  GIVEN("no noise") {
    const GainOfTwo gain{.blocks = 10};
    THEN("all are exact, of coherence 1 and without error") {
      for (const auto e : {FrfEstimator::h1, FrfEstimator::h2, FrfEstimator::hv}) {
        const EstimatedResponse pair = gain.estimated(e);
        CHECK((pair.response.values.array() - 2).abs().maxCoeff() < 1e-10);
        CHECK(pair.response.coherence.minCoeff() > 1 - 1e-12);
        CHECK(pair.standard_error.maxCoeff() < 1e-6);
      }
    }
  }
}

// The scatter of 120 lines of 20 records has 2400 complex errors; a standard deviation of their
// power is 2 %, more where blocks overlap, for then they share samples.
TEST_CASE("the standard error is the scatter that repetition shows", "[analysis][frf]") {
  const double overlap = GENERATE(0.0, 0.5, 0.75);
  const auto estimator = GENERATE(FrfEstimator::h1, FrfEstimator::h2, FrfEstimator::hv);
  const double bias = estimator == FrfEstimator::h1   ? 1
                      : estimator == FrfEstimator::h2 ? 1.25
                                                      : std::sqrt(1.25);
  double scatter = 0, said = 0;
  int outside = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const EstimatedResponse pair =
        GainOfTwo{.response_noise = 1, .blocks = 40, .seed = seed, .overlap = overlap}.estimated(
            estimator);
    const Eigen::VectorXd radius = confidence_radius(pair, 0.1);
    for (Eigen::Index k = 4; k < 4 + lines; ++k) {
      const double error = std::abs(pair.response.values[k] - 2 * bias);
      scatter += error * error / 2;
      said += pair.standard_error[k] * pair.standard_error[k];
      outside += error > radius[k] ? 1 : 0;
    }
  }
  CAPTURE(overlap, to_string(estimator));
  // Of a coherence of 0.8 the magnitude of Hv is surer than is said, by the coherence.
  const double surer = estimator == FrfEstimator::hv ? (1 + 0.8) / 2 : 1;
  CHECK(said * surer / scatter == Approx(1).margin(0.1));
  if (estimator == FrfEstimator::h1) {
    CHECK(outside / (20.0 * lines) == Approx(0.1).margin(0.025));
  }
}

TEST_CASE("blocks that overlap by half are worth 18/19 of their number", "[analysis][frf]") {
  // Welch: the windows' correlation is 1/6, so K/(1 + 2(1 - 1/K)/36).
  const FrfRecord record{"noise", rate_Hz, white_noise(block * 20, 1), white_noise(block * 20, 2)};
  const CrossSpectra spectra = block_spectra(record, {.block_s = block / rate_Hz, .overlap = 0.5});
  CHECK(spectra.records == 39);
  CHECK(spectra.averages == Approx(39 / (1 + 2 * (1 - 1.0 / 39) / 36)).epsilon(1e-3));
}

TEST_CASE("what has nothing to do with the force has a coherence of 1/n", "[analysis][frf]") {
  // Of n averages without any relation the coherence is beta distributed with a mean of 1/n.
  const FrfRecord record{"noise", rate_Hz, white_noise(block * 50, 1), white_noise(block * 50, 2)};
  const CrossSpectra spectra = block_spectra(record, {.block_s = block / rate_Hz, .overlap = 0});
  const EstimatedResponse pair =
      estimate_responses(spectra, channels(1, 1), FrfEstimator::h1, "").responses[0];
  CHECK(pair.response.coherence.segment(4, lines).mean() == Approx(1.0 / 50).epsilon(0.25));
  CHECK((pair.response.values.cwiseAbs().array() < confidence_radius(pair, 1e-4).array())
            .segment(4, lines)
            .all());
}

SCENARIO("shakers at work at once are told apart", "[analysis][frf]") {
  constexpr Eigen::Index n = block * 200;
  Eigen::MatrixXd forces(n, 3);
  for (unsigned i = 0; i < 3; ++i) forces.col(i) = (1 + i) * white_noise(n, 10 + i);
  Eigen::MatrixXd gains(2, 3);
  gains << 1, -2, 0.5, 3, 0, -1;
  Eigen::MatrixXd answers = forces * gains.transpose();
  answers.col(1) += 3 * white_noise(n, 20);
  const FrfSetup setup = channels(3, 2);
  const BlockAverage average{.block_s = block / rate_Hz, .overlap = 0};
  GIVEN("forces without relation, one response without and one with noise") {
    const CrossSpectra spectra = block_spectra({"three", rate_Hz, forces, answers}, average);
    for (const auto estimator : {FrfEstimator::h1, FrfEstimator::hv}) {
      const FrfEstimates all = estimate_responses(spectra, setup, estimator, "");
      THEN("each gain is found, of response 0 exactly, of response 1 within its error, " +
           std::string(to_string(estimator))) {
        REQUIRE(all.responses.size() == 6);
        for (int j = 0; j < 3; ++j) {
          const EstimatedResponse& exact = all.responses[std::size_t(j)];
          CHECK((exact.response.values.array() - gains(0, j)).abs().maxCoeff() < 1e-8);
          CHECK(exact.response.coherence.minCoeff() > 1 - 1e-9);
        }
        // Multiple coherence: signal 9·1 + 0 + 1·9 = 18 over 18 + 9.
        CHECK(all.responses[3].response.coherence.segment(4, lines).mean() ==
              Approx(18.0 / 27).epsilon(0.02));
      }
    }
    THEN("errors of the noisy one are what they are said to be") {
      const FrfEstimates all = estimate_responses(spectra, setup, FrfEstimator::h1, "");
      for (int j = 0; j < 3; ++j) {
        const EstimatedResponse& pair = all.responses[std::size_t(3 + j)];
        const Eigen::ArrayXd error =
            (pair.response.values.array() - gains(1, j)).abs().segment(4, lines);
        const Eigen::ArrayXd said = pair.standard_error.array().segment(4, lines);
        CHECK(said.square().sum() / (error.square().sum() / 2) == Approx(1).margin(0.3));
        CHECK(said.mean() == Approx(std::sqrt(9.0 / (2 * 197)) / (1 + j)).epsilon(0.05));
      }
      CHECK(all.independence.segment(4, lines).minCoeff() > 0.6);
    }
  }
  GIVEN("one force that follows another for the most part") {
    forces.col(2) = forces.col(0) + 0.3 * white_noise(n, 13);
    const FrfEstimates all = estimate_responses(
        block_spectra({"three", rate_Hz, forces, answers}, average), setup, FrfEstimator::h1, "");
    THEN("independence says so: of two, 1 - correlation") {
      CHECK(all.independence.segment(4, lines).mean() ==
            Approx(1 - 1 / std::sqrt(1.09)).epsilon(0.1));
    }
  }
  GIVEN("one force that is another one's double") {
    forces.col(2) = 2 * forces.col(0);
    const FrfEstimates all = estimate_responses(
        block_spectra({"three", rate_Hz, forces, answers}, average), setup, FrfEstimator::h1, "");
    THEN("nothing is made up: not a number, and a note") {
      CHECK(all.responses[0].response.values.real().array().isNaN().all());
      REQUIRE(all.responses[0].response.notes.size() == 1);
      CHECK(all.independence.maxCoeff() < 1e-9);
    }
  }
}

TEST_CASE("the confidence radius of known quantiles", "[analysis][frf]") {
  EstimatedResponse pair;
  pair.standard_error = Eigen::VectorXd::Ones(1);
  pair.freedom = 10;
  // scipy.stats.f.isf(0.05, 2, 20) is 3.492828; radius² = 2·s²·F
  CHECK(confidence_radius(pair, 0.05)[0] == Approx(std::sqrt(2 * 3.492828)).epsilon(1e-6));
  pair.freedom = 1e9;  // Rayleigh
  CHECK(confidence_radius(pair, 0.05)[0] == Approx(std::sqrt(-2 * std::log(0.05))).epsilon(1e-6));
  pair.freedom = 0;
  CHECK(std::isnan(confidence_radius(pair, 0.05)[0]));
  CHECK_THROWS_AS(confidence_radius(pair, 0), std::invalid_argument);
}

TEST_CASE("what cannot be averaged throws", "[analysis][frf]") {
  const FrfRecord record{"noise", rate_Hz, white_noise(512, 1), white_noise(512, 2)};
  CHECK_THROWS_AS(hit_spectra({}), std::invalid_argument);
  CHECK_THROWS_AS(block_spectra(record, {.block_s = 1}), std::invalid_argument);
  CHECK_THROWS_AS(block_spectra(record, {.block_s = 0.1, .overlap = 1}), std::invalid_argument);
  FrfRecord other = record;
  other.rate_Hz = 2000;
  CHECK_THROWS_AS(hit_spectra({record, other}), std::invalid_argument);
  other = record;
  other.responses(3, 0) = std::nan("");
  CHECK_THROWS_AS(hit_spectra({other}), std::invalid_argument);
  const CrossSpectra spectra = hit_spectra({record});
  CHECK_THROWS_AS(estimate_responses(spectra, channels(2, 1), FrfEstimator::h1, ""),
                  std::invalid_argument);
}
