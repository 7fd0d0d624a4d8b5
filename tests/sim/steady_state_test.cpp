#include "sim/steady_state.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "sim/simulate.hpp"
#include "sim/terms/one_axis_term.hpp"
#include "tests/sim/plant_texts.hpp"

using namespace rvbench;
using test::plant_of;
using Complex = std::complex<double>;

namespace {

constexpr double pi = std::numbers::pi;

// A torque that goes round with its body, A·cos nθ, or a stiffness that does.
class Lobes final : public sim::OneAxisTerm {
 public:
  explicit Lobes(const sim::TermSite& at)
      : OneAxisTerm("lobes", at.axis),
        push_Nm_(at["push"]),
        stiffness_(at["stiffness"]),
        lobes_(at["lobes"]) {}
  double effort(const sim::PlantState& s) const override {
    const double wave = std::cos(lobes_ * s.q[axis().body_a]);
    return (stiffness_ * way(s) - push_Nm_) * wave;
  }
  void add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const override {
    sim::add_order(lobes_ * turns[axis().body_a], orders);
  }

 private:
  double push_Nm_, stiffness_, lobes_;
};

// A torque that follows time, and is the larger the faster its body: A·cos(2πft)·v/(1 rad/s).
class SpeedyBeat final : public sim::OneAxisTerm {
 public:
  explicit SpeedyBeat(const sim::TermSite& at)
      : OneAxisTerm("speedy_beat", at.axis), push_Nm_(at["push"]), frequency_Hz_(at["frequency"]) {}
  double effort(const sim::PlantState& s) const override {
    return -push_Nm_ * std::cos(2 * pi * frequency_Hz_ * s.t_s) * speed(s);
  }
  double rhythm_Hz(const sim::PlantState&) const override { return frequency_Hz_; }

 private:
  double push_Nm_, frequency_Hz_;
};

// A stiff gear: its first body turns three times for each turn of the second.
class Gear final : public sim::PhysicsTerm {
 public:
  explicit Gear(const sim::TermSite& at) : axis_(at.axis), stiffness_(at["stiffness"]) {}
  std::string_view name() const override { return "gear"; }
  void add_force(const sim::PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override {
    f[axis_.body_a] -= stiffness_ * way(s);
    f[axis_.body_b] += 3 * stiffness_ * way(s);
  }
  double stored_energy_J(const sim::PlantState& s) const override {
    return 0.5 * stiffness_ * way(s) * way(s);
  }
  double dissipated_power_W(const sim::PlantState&) const override { return 0; }
  void add_orders(const Eigen::VectorXd&, std::set<int>&) const override {}
  bool is_linear() const override { return true; }
  void add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd&) const override {
    Eigen::VectorXd arms = Eigen::VectorXd::Zero(stiffness.rows());
    arms[axis_.body_a] = 1;
    arms[axis_.body_b] = -3;
    stiffness += stiffness_ * arms * arms.transpose();
  }
  void add_remainder(const sim::PlantState&, Eigen::Ref<Eigen::VectorXd>) const override {}

 private:
  double way(const sim::PlantState& s) const { return s.q[axis_.body_a] - 3 * s.q[axis_.body_b]; }
  sim::Axis axis_;
  double stiffness_;
};

sim::TermLibrary with_lobes() {
  sim::TermLibrary library = sim::standard_terms();
  library.add(
      {.card = {.name = "lobes"},
       .parameters =
           {{.name = "push", .unit = sim::UnitKind::force, .max = 1e9, .fallback = 0},
            {.name = "stiffness", .unit = sim::UnitKind::stiffness, .max = 1e9, .fallback = 0},
            {.name = "lobes", .unit = sim::UnitKind::ratio, .max = 100, .fallback = 3}},
       .make = [](const sim::TermSite& at) { return std::make_unique<Lobes>(at); }});
  library.add({.card = {.name = "speedy_beat"},
               .parameters = {{.name = "push", .unit = sim::UnitKind::force, .max = 1e9},
                              {.name = "frequency", .unit = sim::UnitKind::frequency, .max = 1e9}},
               .make = [](const sim::TermSite& at) { return std::make_unique<SpeedyBeat>(at); }});
  library.add({.card = {.name = "gear"},
               .parameters = {{.name = "stiffness", .unit = sim::UnitKind::stiffness, .max = 1e9}},
               .make = [](const sim::TermSite& at) { return std::make_unique<Gear>(at); }});
  return library;
}

// Two wheels of 0.002 and 0.05 kg·m² on a shaft of 30 N·m/rad and 0.01 N·m·s/rad; the second one
// runs in 0.02 N·m·s/rad, the first is pushed.
std::string two_wheels(const std::string& more = "") {
  return R"({"plant": "wheels", "bodies": [
    {"name": "rotor", "motion": "rotation", "inertia": {"value": 0.002, "unit": "kg·m²"}},
    {"name": "wheel", "motion": "rotation", "inertia": {"value": 0.05, "unit": "kg·m²"}}],
    "terms": [
    {"type": "spring", "body_a": "rotor", "body_b": "wheel", "name": "shaft",
     "parameters": {"stiffness": {"value": 30, "unit": "N·m/rad"}}},
    {"type": "damper", "body_a": "rotor", "body_b": "wheel",
     "parameters": {"damping": {"value": 0.01, "unit": "N·m·s/rad"}}},
    {"type": "viscous_friction", "body_a": "wheel",
     "parameters": {"damping": {"value": 0.02, "unit": "N·m·s/rad"}}})" +
         more + R"(],
    "inputs": [{"channel": "torque", "unit": "N·m", "is": "force", "body": "rotor"}],
    "outputs": [{"channel": "speed", "unit": "rad/s", "is": "speed", "body": "rotor"},
                {"channel": "twist", "unit": "N·m", "is": "effort", "term": "shaft"}]})";
}

