#include <catch2/catch.hpp>
#include <random>

#include "analysis/frf/direction_doubts.hpp"
#include "analysis/frf/driving_point.hpp"
#include "analysis/frf/reciprocity.hpp"
#include "tests/analysis/frf/two_masses.hpp"

using namespace rvbench;
using namespace rvbench::analysis;

namespace {

const test::TwoMasses body;
const std::vector<double> resonances_Hz{body.first_Hz, body.second_Hz};
constexpr FrfBand band{5, 120};

FrequencyResponse two_masses(int to, int at) {
  return test::accelerance_of(body, to, at, 0.25, 512);
}

/// Three points with X and Y each, all 36 responses; reciprocal, as any sum of modes is.
std::vector<FrequencyResponse> three_points(unsigned seed = 1) {
  constexpr int n = 6, modes = 8;
  std::mt19937 engine(seed);
  std::normal_distribution<double> gaussian;
  const Eigen::MatrixXd shapes = Eigen::MatrixXd::NullaryExpr(
      n, modes, [&](Eigen::Index, Eigen::Index) { return gaussian(engine); });
  const auto place = [](int i) {
    return DegreeOfFreedom{"P" + std::to_string(i / 2 + 1), i % 2 == 0 ? "+X" : "+Y"};
  };
  std::vector<FrequencyResponse> all;
  for (int to = 0; to < n; ++to) {
    for (int at = 0; at < n; ++at) {
      FrequencyResponse frf{"modes", place(to), place(at), "m/s²", "N", 0, 0.25, {}, {}, 0, {}};
      frf.values = Eigen::VectorXcd::NullaryExpr(512, [&](Eigen::Index k) {
        const auto s = test::j_omega(0.25 * double(k));
        std::complex<double> sum = 0;
        for (int m = 0; m < modes; ++m) {
          const double w = units::two_pi * (15 + 12 * m);
          sum += shapes(to, m) * shapes(at, m) * s * s / (s * s + 0.02 * w * s + w * w);
        }
        return sum;
      });
      all.push_back(std::move(frf));
    }
  }
  return all;
}

bool is_at(const DegreeOfFreedom& place, const char* point, const char* direction) {
  return place.point == point && place.direction == direction;
}

}  // namespace

SCENARIO("a driving point takes up power", "[analysis][frf]") {
  GIVEN("the left mass struck and listened to") {
    const auto point = check_driving_point(two_masses(0, 0), band, resonances_Hz);
    THEN("it is sound, with an antiresonance between its resonances") {
      REQUIRE(point);
      CHECK(point->word == DrivingPointWord::sound);
      CHECK(point->positive_share == Approx(1));
      CHECK(point->without_antiresonance.empty());
    }
  }
  GIVEN("its sensor turned round") {
    FrequencyResponse frf = two_masses(0, 0);
    frf.values *= -1;
    THEN("it is reversed, unless the direction says so") {
      CHECK(check_driving_point(frf, band, resonances_Hz)->word == DrivingPointWord::reversed);
      CHECK(check_driving_point(frf, band, resonances_Hz)->without_antiresonance.empty());
      frf.response.direction = "-X";
      CHECK(check_driving_point(frf, band, resonances_Hz)->word == DrivingPointWord::sound);
    }
  }
  GIVEN("the right mass' answer, said to be the left one's") {
    FrequencyResponse frf = two_masses(1, 0);
    frf.response = frf.excitation;
    const auto point = check_driving_point(frf, band, resonances_Hz);
    THEN("it is doubtful, and the antiresonance is missed") {
      CHECK(point->word == DrivingPointWord::doubtful);
      REQUIRE(point->without_antiresonance.size() == 1);
      CHECK(point->without_antiresonance[0] == std::pair(40.0, 65.0));
    }
  }
  GIVEN("two places, or a pressure") {
    THEN("there is nothing to check") {
      CHECK_FALSE(check_driving_point(two_masses(1, 0), band, {}));
      FrequencyResponse frf = two_masses(0, 0);
      frf.response_unit = "Pa";
      CHECK_FALSE(check_driving_point(frf, band, {}));
    }
  }
}

TEST_CASE("reciprocity is scored per line and over a band", "[analysis][frf]") {
  const FrequencyResponse there = two_masses(1, 0);
  FrequencyResponse back = two_masses(0, 1);
  CHECK(reciprocity(there, back, band).band_score == Approx(1));
  CHECK(reciprocity(there, back, band).score.size() == 461);  // 5 to 120 Hz by 0.25
  back.values *= -1;
  CHECK(reciprocity(there, back, band).band_score == Approx(-1));
  back.values *= -2;
  CHECK(reciprocity(there, back, band).score.isApprox(Eigen::VectorXd::Constant(461, 0.8)));
  back.values *= std::complex<double>(0, 1);
  CHECK(reciprocity(there, back, band).band_score == Approx(0).margin(1e-12));
  back.step_Hz = 0.5;
  CHECK_THROWS_AS(reciprocity(there, back, band), std::invalid_argument);
}

