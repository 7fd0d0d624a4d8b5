#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "sim/draw.hpp"
#include "sim/plant_model.hpp"
#include "sim/term_library.hpp"
#include "sim/term_memory.hpp"

using namespace rvbench;
using sim::Motion;
using sim::ParameterCard;

namespace {

constexpr double pi = std::numbers::pi;

// Every parameter at the size that a fit begins with.
sim::Parameters usual(const sim::TermType& type, Motion motion) {
  const sim::NaturalScales scales{.force = 10, .coordinate = 0.5, .speed = 3};
  sim::Parameters parameters;
  for (const ParameterCard& card : type.parameters) {
    const double value = card.start * natural_scale(card.unit, scales);
    parameters[card.name] = {std::clamp(value, card.min, card.max),
                             std::string(unit_of(card.unit, motion)), 0};
  }
  return parameters;
}

// Two bodies a, b and a rotor; the term under test between a and b, or on a; a spring of 100 on a
// for terms that want a load; an input, or another term, for terms that want one.
sim::PlantSpec bench_for(const sim::TermType& type, Motion motion, bool between_two) {
  const std::string kg(unit_of(sim::UnitKind::inertia, motion));
  const std::string stiffness(unit_of(sim::UnitKind::stiffness, motion));
  const std::string si(unit_of(sim::UnitKind::coordinate, motion));
  sim::PlantSpec plant;
  plant.bodies = {
      {"a", motion, {2, kg}}, {"b", motion, {3, kg}}, {"rotor", Motion::rotation, {1, "kg·m²"}}};
  plant.terms = {{"load", "spring", "a", "housing", "", {{"stiffness", {100, stiffness}}}}};
  plant.inputs = {{.name = "u",
                   .channel = "u",
                   .unit = "V",
                   .kind = sim::InputKind::signal,
                   .body = "",
                   .gain = {1, "1"},
                   .offset = {0, "V"}}};
  plant.outputs = {{.channel = "x",
                    .unit = si,
                    .kind = sim::OutputKind::position,
                    .of = "a",
                    .gain = {1, "1"},
                    .offset = {0, si},
                    .delay = {0, "s"}}};
  sim::TermSpec term{"term", type.card.name, "a", between_two ? "b" : "housing", "", {}};
  if (!type.gate.reference_type.empty()) {
    const sim::TermType& other = *sim::standard_terms().find(type.gate.reference_type);
    plant.terms = {{"load", other.card.name, "a", "housing", "u", usual(other, motion)}};
  }
  switch (type.gate.reference) {
    case sim::ReferenceKind::none: break;
    case sim::ReferenceKind::input: term.reference = "u"; break;
    case sim::ReferenceKind::push:
      term.reference = "u";
      plant.inputs.front().kind = sim::InputKind::force;
      plant.inputs.front().body = "a";
      plant.inputs.front().unit = std::string(unit_of(sim::UnitKind::force, motion));
      plant.inputs.front().offset.unit = plant.inputs.front().unit;
      break;
    case sim::ReferenceKind::term: term.reference = "load"; break;
    case sim::ReferenceKind::body: term.reference = "rotor"; break;
  }
  term.parameters = usual(type, motion);
  plant.terms.push_back(term);
  return plant;
}

sim::PlantModel model_of(const sim::PlantSpec& plant) {
  auto made = sim::make_model(plant);
  if (auto* fault = std::get_if<hal::ConfigFault>(&made)) {
    FAIL(plant.terms.back().type << ": " << fault->pointer << ": " << fault->message);
  }
  return std::get<sim::PlantModel>(std::move(made));
}

sim::PlantState some_state(const sim::PlantModel& model, std::uint64_t seed) {
  sim::Draw draw(seed);
  sim::PlantState s{Eigen::VectorXd(3), Eigen::VectorXd(3), Eigen::VectorXd(model.memory_size),
                    Eigen::VectorXd::Constant(1, draw.uniform(-20, 20)), draw.uniform(0, 5)};
  for (double& q : s.q) q = draw.uniform(-1, 1);
  for (double& v : s.v) v = draw.uniform(-5, 5);
  for (double& z : s.z) z = draw.uniform(-0.04, 0.04);
  return s;
}

Eigen::VectorXd force_of(const sim::PhysicsTerm& term, const sim::PlantState& s) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3);
  term.add_force(s, f);
  return f;
}

// dE/dt of what a term stores, along the motion.
double storing_W(const sim::PhysicsTerm& term, const sim::PlantState& s) {
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(s.z.size());
  if (const auto* memory = dynamic_cast<const sim::TermMemory*>(&term)) memory->add_rates(s, rates);
  constexpr double h = 1e-6;
  sim::PlantState before = s, after = s;
  before.q -= h * s.v;
  before.z -= h * rates;
  after.q += h * s.v;
  after.z += h * rates;
  return (term.stored_energy_J(after) - term.stored_energy_J(before)) / (2 * h);
}

