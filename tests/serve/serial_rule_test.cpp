#include "bench/serve/serial_rule.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "bench/serve/check_digit.hpp"

namespace rvbench::bench {

TEST_CASE("a check digit tells a number that was misread", "[bench][serve][literature]") {
  SECTION("mod10: the example that texts on Luhn's formula share") {
    CHECK(has_right_check_digit("mod10", "79927398713"));
    for (char last = '0'; last <= '9'; ++last) {
      CHECK(has_right_check_digit("mod10", std::string("7992739871") + last) == (last == '3'));
    }
    CHECK_FALSE(has_right_check_digit("mod10", "79927389713"));  // two digits changed places
    CHECK(has_right_check_digit("mod10", "7992-7398-713"));
    CHECK_FALSE(has_right_check_digit("mod10", "A79927398713"));
  }
  SECTION("mod43: Code 39's 12345ABCDE/ has the check character T") {
    CHECK(has_right_check_digit("mod43", "12345ABCDE/T"));
    CHECK_FALSE(has_right_check_digit("mod43", "12345ABCDE/U"));
    CHECK_FALSE(has_right_check_digit("mod43", "12345abcde/T"));
  }
  SECTION("mod11_2: ORCID's and ISNI's own examples") {
    CHECK(has_right_check_digit("mod11_2", "0000-0002-1825-0097"));
    CHECK(has_right_check_digit("mod11_2", "0000 0001 2281 955X"));
    CHECK_FALSE(has_right_check_digit("mod11_2", "0000-0002-1825-0079"));
  }
  SECTION("nothing is checked by nothing") {
    for (const char* scheme : {"mod10", "mod43", "mod11_2"}) {
      CHECK_FALSE(has_right_check_digit(scheme, ""));
      CHECK_FALSE(has_right_check_digit(scheme, "0"));
    }
    CHECK(has_right_check_digit("none", "whatever"));
    CHECK_THROWS_AS(has_right_check_digit("mod97", "1"), std::invalid_argument);
  }
}

TEST_CASE("a mask says what a serial number looks like, character by character", "[bench][serve]") {
  CHECK(fits_mask("RV20E-####", "RV20E-0042"));
  CHECK_FALSE(fits_mask("RV20E-####", "RV20E-042"));
  CHECK_FALSE(fits_mask("RV20E-####", "RV20E-00421"));
  CHECK_FALSE(fits_mask("RV20E-####", "RV20E-004A"));
  CHECK(fits_mask("@#*", "A1Z"));
  CHECK_FALSE(fits_mask("@#*", "a1Z"));
  CHECK_FALSE(fits_mask("@#*", "A1-"));
}

TEST_CASE("what is scanned is a serial number, or the station says why not", "[bench][serve]") {
  const SerialRule any;
  CHECK(serial_fault(any, "A17").empty());
  CHECK(serial_fault(any, "") == "empty");
  CHECK(serial_fault(any, "A\n17") == "serial_rule");
  CHECK(serial_fault(any, std::string(64, 'A')).empty());
  CHECK(serial_fault(any, std::string(65, 'A')) == "serial_rule");
  CHECK(serial_fault(any, "\xc3\xa4") == "serial_rule");
  const SerialRule strict{{"##########", "A-#########"}, "mod10"};
  CHECK(serial_fault(strict, "A-799273987") == "check_digit");
  CHECK(serial_fault(strict, "1234567897").empty());
  CHECK(serial_fault(strict, "1234567890") == "check_digit");
  CHECK(serial_fault(strict, "12345") == "serial_rule");
  CHECK(scanned_serial("\tA17\r\n") == "A17");
  CHECK(scanned_serial(" \r\n").empty());
}

}  // namespace rvbench::bench
