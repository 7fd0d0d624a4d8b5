#include "bench/status_line.hpp"

#include <catch2/catch.hpp>
#include <sstream>

namespace rvbench::bench {

SCENARIO("a status line is written anew once a second, above what somebody types",
         "[bench][console]") {
  std::ostringstream out, err;
  double now_s = 0;
  GIVEN("a terminal") {
    Console console{out, err, false, true};
    StatusLine status(console, [&] { return now_s; });
    status.show("shaft 605 rpm");
    CHECK(err.str() == "shaft 605 rpm\n");
    WHEN("a second has not passed") {
      now_s = 0.9;
      CHECK_FALSE(status.is_due());
      status.show("shaft 700 rpm");
      CHECK(err.str() == "shaft 605 rpm\n");
    }
    WHEN("it has, the cursor goes up and comes back") {
      now_s = 1;
      status.show("shaft 700 rpm");
      CHECK(err.str() ==
            "shaft 605 rpm\n\x1b"
            "7\x1b[1A\rshaft 700 rpm\x1b[K\x1b"
            "8");
    }
    WHEN("something was printed meanwhile") {
      now_s = 1;
      status.move_down();
      status.show("shaft 700 rpm");
      CHECK(err.str() == "shaft 605 rpm\nshaft 700 rpm\n");
    }
  }
  GIVEN("a file") {
    Console console{out, err};
    StatusLine status(console, [&] { return now_s; });
    CHECK_FALSE(status.is_due());
    status.show("shaft 605 rpm");
    CHECK(err.str().empty());
  }
  CHECK(out.str().empty());
}

}  // namespace rvbench::bench