template <typename Check>
void for_every_term(const Check& check) {
  for (const sim::TermType& type : sim::standard_terms().types()) {
    if (!type.make) continue;
    for (const Motion motion : {Motion::rotation, Motion::translation}) {
      if (!(motion == Motion::rotation ? type.gate.rotation : type.gate.translation)) continue;
      for (const bool between_two : {false, true}) {
        if (!(between_two ? type.gate.between_two : type.gate.on_one)) continue;
        INFO(type.card.name << (between_two ? " between two" : " on one"));
        const sim::PlantModel model = model_of(bench_for(type, motion, between_two));
        check(*model.terms.back(), model, between_two);
      }
    }
  }
}

// The effort of one type on body a, with given parameters, in a given state.
double effort_of(const std::string& name, const std::map<std::string, double>& parameters, double q,
                 double v, double t_s = 0, double z = 0, double u = 0) {
  const sim::TermType& type = *sim::standard_terms().find(name);
  const Motion motion = type.gate.translation ? Motion::translation : Motion::rotation;
  sim::PlantSpec plant = bench_for(type, motion, false);
  for (const auto& [key, value] : parameters) {
    REQUIRE(plant.terms.back().parameters.contains(key));
    plant.terms.back().parameters[key].value = value;
  }
  const sim::PlantModel model = model_of(plant);
  return model.terms.back()->effort({Eigen::Vector3d(q, 0, 0.3), Eigen::Vector3d(v, 0, 40),
                                     Eigen::VectorXd::Constant(model.memory_size, z),
                                     Eigen::VectorXd::Constant(1, u), t_s});
}

}  // namespace

TEST_CASE("every term of the library balances its energy book", "[sim][library][law]") {
  const auto seed = GENERATE(range(1, 20));
  for_every_term([&](const sim::PhysicsTerm& term, const sim::PlantModel& model, bool) {
    const sim::PlantState s = some_state(model, static_cast<std::uint64_t>(seed));
    const double given_W = force_of(term, s).dot(s.v);
    const double book_W =
        term.supplied_power_W(s) - term.dissipated_power_W(s) - storing_W(term, s);
    CHECK(given_W == Approx(book_W).epsilon(1e-6).margin(1e-7));
    CHECK(term.dissipated_power_W(s) >= 0);
  });
}

TEST_CASE("every term of the library pushes its ends alike, and its parts make the whole",
          "[sim][library][law]") {
  for_every_term([](const sim::PhysicsTerm& term, const sim::PlantModel& model, bool between_two) {
    const sim::PlantState s = some_state(model, 5);
    const Eigen::VectorXd force = force_of(term, s);
    CHECK(force[0] == Approx(-term.effort(s)));
    if (dynamic_cast<const sim::OneAxisTerm*>(&term) != nullptr) {  // gears do not push alike
      CHECK(force[1] == Approx(between_two ? term.effort(s) : 0.0));
      CHECK(force[2] == 0);
    }
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3, 3), damping = stiffness;
    term.add_linear(stiffness, damping);
    Eigen::VectorXd split = -stiffness * s.q - damping * s.v;
    term.add_remainder(s, split);
    CHECK((split - force).norm() <= 1e-9 * (1 + force.norm()));
    if (term.is_linear()) {
      Eigen::VectorXd nothing = Eigen::VectorXd::Zero(3);
      term.add_remainder(s, nothing);
      CHECK(nothing.norm() == 0);
    }
  });
}

TEST_CASE("every term that lets bodies turn on comes again as often as it says",
          "[sim][library][law]") {
  for_every_term([](const sim::PhysicsTerm& term, const sim::PlantModel& model, bool between_two) {
    if (dynamic_cast<const sim::OneAxisTerm*>(&term) == nullptr) return;  // gears: see terms_test
    const Eigen::Vector3d turns(6, between_two ? 6 : 0, 10);
    const auto changed_by = [&](double part) {
      sim::PlantState s = some_state(model, 3);
      double most = 0;
      for (int angle = 0; angle < 200; ++angle) {
        const Eigen::VectorXd before = force_of(term, s);
        s.q += 2 * pi * part * turns;
        most = std::max(most, (force_of(term, s) - before).norm() / (before.norm() + 1e-9));
        s.q += (0.005 * 2 * pi - 2 * pi * part) * turns;
      }
      return most;
    };
    if (changed_by(1) > 1e-6) return;  // it holds on to one turn
    std::set<int> orders;
    term.add_orders(turns, orders);
    const int repeats = std::accumulate(orders.begin(), orders.end(), 0, std::gcd<int, int>);
    CHECK(changed_by(repeats == 0 ? 0.1234 : 1.0 / repeats) < 1e-6);
  });
}