std::variant<sim::SteadyState, hal::ConfigFault> solve(const std::string& text, double torque_Nm,
                                                       int orders = 8) {
  const sim::TermLibrary library = with_lobes();
  const sim::PlantSpec plant = plant_of(text, library);
  const auto made = sim::SteadyPlant::make(plant, library);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&made)) return *fault;
  const auto& steady = std::get<sim::SteadyPlant>(made);
  return steady.under(Eigen::VectorXd::Constant(1, torque_Nm), steady.orders_up_to(orders));
}

sim::SteadyState steady(const std::string& plant, double torque_Nm) {
  auto result = solve(plant, torque_Nm);
  if (auto* fault = std::get_if<hal::ConfigFault>(&result)) {
    FAIL(fault->pointer << ": " << fault->message);
  }
  return std::get<sim::SteadyState>(std::move(result));
}

// What spring and damper of the shaft pass on for a torque of 1 N·m on the rotor: two equations,
// solved by hand.
struct PerNm {
  Complex rotor_rad, twist_Nm;
};

PerNm per_Nm(double omega) {
  const Complex j(0, 1);
  const Complex shaft = 30.0 + j * omega * 0.01;
  const Complex rotor = -omega * omega * 0.002 + shaft;
  const Complex wheel = -omega * omega * 0.05 + j * omega * 0.02 + shaft;
  const Complex det = rotor * wheel - shaft * shaft;
  return {wheel / det, shaft * (wheel - shaft) / det};
}

Complex twist_per_Nm(double omega) { return per_Nm(omega).twist_Nm; }

std::string lobes(const std::string& what, double value, const std::string& unit) {
  return R"(, {"type": "lobes", "body_a": "rotor", "body_b": "housing", "parameters": {")" + what +
         R"(": {"value": )" + std::to_string(value) + R"(, "unit": ")" + unit + R"("}}})";
}

}  // namespace

SCENARIO("bodies on a shaft turn where drive and friction balance", "[sim][steady]") {
  const double torque_Nm = GENERATE(0.5, 2.0, -1.0);
  const auto state = steady(two_wheels(), torque_Nm);
  CHECK(state.speed_rad_s[0] == Approx(torque_Nm / 0.02));
  CHECK(state.speed_rad_s[1] == Approx(torque_Nm / 0.02));
  CHECK(state.period_Hz == Approx(std::abs(torque_Nm) / 0.02 / (2 * pi)));
  CHECK(state.outputs[1].mean == Approx(torque_Nm));
  AND_THEN("nothing oscillates") {
    CHECK(state.outputs[1].shaft_lines.tail(8).cwiseAbs().maxCoeff() < 1e-9);
  }
}

SCENARIO("a torque that goes round answers as two inertias on a spring do", "[sim][steady]") {
  const double torque_Nm = GENERATE(0.3, 0.75, 3.0);  // below, near and above the shaft's resonance
  const auto state = steady(two_wheels(lobes("push", 0.01, "N·m")), torque_Nm);
  const double omega = 3 * state.speed_rad_s[0];
  const double expected = 0.01 * std::abs(twist_per_Nm(omega));
  CHECK(std::abs(state.outputs[1].shaft_lines[3]) == Approx(expected).epsilon(2e-2));
}

