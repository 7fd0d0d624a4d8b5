#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "hal/types/measure.hpp"
#include "hal/types/require_positive.hpp"
#include "hal/types/utf8.hpp"

using namespace rvbench;

TEST_CASE("a value that must be positive is refused by name", "[hal][types]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK_NOTHROW(require_positive(1e-300, "CanBrake", "poll_s"));
  for (const double value : {0.0, -1.0, infinity, -infinity, std::nan("")}) {
    CAPTURE(value);
    CHECK_THROWS_AS(require_positive(value, "CanBrake", "poll_s"), std::invalid_argument);
  }
  CHECK_THROWS_WITH(require_positive(-1, "CanBrake", "poll_s"),
                    "CanBrake: poll_s is -1, must be finite and above 0");
}

TEST_CASE("a UTF-8 character is as long as RFC 3629 has it", "[hal][types]") {
  CHECK(utf8_character_bytes("A", 0) == 1);
  CHECK(utf8_character_bytes("m/s²", 3) == 2);
  CHECK(utf8_character_bytes("€", 0) == 3);
  CHECK(utf8_character_bytes("🔩", 0) == 4);
  CHECK(utf8_character_bytes("A", 1) == 0);             // behind the end
  CHECK(utf8_character_bytes("²", 1) == 0);             // in the middle
  CHECK(utf8_character_bytes("\xC1\xBF", 0) == 0);      // overlong
  CHECK(utf8_character_bytes("\xED\xBF\xBF", 0) == 0);  // a surrogate
  CHECK(utf8_character_bytes("\xE2\x82", 0) == 0);      // cut off
}

TEST_CASE("a measure is found by its name, and no other", "[hal][types]") {
  REQUIRE(find_measure("kurtosis") != nullptr);
  CHECK(find_measure("kurtosis")->units.front() == "1");
  CHECK(find_measure("efficiency")->worst_is_least);
  CHECK(find_measure("kurtosi") == nullptr);
  CHECK(find_measure("") == nullptr);
}

TEST_CASE("a value is told in another unit only where there is a way", "[hal][types]") {
  CHECK(in_unit(19.6133, "m/s²", "g") == Approx(2));  // 9.80665 m/s², by definition
  CHECK(in_unit(2, "g", "m/s²") == Approx(19.6133));
  CHECK(in_unit(3.14159265358979, "rad", "arcsec") == Approx(180 * 3600));
  CHECK(in_unit(180 * 3600, "arcsec", "rad") == Approx(3.14159265358979));
  CHECK(in_unit(5, "1", "1") == 5);
  CHECK(std::isnan(in_unit(5, "V", "g")));
  CHECK(std::isnan(in_unit(5, "", "g")));
}