TEST_CASE("the laws of friction", "[sim][library][literature]") {
  CHECK(effort_of("coulomb_friction", {{"level", 4}, {"creep_speed", 1e-3}}, 0, 0.5) == Approx(4));
  CHECK(effort_of("coulomb_friction", {{"level", 4}, {"creep_speed", 1e-3}}, 0, -0.5) ==
        Approx(-4));
  CHECK(effort_of("coulomb_friction", {{"level", 4}, {"creep_speed", 1}}, 0, 0.5) ==
        Approx(4 * std::tanh(0.5)));
  CHECK(effort_of("coulomb_friction", {{"level", 4}}, 0, 0) == 0);
  CHECK(effort_of("viscous_friction", {{"damping", 3}}, 1, -2) == Approx(-6));

  const std::map<std::string, double> forward{{"level", 2}, {"damping", 3}, {"creep_speed", 1e-3}};
  CHECK(effort_of("asymmetric_friction", forward, 0, 2) == Approx(8));
  CHECK(effort_of("asymmetric_friction", forward, 0, -2) == 0);
  const std::map<std::string, double> mixed{{"level", -2}, {"damping", 3}, {"creep_speed", 1e-3}};
  CHECK(effort_of("asymmetric_friction", mixed, 0, 2) == Approx(6));
  CHECK(effort_of("asymmetric_friction", mixed, 0, -2) == Approx(-2));

  const std::map<std::string, double> stribeck{
      {"excess", 5}, {"stribeck_speed", 0.2}, {"creep_speed", 1e-6}};
  CHECK(effort_of("stribeck_friction", stribeck, 0, 1e-4) == Approx(5).epsilon(1e-3));
  CHECK(effort_of("stribeck_friction", stribeck, 0, -0.2) == Approx(-5 / std::exp(1)));
  CHECK(effort_of("stribeck_friction", stribeck, 0, 3) == Approx(0).margin(1e-12));

  // The load is a spring of 100 N/m, stretched by 0.3 m.
  const std::map<std::string, double> load{{"coefficient", 0.1}, {"creep_speed", 1e-6}};
  CHECK(effort_of("load_friction", load, 0.3, -1) == Approx(-3));
  CHECK(effort_of("load_friction", load, -0.3, -1) == Approx(-3));
  CHECK(effort_of("load_friction", load, 0, 1) == 0);

  const std::map<std::string, double> thinning{{"level", 6}, {"at_speed", 2}, {"exponent", 0.5}};
  CHECK(effort_of("shear_thinning", thinning, 0, 2) == Approx(6));
  CHECK(effort_of("shear_thinning", thinning, 0, -8) == Approx(-12));

  const std::map<std::string, double> thermal{{"damping", 5}, {"decay", 0.03}};
  CHECK(effort_of("thermal_viscosity", thermal, 0, 2) == Approx(10));
  CHECK(effort_of("thermal_viscosity", thermal, 0, 2, 0, 10) == Approx(10 * std::exp(-0.3)));

  CHECK(effort_of("nonlinear_damping", {{"damping", 2}}, 0, -3) == Approx(-18));
  const std::map<std::string, double> by_way{{"damping", 5}, {"at_way", 0.1}};
  CHECK(effort_of("displacement_damping", by_way, 0.1, -3) == Approx(-15));
  CHECK(effort_of("displacement_damping", by_way, -0.2, 1) == Approx(20));
}

TEST_CASE("the laws of stiffness", "[sim][library][literature]") {
  CHECK(effort_of("spring", {{"stiffness", 7}}, -2, 5) == Approx(-14));
  CHECK(effort_of("cubic_stiffness", {{"stiffness", 2}}, -3, 1) == Approx(-54));
  CHECK(effort_of("quadratic_stiffness", {{"stiffness", 2}}, -3, 1) == Approx(18));
  const std::map<std::string, double> gap{{"stiffness", 100}, {"gap", 0.4}};
  CHECK(effort_of("backlash", gap, 0.19, 5) == 0);
  CHECK(effort_of("backlash", gap, 0.25, 0) == Approx(5));
  CHECK(effort_of("backlash", gap, -0.25, 0) == Approx(-5));
  const std::map<std::string, double> stop{{"stiffness_change", 50}, {"threshold", 0.1}};
  CHECK(effort_of("looseness", stop, 0.1, 1) == 0);
  CHECK(effort_of("looseness", stop, 0.3, 1) == Approx(10));
  CHECK(effort_of("looseness", stop, -0.3, 1) == 0);
  CHECK(effort_of("stiffness_hysteresis", {{"stiffness", 50}}, 0, 1, 0, 0.02) == Approx(1));
}