SCENARIO("what follows time keeps its frequency at every speed", "[sim][steady]") {
  const auto state = steady(two_wheels(R"(, {"type": "external_force", "body_a": "rotor",
    "parameters": {"amplitude": {"value": 0.05, "unit": "N·m"},
                   "phase": {"value": 0.9, "unit": "rad"},
                   "frequency": {"value": 50, "unit": "Hz"}}})"),
                            GENERATE(0.5, 2.0));
  REQUIRE(state.rhythms_Hz == std::vector<double>{50});
  const Complex expected = std::polar(0.05, 0.9) * twist_per_Nm(2 * pi * 50);
  CHECK(std::abs(state.outputs[1].timed_lines[0] - expected) < 1e-6 * std::abs(expected));
  CHECK(state.outputs[1].shaft_lines.tail(8).cwiseAbs().maxCoeff() < 1e-9);
}

SCENARIO("what follows time and feels its own swing has a line at twice its frequency",
         "[sim][steady]") {
  const double push = 0.002, torque_Nm = 0.5, omega = 2 * pi * 15;
  const auto state = steady(two_wheels(R"(, {"type": "speedy_beat", "body_a": "rotor",
    "parameters": {"push": {"value": 0.002, "unit": "N·m"},
                   "frequency": {"value": 15, "unit": "Hz"}}})"),
                            torque_Nm);
  REQUIRE(state.rhythms_Hz == std::vector<double>{15, 30});
  const Complex beat_Nm = push * state.speed_rad_s[0];
  const Complex swing_rad_s = Complex(0, omega) * per_Nm(omega).rotor_rad * beat_Nm;
  const auto& twist = state.outputs[1].timed_lines;
  const Complex once = twist_per_Nm(omega) * beat_Nm;
  const Complex twice = twist_per_Nm(2 * omega) * push * swing_rad_s / 2.0;
  CHECK(std::abs(twist[0] - once) < 1e-6 * std::abs(once));
  CHECK(std::abs(twist[1] - twice) < 1e-6 * std::abs(twice));
}

SCENARIO("a stiffness that goes round is none on average", "[sim][steady]") {
  const std::string push = R"(, {"type": "external_force", "body_a": "rotor",
    "parameters": {"amplitude": {"value": 0.05, "unit": "N·m"},
                   "phase": {"value": 0, "unit": "rad"},
                   "frequency": {"value": 50, "unit": "Hz"}}})";
  const std::string goes_round = R"(, {"type": "lobes", "body_a": "rotor", "body_b": "wheel",
    "parameters": {"stiffness": {"value": 3, "unit": "N·m/rad"},
                   "lobes": {"value": )" +
                                 std::to_string(GENERATE(3, 7, 11, 14, 22)) + R"(, "unit": "1"}}})";
  const auto without = steady(two_wheels(push), 0.5);
  const auto with = steady(two_wheels(push + goes_round), 0.5);
  const double expected = std::abs(without.outputs[1].timed_lines[0]);
  THEN("what follows time passes as if it were not there") {
    CHECK(std::abs(with.outputs[1].timed_lines[0]) == Approx(expected).epsilon(1e-3));
  }
}

// A slow swing is kept out of the angles where it would modulate what is much faster. Here nothing
// is: a push A·cos θ swings its own angle by δ, and feels A·δ/2 of it twice a turn.
SCENARIO("a wheel that turns a third as fast as the other feels its own swing", "[sim][steady]") {
  const double push_Nm = 0.5, torque_Nm = 0.1;
  const auto state = steady(R"({"plant": "geared", "bodies": [
    {"name": "rotor", "motion": "rotation", "inertia": {"value": 0.002, "unit": "kg·m²"}},
    {"name": "wheel", "motion": "rotation", "inertia": {"value": 0.05, "unit": "kg·m²"}}],
    "terms": [
    {"type": "gear", "body_a": "rotor", "body_b": "wheel",
     "parameters": {"stiffness": {"value": 3000, "unit": "N·m/rad"}}},
    {"type": "viscous_friction", "body_a": "wheel",
     "parameters": {"damping": {"value": 0.02, "unit": "N·m·s/rad"}}},
    {"type": "lobes", "body_a": "wheel", "body_b": "housing",
     "parameters": {"push": {"value": 0.5, "unit": "N·m"}, "lobes": {"value": 1, "unit": "1"}}}],
    "inputs": [{"channel": "torque", "unit": "N·m", "is": "force", "body": "rotor"}],
    "outputs": [{"channel": "speed", "unit": "rad/s", "is": "speed", "body": "wheel"}]})",
                            torque_Nm);
  const double omega = 3 * torque_Nm / 0.02, inertia_kgm2 = 0.05 + 9 * 0.002;
  CHECK(state.speed_rad_s[1] == Approx(omega).epsilon(0.01));
  const auto mobility = [&](int order) {
    return 1.0 / Complex(0.02, order * state.speed_rad_s[1] * inertia_kgm2);
  };
  const double first_rad_s = push_Nm * std::abs(mobility(1));
  const double swing_rad = first_rad_s / state.speed_rad_s[1];
  const double second_rad_s = 0.5 * push_Nm * swing_rad * std::abs(mobility(2));
  const Eigen::VectorXd lines = state.outputs[0].shaft_lines.cwiseAbs();
  CHECK(lines[1] == Approx(first_rad_s).epsilon(0.01));
  CHECK(lines[2] == Approx(second_rad_s).epsilon(0.01));
}