SCENARIO("wrong directions are named", "[analysis][frf]") {
  std::vector<FrequencyResponse> all = three_points();
  GIVEN("all as it should be, some of it stated against the axis") {
    for (FrequencyResponse& frf : all) {
      if (!is_at(frf.response, "P2", "+X")) continue;
      frf.response.direction = "-X";
      frf.values *= -1;
    }
    THEN("nothing is doubted") { CHECK(direction_doubts(all, band).empty()); }
  }
  GIVEN("the sensor at P2, Y turned round") {
    for (FrequencyResponse& frf : all) {
      if (is_at(frf.response, "P2", "+Y")) frf.values *= -1;
    }
    THEN("it is named, and nothing else") {
      const auto doubts = direction_doubts(all, band);
      REQUIRE(doubts.size() == 1);
      CHECK(doubts[0].kind == DirectionDoubtKind::reversed_sign);
      CHECK(doubts[0].place == DegreeOfFreedom{"P2", "Y"});
    }
    THEN("it is named without its driving point as well") {
      std::erase_if(all,
                    [](const FrequencyResponse& frf) { return frf.response == frf.excitation; });
      const auto doubts = direction_doubts(all, band);
      REQUIRE(doubts.size() == 1);
      CHECK(doubts[0].place == DegreeOfFreedom{"P2", "Y"});
    }
  }
  GIVEN("X and Y of the sensor at P3 plugged into each other's channel") {
    for (FrequencyResponse& frf : all) {
      if (frf.response.point == "P3") {
        frf.response.direction = frf.response.direction == "+X" ? "+Y" : "+X";
      }
    }
    THEN("the exchange is named, and nothing else") {
      const auto doubts = direction_doubts(all, band);
      for (const DirectionDoubt& doubt : doubts) UNSCOPED_INFO(doubt.reason);
      REQUIRE(doubts.size() == 1);
      CHECK(doubts[0].kind == DirectionDoubtKind::swapped_axes);
      CHECK(doubts[0].place == DegreeOfFreedom{"P3", "X"});
      CHECK(doubts[0].other_axis == "Y");
    }
  }
  GIVEN("one response that is another structure's") {
    const std::vector<FrequencyResponse> other = three_points(2);
    all[2] = other[2];  // P1 X to P2 X
    THEN("the pair is named as not reciprocal") {
      const auto doubts = direction_doubts(all, band);
      REQUIRE(doubts.size() == 1);
      CHECK(doubts[0].kind == DirectionDoubtKind::not_reciprocal);
      CHECK(doubts[0].place == DegreeOfFreedom{"P1", "X"});
    }
  }
  GIVEN("a weak pair across axes, and hits on one of its places that lean") {
    const auto leaning = [&](double lean_rad) {
      std::vector<FrequencyResponse> hit = all;
      for (FrequencyResponse& frf : hit) {
        const bool is_pair =
            (is_at(frf.response, "P1", "+X") && is_at(frf.excitation, "P2", "+Y")) ||
            (is_at(frf.response, "P2", "+Y") && is_at(frf.excitation, "P1", "+X"));
        if (is_pair) frf.values *= 0.02;
      }
      for (std::size_t i = 0; i < hit.size(); ++i) {
        if (!is_at(hit[i].excitation, "P2", "+Y")) continue;
        hit[i].values += lean_rad * all[i - 1].values;  // the same response to P2 X
      }
      return direction_doubts(hit, band);
    };
    THEN("a lean as hits have it is not doubted") { CHECK(leaning(0.05).empty()); }
    THEN("one beyond is") { CHECK_FALSE(leaning(0.4).empty()); }
  }
  GIVEN("two places only, one of them reversed") {
    std::vector<FrequencyResponse> pair{two_masses(1, 0), two_masses(0, 1)};
    pair[0].values *= -1;
    THEN("one of the two is, and it is not said which") {
      const auto doubts = direction_doubts(pair, band);
      REQUIRE(doubts.size() == 1);
      CHECK(doubts[0].reason.find("one of the two") != std::string::npos);
    }
  }
  GIVEN("nothing") {
    THEN("nothing is doubted") { CHECK(direction_doubts({}, band).empty()); }
  }
}