TEST_CASE("the laws of sources", "[sim][library][literature]") {
  CHECK(effort_of("torque_offset", {{"level", -3.2}}, 1, 1) == Approx(-3.2));
  const std::map<std::string, double> push{{"amplitude", 5}, {"phase", 0.3}, {"frequency", 50}};
  CHECK(effort_of("external_force", push, 0, 0, 0) == Approx(-5 * std::cos(0.3)));
  CHECK(effort_of("external_force", push, 0, 0, 0.005) == Approx(5 * std::sin(0.3)));
  CHECK(effort_of("saturation", {{"limit", 8}}, 0, 0, 0, 0, 11) == Approx(3));
  CHECK(effort_of("saturation", {{"limit", 8}}, 0, 0, 0, 0, -11) == Approx(-3));
  CHECK(effort_of("saturation", {{"limit", 8}}, 0, 0, 0, 0, 7) == 0);
  // The rotor stands at 0.3 rad and turns at 40 rad/s.
  CHECK(effort_of("unbalance", {{"amount", 1e-3}, {"phase", 0.2}}, 0, 0) ==
        Approx(-1e-3 * 1600 * std::cos(0.5)));
  const std::map<std::string, double> machine{{"constant", 0.5}, {"resistance", 2}};
  CHECK(effort_of("motor", machine, 0, 4, 0, 0, 12) == Approx(-0.5 * (12 - 0.5 * 4) / 2));
  CHECK(effort_of("gravity", {{"sine", 3}, {"cosine", 4}}, pi / 2, 0) == Approx(3));
  CHECK(effort_of("gravity", {{"sine", 3}, {"cosine", 4}}, 0, 0) == Approx(4));
  const std::map<std::string, double> loop{
      {"position_gain", 10}, {"speed_gain", 3}, {"integral_time", 0.5}, {"limit", 1000}};
  // Set-point 2, position 1.5, speed 1: e = 10·0.5 − 1 = 4; z = 0.25.
  CHECK(effort_of("cascade_controller", loop, 1.5, 1, 0, 0.25, 2) == Approx(-3 * (4 + 0.5)));
}

SCENARIO("every card says what explain needs", "[sim][library]") {
  const std::set<std::string> words{"coulomb_friction",
                                    "viscous_friction",
                                    "asymmetric_friction",
                                    "stribeck_friction",
                                    "load_friction",
                                    "shear_thinning",
                                    "thermal_viscosity",
                                    "backlash",
                                    "series_compliance",
                                    "cubic_stiffness",
                                    "quadratic_stiffness",
                                    "nonlinear_damping",
                                    "displacement_damping",
                                    "stiffness_hysteresis",
                                    "torsional_mode",
                                    "mesh_stiffness_variation",
                                    "transmission_error",
                                    "pin_ripple",
                                    "crank_eccentricity",
                                    "gear_eccentricity",
                                    "unbalance",
                                    "misalignment",
                                    "housing_mode",
                                    "sensor_mount",
                                    "inverter_ripple",
                                    "slip",
                                    "rotor_bar",
                                    "brake_ripple",
                                    "speed_modulation",
                                    "mains_hum",
                                    "bearing_defect",
                                    "tooth_damage",
                                    "sun_tooth_error",
                                    "looseness",
                                    "saturation",
                                    "external_force",
                                    "torque_offset"};  // as the design has them
  for (const sim::TermType& type : sim::standard_terms().types()) {
    const sim::TermCard& card = type.card;
    INFO(card.name);
    for (const auto* words_of : {&card.equation, &card.sign, &card.leaves_out, &card.source}) {
      CHECK(!words_of->empty());
    }
    CHECK((type.make || type.edit));
    for (const ParameterCard& parameter : type.parameters) {
      INFO(parameter.name);
      CHECK(parameter.min < parameter.max);
      if (parameter.fallback) CHECK(*parameter.fallback >= parameter.min);
    }
    CHECK(card.effect == words.contains(card.name));
    if (!card.effect) continue;
    CHECK((!card.touches.empty() && !card.must_not_touch.empty() && !card.experiment.empty()));
    for (const std::string& mimic : card.mimics) CHECK(words.contains(mimic));
    CHECK(std::any_of(type.parameters.begin(), type.parameters.end(),
                      [](const ParameterCard& p) { return p.fitted; }));
  }
}
