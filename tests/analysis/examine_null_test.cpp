#include "analysis/diagnosis.hpp"
#include "analysis/statistics.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/analysis/reducers.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using analysis::Kinematics;
using test::NoOftenerThanStated;
using test::NullDraws;
using test::OrderSignals;

namespace {

constexpr unsigned records = test::under_sanitizer ? 4 : 100;  // of each kind
constexpr unsigned points = 4;                                 // of a matrix
constexpr unsigned sensors = 4;

// Every kind of signature there is, bearings among them.
struct Machine {
  OrderSignals turning;  // four periods of its gear train: the shortest record that is judged
  Kinematics kinematics;
};

Machine rv20e_records() {
  return {{.speed_Hz = 30, .rate_Hz = 1920, .count = 30977}, test::rv20e()};
}

// i = 21: its lines lie six times denser in the spectrum.
Machine small_records() {
  return {{.speed_Hz = 20, .rate_Hz = 1280, .count = 5380}, test::small_reducer()};
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

// Of each signature, record by record.
std::vector<NullDraws> draws_of(const Machine& machine, double common,
                                const Eigen::VectorXd& meshes) {
  std::vector<NullDraws> draws(machine.kinematics.signatures.size());
  for (unsigned seed = 1; seed <= records; ++seed) {
    const analysis::Examination e =
        examine(housing(machine.turning, seed, common, meshes), machine.kinematics);
    REQUIRE(e.resolvable);
    for (std::size_t s = 0; s < draws.size(); ++s) draws[s].p_values.push_back(e.scores[s].p_value);
  }
  return draws;
}

// What conclude() makes of them, points of a matrix together.
NullDraws of_matrices(const NullDraws& draws) {
  NullDraws combined;
  for (std::size_t from = 0; from + points <= draws.p_values.size(); from += points) {
    const auto first = draws.p_values.begin() + static_cast<std::ptrdiff_t>(from);
    combined.p_values.push_back(analysis::combined_p_value({first, first + points}));
  }
  return combined;
}

void add(const NullDraws& draws, NullDraws& to) {
  to.p_values.insert(to.p_values.end(), draws.p_values.begin(), draws.p_values.end());
}

// All draws of all records together are thousands: enough to see a rate at 0.001.
void check_no_false_alarms(const std::vector<std::vector<NullDraws>>& kinds,
                           const Kinematics& kinematics) {
  if (test::under_sanitizer) return;  // too few to tell a rate
  NullDraws all, all_matrices;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    for (std::size_t s = 0; s < kinds[kind].size(); ++s) {
      CAPTURE(kinematics.machine, kind, kinematics.signatures[s].component);
      CHECK_THAT(kinds[kind][s], NoOftenerThanStated({0.01, 0.1}));
      add(kinds[kind][s], all);
      add(of_matrices(kinds[kind][s]), all_matrices);
    }
  }
  CHECK_THAT(all, NoOftenerThanStated({0.001, 0.01, 0.1}));
  CHECK_THAT(all_matrices, NoOftenerThanStated({0.001, 0.01, 0.1}));
}

Eigen::VectorXd silence(const OrderSignals& turning) {
  return Eigen::VectorXd::Zero(turning.count);
}

}  // namespace

TEST_CASE(
    "no part is significant oftener than stated in a record of nothing, though all sensors "
    "hear the same noise and all IMFs are of one signal",
    "[analysis][examine][null]") {
  if (test::too_long_under_sanitizer()) return;
  const Machine machine = rv20e_records();
  const OrderSignals& t = machine.turning;
  const Eigen::VectorXd sound = 5 * t.tone(1080.0 / 121) + 2 * t.tone(1560.0 / 121, 1);
  check_no_false_alarms({draws_of(machine, 0, silence(t)), draws_of(machine, 3, silence(t)),
                         draws_of(machine, 1, sound)},
                        machine.kinematics);
}

TEST_CASE("nor is it where a small reducer's lines lie close to one another",
          "[analysis][examine][null]") {
  const Machine machine = small_records();
  const OrderSignals& t = machine.turning;
  check_no_false_alarms({draws_of(machine, 0, silence(t)), draws_of(machine, 3, silence(t))},
                        machine.kinematics);
}