SCENARIO("what cannot turn steadily is refused with its reason", "[sim][steady]") {
  const auto refused = [](const std::string& text, double torque_Nm) {
    auto result = solve(text, torque_Nm);
    REQUIRE(std::holds_alternative<hal::ConfigFault>(result));
    return std::get<hal::ConfigFault>(result).message;
  };
  CHECK(refused(two_wheels(), 0) == "nothing keeps the bodies turning");
  CHECK(refused(two_wheels(R"(, {"type": "spring", "body_a": "wheel",
    "parameters": {"stiffness": {"value": 1, "unit": "N·m/rad"}}})"),
                1) == "0 bodies that can turn by themselves, not 1");
}

SCENARIO("a transducer in series is passed what all between its two bodies push", "[sim][steady]") {
  // A second spring beside the shaft takes a part of the torque; both together take all of it.
  const auto state = steady(two_wheels(R"(, {"type": "spring", "body_a": "wheel", "body_b": "rotor",
    "parameters": {"stiffness": {"value": 15, "unit": "N·m/rad"}}})"),
                            2.0);
  CHECK(state.outputs[1].mean == Approx(2.0));
}

SCENARIO("waves that share no order answer each other as they do in time", "[sim][steady]") {
  // Thirty lobes modulate the shaft's stiffness, seven push the rotor: orders 23 and 37 are there
  // because of both.
  const std::string plant = two_wheels(R"(, {"type": "lobes", "name": "thirty",
      "body_a": "rotor", "body_b": "wheel", "parameters": {
        "stiffness": {"value": 3, "unit": "N·m/rad"}, "lobes": {"value": 30, "unit": "1"}}},
      {"type": "lobes", "name": "seven", "body_a": "rotor", "body_b": "housing", "parameters": {
        "push": {"value": 0.05, "unit": "N·m"}, "lobes": {"value": 7, "unit": "1"}}})");
  const double torque_Nm = 0.3;
  const auto state = std::get<sim::SteadyState>(solve(plant, torque_Nm, 100));
  const Eigen::VectorXcd& lines = state.outputs[1].shaft_lines;

  const double rate_Hz = 4000;
  const sim::TermLibrary library = with_lobes();
  const std::vector<Channel> driven{
      {{"torque", "N·m", "", not_known}, rate_Hz, 0, Eigen::VectorXd::Constant(200000, torque_Nm)}};
  const auto simulated = sim::simulate(plant_of(plant, library), driven, library);
  const Eigen::VectorXd& twist = std::get<sim::Simulated>(simulated).channels[1].samples;
  const auto line_in_time = [&](int order) {  // with a Hann window over the last half
    Complex sum = 0;
    const Eigen::Index n = twist.size() / 2;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double window = 1 - std::cos(2 * pi * double(i) / double(n));
      const double angle = 2 * pi * order * state.period_Hz * double(i) / rate_Hz;
      sum += window * twist[n + i] * std::polar(1.0, -angle);
    }
    return 2.0 / double(n) * std::abs(sum);
  };
  for (const int order : {7, 23, 30, 37}) {
    CHECK(std::abs(lines[order]) > 1e-6);
    CHECK(std::abs(lines[order]) == Approx(line_in_time(order)).epsilon(0.02));
  }
  CHECK(line_in_time(8) < 1e-6);
  CHECK(std::abs(lines[8]) == 0);
}
