#include "analysis/diagnosis.hpp"
#include "analysis/rv_reducer.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using analysis::Kinematics;
using test::NoOftenerThanStated;
using test::NullDraws;
using test::OrderSignals;

namespace {

constexpr unsigned records = 250;
constexpr unsigned sensors = 4;

// Every kind of signature there is, bearings among them.
struct Machine {
  OrderSignals turning;  // four periods of its gear train: the shortest record that is judged
  Kinematics kinematics;
};

Machine rv20e() {
  return {{.speed_Hz = 30, .rate_Hz = 1920, .count = 30977},
          analysis::rv_reducer("RV-20E", {9, 27, 2, 39, 40}, {11, 5, 26, 0})};
}

// i = 21: its lines lie six times denser in the spectrum.
Machine small_reducer() {
  return {{.speed_Hz = 20, .rate_Hz = 1280, .count = 5380},
          analysis::rv_reducer("small", {12, 24, 2, 9, 10}, {11, 5, 26, 0})};
}

// Noise that all sensors of one housing hear, through a mode of their own each, and their own.
Recording housing(const OrderSignals& turning, unsigned seed, double common,
                  const Eigen::VectorXd& meshes) {
  Recording record = turning.recording(Eigen::VectorXd());
  const Eigen::VectorXd heard = turning.noise(1000 * seed);
  std::vector<Channel> channels;
  for (unsigned c = 1; c <= sensors; ++c) {
    const Eigen::VectorXd mode = test::resonant(heard, 0.1 + 0.07 * c, 0.05);
    channels.push_back(turning.channel(meshes + common * mode + turning.noise(1000 * seed + c),
                                       ("accel_" + std::to_string(c)).c_str()));
  }
  channels.push_back(turning.angle_channel());
  record.channels = std::move(channels);
  return record;
}

void check_no_false_alarms(const Machine& machine, double common, const Eigen::VectorXd& meshes) {
  std::vector<NullDraws> draws(machine.kinematics.signatures.size());
  for (unsigned seed = 1; seed <= records; ++seed) {
    const analysis::Examination e =
        examine(housing(machine.turning, seed, common, meshes), machine.kinematics);
    REQUIRE(e.resolvable);
    for (std::size_t s = 0; s < draws.size(); ++s) draws[s].p_values.push_back(e.scores[s].p_value);
  }
  for (std::size_t s = 0; s < draws.size(); ++s) {
    CAPTURE(machine.kinematics.machine, machine.kinematics.signatures[s].component);
    CHECK_THAT(draws[s], NoOftenerThanStated({0.001, 0.01, 0.1}));
  }
}

Eigen::VectorXd silence(const OrderSignals& turning) {
  return Eigen::VectorXd::Zero(turning.count);
}

}  // namespace

TEST_CASE(
    "no part is significant oftener than stated in a record of nothing, though all sensors "
    "hear the same noise and all IMFs are of one signal",
    "[analysis][examine][null]") {
  const Machine large = rv20e(), small = small_reducer();
  SECTION("sensors apart") { check_no_false_alarms(large, 0, silence(large.turning)); }
  SECTION("sensors alike") { check_no_false_alarms(large, 3, silence(large.turning)); }
  SECTION("beside the meshes of a sound unit") {
    const OrderSignals& t = large.turning;
    check_no_false_alarms(large, 1, 5 * t.tone(1080.0 / 121) + 2 * t.tone(1560.0 / 121, 1));
  }
  SECTION("sensors apart, of a small reducer") {
    check_no_false_alarms(small, 0, silence(small.turning));
  }
  SECTION("sensors alike, of a small reducer") {
    check_no_false_alarms(small, 3, silence(small.turning));
  }
}
