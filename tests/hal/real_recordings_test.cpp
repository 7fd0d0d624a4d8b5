#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "hal/formats/read_recordings.hpp"
#include "tests/support/real_data.hpp"

// Expected numbers are what scipy.io.loadmat, and a text editor, show for these files.
namespace rvbench::hal {
namespace {

using test::data_folder;

Recording read_one(const std::filesystem::path& file) {
  auto read = read_recordings(file);
  REQUIRE(read);
  REQUIRE(read.value().size() == 1);
  return std::move(read).value().front();
}

}  // namespace

TEST_CASE("bearing recordings of the CWRU rig", "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const Recording inner = read_one(*folder / "cwru/IR007_0.mat");
  REQUIRE(inner.channels.size() == 3);
  CHECK(inner.channels[0].info.name == "X105_DE_time");
  CHECK(inner.channels[0].samples.size() == 121265);
  CHECK(inner.channels[0].rate_Hz == 0);  // no file of this rig states it
  CHECK(inner.channels[0].info.unit.empty());
  CHECK(inner.channels[0].samples[1] == Approx(-0.19573433).epsilon(1e-6));
  CHECK(inner.find("X105_BA_time")->samples[121264] == Approx(-0.02015893).epsilon(1e-6));
  CHECK(inner.speed_rpm == 1797);

  const Recording normal = read_one(*folder / "cwru/normal_0.mat");
  REQUIRE(normal.channels.size() == 2);
  CHECK(normal.find("X097_DE_time")->samples.size() == 243938);
  CHECK(normal.find("X097_DE_time")->samples[1] == Approx(0.08866154).epsilon(1e-6));
  CHECK(normal.speed_rpm == 1796);
}

TEST_CASE("gear recordings that hold each variable twice", "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const Recording gear = read_one(*folder / "gear0/3027_217_Data_Chan1.mat");
  REQUIRE(gear.channels.size() == 1);
  CHECK(gear.channels[0].info.name == "Data1");
  CHECK(gear.channels[0].rate_Hz == 25600);
  REQUIRE(gear.channels[0].samples.size() == 282624);
  CHECK(gear.channels[0].samples[0] == Approx(-2.500976).epsilon(1e-6));
  CHECK(gear.channels[0].samples[4] == Approx(2.691591).epsilon(1e-6));
  CHECK(std::isnan(gear.speed_rpm));
  REQUIRE(gear.notes.size() == 2);
  CHECK_THAT(gear.notes[0], Catch::Contains("Head_1.SampFreq"));
  CHECK_THAT(gear.notes[1], Catch::Contains("Data1 is there more than once"));
}

TEST_CASE("a compressed MAT file", "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const Recording motion = read_one(*folder / "emps/DATA_EMPS.mat");
  REQUIRE(motion.find("qm") != nullptr);
  CHECK(motion.find("qm")->samples.size() == 24841);
  CHECK(motion.find("gtau") == nullptr);  // a constant is no signal
}

TEST_CASE("gearbox recordings in CSV, with and without a separator at the line's end",
          "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const Recording gearbox = read_one(*folder / "oedi/b30hz00.csv");
  REQUIRE(gearbox.channels.size() == 4);
  CHECK(gearbox.channels[3].info.name == "a4");
  CHECK(gearbox.channels[0].rate_Hz == 0);
  CHECK(gearbox.channels[3].samples[1] == 0.984487);
  const Recording circuit = read_one(*folder / "silverbox/SNLS80mV.csv");
  REQUIRE(circuit.channels.size() == 2);
  CHECK(circuit.find("V2")->samples.size() == 131072);
}

}  // namespace rvbench::hal
