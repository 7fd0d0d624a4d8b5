#include "hal/formats/start_time.hpp"

#include <catch2/catch.hpp>
#include <cmath>

// Known answers are those of GNU date.
namespace rvbench::hal::formats {

TEST_CASE("a start time is ISO 8601, in UTC, and reads back", "[hal][formats]") {
  CHECK(utc_text(1476442277) == "2016-10-14T10:51:17.000000Z");
  CHECK(utc_text(951782400.25) == "2000-02-29T00:00:00.250000Z");
  CHECK(utc_text(-1) == "1969-12-31T23:59:59.000000Z");
  CHECK(utc_text(0.9999999) == "1970-01-01T00:00:01.000000Z");
  CHECK(utc_of_text("2016-10-14T10:51:17.000000Z") == 1476442277);
  CHECK(utc_of_text("1969-12-31T23:59:59Z") == -1);
  CHECK(utc_text(not_known).empty());
  CHECK(utc_text(1e300).empty());
}

TEST_CASE("what is no time is none", "[hal][formats]") {
  for (const char* text : {"", "2016-10-14", "2016-13-14T10:51:17Z", "2015-02-29T00:00:00Z",
                           "2016-10-14T25:51:17Z", "2016-10-14T10:51:17", "2016-10-14T10:51:17ZZ",
                           "2016-10-14T10:51:nanZ", "-016-10-14T10:51:17Z"}) {
    CAPTURE(text);
    CHECK(std::isnan(utc_of_text(text)));
  }
  for (const char* text : {"", "NONE", "14-Okt-16 10:51:17", "14-Oct-16", "31-Feb-16 10:51:17"}) {
    CAPTURE(text);
    CHECK(std::isnan(utc_of_uff_date(text)));
  }
}

TEST_CASE("universal files have years of two digits", "[hal][formats]") {
  CHECK(uff_date(1476442277) == "14-Oct-16 10:51:17");
  CHECK(uff_date(1476442277.9) == "14-Oct-16 10:51:17.900000");
  CHECK(utc_of_uff_date("14-Oct-16 10:51:17.900000") == 1476442277.9);
  CHECK(utc_of_uff_date("14-Oct-16 10:51:17") == 1476442277);
  CHECK(uff_date(utc_of_uff_date("08-Jan-99 00:00:00")) == "08-Jan-99 00:00:00");
  CHECK(uff_date(not_known).empty());
}

TEST_CASE("a recording's start is among its notes, once it is known", "[hal][formats]") {
  Recording recording;
  CHECK(std::isnan(noted_start_s(recording)));
  note_start(not_known, recording);
  CHECK(recording.notes.empty());
  note_start(1476442277, recording);
  CHECK(recording.notes == std::vector<std::string>{"started 2016-10-14T10:51:17.000000Z"});
  CHECK(noted_start_s(recording) == 1476442277);
}

}  // namespace rvbench::hal::formats
