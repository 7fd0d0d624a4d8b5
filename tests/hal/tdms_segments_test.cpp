#include <catch2/catch.hpp>
#include <ctime>

#include "hal/formats/read_recordings.hpp"
#include "tests/hal/tdms_builder.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::Tdms;

const std::string a = "/'G'/'a'";

Recording read(const std::string& bytes) { return test::recordings_in("a.tdms", bytes)[0]; }

}  // namespace

TEST_CASE("TDMS: a pause between segments is INVALID, and the first start stays",
          "[hal][formats]") {
  const Tdms tdms;
  const auto at = [&](std::int64_t seconds, std::uint64_t fraction) {
    return tdms.text("wf_start_time") + tdms.number(0x44U) + tdms.number(fraction) +
           tdms.number(seconds + 2082844800);
  };
  const auto segment = [&](const std::vector<std::string>& properties) {
    return tdms.segment({tdms.object(a, tdms.index(10, 4), properties)},
                        tdms.numbers<double>({1, 2, 3, 4}));
  };
  const std::string interval = tdms.property("wf_increment", 0.125);
  const std::string first = segment({at(1476442277, 0), interval});
  const std::string half_a_second_on = at(1476442277, 0x8000000000000000);

  const Recording whole = read(first + segment({half_a_second_on, interval}) + segment({}));
  CHECK(whole.status == "ok");
  CHECK(whole.notes == std::vector<std::string>{"started 2016-10-14T10:51:17.000000Z"});
  CHECK(read(first + segment({at(1476442277, 0)})).status == "ok");  // said once more

  const Recording paused = read(first + segment({at(1476442280, 0), interval}));
  CHECK(paused.status == "INVALID: a: 2.5 s are missing behind its sample 4");
  CHECK(paused.notes == whole.notes);
  CHECK(paused.find("a")->samples.size() == 8);
  CHECK(read(first + segment({at(1476442277, 0x4000000000000000)})).status ==
        "INVALID: a: 0.25 s are there twice behind its sample 4");
  const std::string bare = tdms.segment({tdms.object(a, tdms.same_index(), {at(1476442279, 0)})},
                                        "", 2 | 4);  // of values to come
  CHECK_THAT(read(first + bare + segment({})).status, Contains("1.5 s are missing"));

  const Recording slower = read(first + segment({tdms.property("wf_increment", 0.25)}));
  CHECK(slower.status ==
        "INVALID: a: from 0.125 s its sample interval becomes 0.25 s behind its sample 4");
  CHECK(slower.find("a")->rate_Hz == 8);
}

TEST_CASE("TDMS: channels without values cost no time", "[hal][formats]") {
  const Tdms tdms;
  std::vector<std::string> objects = {tdms.object(a, tdms.index(5, 1))};
  for (int i = 0; i < 10000; ++i) {
    objects.push_back(tdms.object(fmt::format("/'G'/'{}'", i), tdms.index(5, 0)));
  }
  const std::clock_t begun = std::clock();
  const Recording recording = read(tdms.segment(objects, std::string(500000, '\1')));
  CHECK(recording.find("a")->samples.sum() == 500000);
  // Half a second here; each of them asked for each value was a minute.
  CHECK(static_cast<double>(std::clock() - begun) < 10.0 * CLOCKS_PER_SEC);
}

}  // namespace rvbench::hal
