#include "analysis/tpa/frf_matrix.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace rvbench;
using namespace rvbench::analysis;
using Catch::Matchers::Contains;

namespace {

FrequencyResponse frf(const DegreeOfFreedom& response, const DegreeOfFreedom& excitation,
                      double value) {
  FrequencyResponse made;
  made.source = "hammer.csv";
  made.response = response;
  made.excitation = excitation;
  made.response_unit = "m/s²";
  made.excitation_unit = "N";
  made.first_Hz = 10;
  made.step_Hz = 2;
  made.values = Eigen::VectorXcd::Constant(3, {value, 1});
  made.coherence = Eigen::VectorXd::Constant(3, 0.8);
  made.averages = 5;
  return made;
}

std::vector<FrequencyResponse> two_by_two() {
  return {frf({"I1", "+X"}, {"J1", "+Z"}, 11), frf({"I1", "+X"}, {"J2", "+Z"}, 12),
          frf({"I2", "+X"}, {"J1", "+Z"}, 21), frf({"I2", "+X"}, {"J2", "+Z"}, 22)};
}

std::string all_faults(const AssembledFrfs& assembled) {
  std::string all;
  for (const std::string& fault : assembled.faults) all += fault + "\n";
  return all;
}

}  // namespace

TEST_CASE("responses of a test find their rows and columns in whatever order they come",
          "[analysis][tpa]") {
  std::vector<FrequencyResponse> set = two_by_two();
  std::swap(set[1], set[2]);
  const AssembledFrfs assembled = assemble_frf_matrix(set);
  REQUIRE(assembled.faults.empty());
  REQUIRE(assembled.matrix);
  const FrfMatrix& matrix = *assembled.matrix;
  CHECK(matrix.responses == std::vector<DegreeOfFreedom>{{"I1", "+X"}, {"I2", "+X"}});
  CHECK(matrix.excitations == std::vector<DegreeOfFreedom>{{"J1", "+Z"}, {"J2", "+Z"}});
  CHECK(matrix.frequency_Hz(2) == 14);
  for (Eigen::Index line = 0; line < 3; ++line) {
    CHECK(matrix.values[line](0, 1) == std::complex<double>(12, 1));
    CHECK(matrix.values[line](1, 0) == std::complex<double>(21, 1));
  }
  CHECK(matrix.notes.empty());
  // |H|²·(1 - 0.8)/(0.8·5), of the second row and first column
  CHECK(matrix.variances(1, 2) == Approx((21 * 21 + 1) * 0.05));
}

TEST_CASE("a sensor or hammer that pointed the other way changes the sign, and is noted",
          "[analysis][tpa]") {
  std::vector<FrequencyResponse> set = two_by_two();
  set[2].response.direction = set[3].response.direction = "-X";
  set[3].excitation.direction = "-Z";
  set[0].response.direction = "X";
  const AssembledFrfs assembled = assemble_frf_matrix(set);
  REQUIRE(assembled.matrix);
  CHECK(assembled.matrix->values[0](0, 0) == std::complex<double>(11, 1));
  CHECK(assembled.matrix->values[0](1, 0) == std::complex<double>(-21, -1));
  CHECK(assembled.matrix->values[0](1, 1) == std::complex<double>(22, 1));  // both turned
  CHECK(assembled.matrix->notes ==
        std::vector<std::string>{"response I2 -X is taken as I2 +X, with the other sign",
                                 "excitation J2 -Z is taken as J2 +Z, with the other sign"});
}

TEST_CASE("all faults of a set are told at once", "[analysis][tpa]") {
  std::vector<FrequencyResponse> set = two_by_two();
  set[1].step_Hz = 2.1;
  set[2].response_unit = "m/s";
  set[3] = set[0];
  set[3].values[1] = {0, std::numeric_limits<double>::infinity()};
  set[0].coherence[2] = 1.1;
  const AssembledFrfs assembled = assemble_frf_matrix(set);
  CHECK_FALSE(assembled.matrix);
  const std::string faults = all_faults(assembled);
  CHECK_THAT(faults, Contains("I1 +X per J2 +Z (hammer.csv): other lines than I1 +X per J1 +Z"));
  CHECK_THAT(faults, Contains("I2 +X per J1 +Z (hammer.csv): unit \"m/s\" where the first has"));
  CHECK_THAT(faults, Contains("I1 +X per J1 +Z (hammer.csv): not finite at line 1"));
  CHECK_THAT(faults, Contains("I1 +X per J1 +Z (hammer.csv): given twice"));
  CHECK_THAT(faults, Contains("coherence outside 0 to 1"));
  CHECK_THAT(faults, Contains("I2 +X per J2 +Z: missing"));
  CHECK(assembled.faults.size() == 6);
  CHECK(all_faults(assemble_frf_matrix({})) == "no frequency responses\n");
}

TEST_CASE("targets are put in the order of the paths, and must have all of them",
          "[analysis][tpa]") {
  const std::vector<FrequencyResponse> set = two_by_two();
  const AssembledFrfs turned = assemble_frf_matrix(set, {{"J2", "+Z"}, {"J1", "+Z"}});
  REQUIRE(turned.matrix);
  CHECK(turned.matrix->values[0](0, 0) == std::complex<double>(12, 1));
  const AssembledFrfs other = assemble_frf_matrix(set, {{"J1", "+Z"}, {"J3", "+Z"}});
  CHECK_THAT(all_faults(other), Contains("I2 +X per J2 +Z (hammer.csv): its excitation is none"));
  CHECK_THAT(all_faults(other), Contains("I1 +X per J3 +Z: missing"));
}

TEST_CASE("errors are not known where coherence or averages are not", "[analysis][tpa]") {
  std::vector<FrequencyResponse> set = two_by_two();
  set[2].averages = 0;
  const AssembledFrfs assembled = assemble_frf_matrix(set);
  REQUIRE(assembled.matrix);
  CHECK(assembled.matrix->variances.size() == 0);
}
