#include "sim/steady_state.hpp"

#include <complex>
#include <functional>
#include <set>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/units.hpp"
#include "sim/common_motion.hpp"
#include "sim/order_lines.hpp"
#include "sim/steady_motion.hpp"
#include "sim/steady_sensors.hpp"
#include "sim/term_memory.hpp"

namespace rvbench::sim {
namespace {

using Complex = std::complex<double>;
using hal::ConfigFault;

constexpr double negligible_push = 1e-9;  // of a rhythm's own, at twice its frequency
constexpr double other_speed = 0.9;  // of the present one: whether a rhythm is the same at both

// Each line to the column of its order; the others are empty.
Eigen::MatrixXcd by_orders(const Eigen::MatrixXcd& lines, const PeriodOrders& at) {
  Eigen::MatrixXcd all = Eigen::MatrixXcd::Zero(lines.rows(), at.highest() + 1);
  all.col(0) = lines.col(0);
  for (Eigen::Index k = 1; k < lines.cols(); ++k) {
    all.col(at.orders()[static_cast<std::size_t>(k - 1)]) = lines.col(k);
  }
  return all;
}

// Of a sensor that is linear about the mean motion: what it makes of each line by itself.
Eigen::RowVectorXcd lines_of_linear(const SteadySensors& sensors, const SteadyMotion& motion,
                                    Eigen::Index output) {
  const Eigen::MatrixXcd speeds = motion.differentiated(motion.lines());
  PlantState s = motion.mean_state(0);
  const PlantState mean = s;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(s.q.size());
  Eigen::RowVectorXcd lines(motion.lines().cols());
  const double still = sensors.value(output, mean, none);
  for (Eigen::Index k = 1; k < lines.size(); ++k) {
    const Complex rate(0, motion.omega_rad_s(k));
    const auto part = [&](auto taken) {
      s.q = mean.q + taken(motion.lines().col(k));
      s.v = mean.v + taken(speeds.col(k));
      return sensors.value(output, s, taken(rate * speeds.col(k))) - still;
    };
    lines[k] = {part([](const auto& x) { return x.real().eval(); }),
                part([](const auto& x) { return x.imag().eval(); })};
  }
  lines[0] = still;
  return lines;
}

Eigen::MatrixXcd shaft_lines(const SteadySensors& sensors, const SteadyMotion& motion,
                             Eigen::Index outputs) {
  Eigen::MatrixXcd lines(outputs, motion.lines().cols());
  std::vector<Eigen::Index> curved;
  for (Eigen::Index o = 0; o < outputs; ++o) {
    if (sensors.is_linear(o)) {
      lines.row(o) = lines_of_linear(sensors, motion, o);
    } else {
      curved.push_back(o);
    }
  }
  if (curved.empty()) return lines;
  Signals signals(static_cast<Eigen::Index>(curved.size()), motion.samples());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(motion.common().size());
  motion.go_round([&](Eigen::Index i, PlantState& s) {
    for (std::size_t o = 0; o < curved.size(); ++o) {
      signals(static_cast<Eigen::Index>(o), i) = sensors.value(curved[o], s, none);
    }
  });
  lines(curved, Eigen::all) = lines_of(signals, motion.orders());
  return lines;
}

// Of what a rhythm brings over one of its periods, the line at so many times its frequency.
Eigen::VectorXcd harmonic_of(int times, Eigen::Index size,
                             const std::function<Eigen::VectorXd(double part)>& at) {
  Eigen::VectorXcd line = Eigen::VectorXcd::Zero(size);
  const int samples = 4 * times;
  for (int i = 0; i < samples; ++i) {
    const double part = static_cast<double>(i) / samples;
    line += 2.0 / samples * std::polar(1.0, -units::two_pi * times * part) * at(part);
  }
  return line;
}

// What a term's own rhythm does to the outputs: what it pushes makes its line, and, as the bodies
// swing by that, one at twice its frequency. The bodies answer about their mean motion, and the
// sensors are taken as linear there, at all angles alike: what goes round makes lines beside
// these, and none of them.
struct Rhythm {
  const SteadySensors& sensors;
  const SteadyMotion& motion;
  Eigen::Index outputs;
  const PhysicsTerm& term;
  double rhythm_Hz;

  // @param way  of the bodies at `times` this rhythm
  PlantState state(double part, int times, const Eigen::VectorXcd& way) const {
    PlantState s = motion.mean_state(part / rhythm_Hz);
    const Complex turn = std::polar(1.0, units::two_pi * times * part);
    s.q += (turn * way).real();
    s.v += (Complex(0, units::two_pi * times * rhythm_Hz) * turn * way).real();
    return s;
  }

  // What it pushes at `times` its frequency while the bodies swing at that itself.
  Eigen::VectorXcd push(int times, const Eigen::VectorXcd& way) const {
    return harmonic_of(times, way.size(), [&](double part) {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(way.size());
      term.add_force(state(part, 1, way), f);
      return f;
    });
  }

  Eigen::VectorXcd answer(int times, const Eigen::VectorXcd& push) const {
    return algebra::ComplexLu(motion.impedance(units::two_pi * times * rhythm_Hz)).solve(push);
  }

  Eigen::VectorXcd shown(int times, const Eigen::VectorXcd& way) const {
    const double omega_rad_s = units::two_pi * times * rhythm_Hz;
    const std::vector<double> angles_rad = motion.mean_angles_rad();
    return harmonic_of(1, outputs, [&](double part) {
      const Complex turn = std::polar(1.0, units::two_pi * part);
      PlantState s = state(part / times, times, way);
      const Eigen::VectorXd q = s.q;
      const Eigen::VectorXd acceleration = (-omega_rad_s * omega_rad_s * turn * way).real();
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(outputs);
      for (const double turned_rad : angles_rad) {
        s.q = q + motion.common() * turned_rad;
        sum += sensors.values(s, acceleration);
      }
      return (sum / double(angles_rad.size())).eval();
    });
  }
};

// Lines that outputs show and no body moves by, each in one output alone.
void add_hums(const PlantSpec& plant, SteadyState& state, std::vector<Eigen::VectorXcd>& timed) {
  const auto outputs = static_cast<Eigen::Index>(plant.outputs.size());
  for (Eigen::Index o = 0; o < outputs; ++o) {
    for (const Hum& hum : plant.outputs[static_cast<std::size_t>(o)].hums) {
      state.rhythms_Hz.push_back(hum.frequency.value);
      state.slip_of.emplace_back();
      timed.emplace_back(Eigen::VectorXcd::Zero(outputs));
      timed.back()[o] = hum.amplitude.value * std::polar(1.0, hum.phase.value);
    }
  }
}

// What terms with a time of their own show, once and twice in it, about the steady motion.
void add_rhythms(const PlantSpec& plant, const PlantModel& model, const SteadyMotion& motion,
                 const SteadySensors& sensors, SteadyState& state,
                 std::vector<Eigen::VectorXcd>& timed) {
  const auto outputs = static_cast<Eigen::Index>(plant.outputs.size());
  for (std::size_t i = 0; i < model.terms.size(); ++i) {
    const PhysicsTerm& term = *model.terms[i];
    PlantState s = motion.mean_state(0);
    const double rhythm_Hz = term.rhythm_Hz(s);
    if (rhythm_Hz == 0) continue;
    s.v *= other_speed;
    state.rhythms_Hz.push_back(rhythm_Hz);
    const bool by_slip = term.rhythm_Hz(s) != rhythm_Hz;
    state.slip_of.push_back(by_slip ? plant.terms[i].reference : "");
    const Rhythm rhythm{sensors, motion, outputs, term, rhythm_Hz};
    const Eigen::VectorXcd push = rhythm.push(1, Eigen::VectorXcd::Zero(motion.common().size()));
    const Eigen::VectorXcd way = rhythm.answer(1, push);
    timed.push_back(rhythm.shown(1, way));
    const Eigen::VectorXcd again = rhythm.push(2, way);
    if (again.norm() < negligible_push * push.norm()) continue;
    state.rhythms_Hz.push_back(2 * rhythm_Hz);
    state.slip_of.emplace_back();
    timed.push_back(rhythm.shown(2, rhythm.answer(2, again)));
  }
}

SteadyState shown(const PlantSpec& plant, const PlantModel& model, const SteadyMotion& motion) {
  const SteadySensors sensors(plant, model);
  SteadyState result{std::abs(motion.speed_rad_s()) / units::two_pi,
                     motion.common() * motion.speed_rad_s(),
                     by_orders(motion.lines(), motion.orders()),
                     motion.speed_rad_s(),
                     {},
                     {},
                     {}};
  const auto outputs = static_cast<Eigen::Index>(plant.outputs.size());
  const Eigen::MatrixXcd lines = by_orders(shaft_lines(sensors, motion, outputs), motion.orders());
  std::vector<Eigen::VectorXcd> timed;
  add_rhythms(plant, model, motion, sensors, result, timed);
  add_hums(plant, result, timed);
  for (Eigen::Index o = 0; o < outputs; ++o) {
    SteadyOutput output;
    output.mean = lines(o, 0).real() + plant.outputs[static_cast<std::size_t>(o)].offset.value;
    output.shaft_lines = lines.row(o).transpose();
    output.timed_lines.resize(static_cast<Eigen::Index>(timed.size()));
    for (std::size_t i = 0; i < timed.size(); ++i) {
      output.timed_lines[static_cast<Eigen::Index>(i)] = timed[i][o];
    }
    result.outputs.push_back(std::move(output));
  }
  return result;
}

}  // namespace

std::variant<SteadyPlant, ConfigFault> SteadyPlant::make(const PlantSpec& plant,
                                                         const TermLibrary& library) {
  auto made = make_model(plant, library);
  if (const auto* fault = std::get_if<ConfigFault>(&made)) return *fault;
  auto& model = std::get<PlantModel>(made);
  if (!model.prescribed.empty()) {
    return ConfigFault{0, "/inputs", "a prescribed motion leaves nothing to solve for"};
  }
  auto common = common_motion(model);
  if (const auto* fault = std::get_if<ConfigFault>(&common)) return *fault;
  for (const auto& term : model.terms) {
    const auto* memory = dynamic_cast<const TermMemory*>(term.get());
    if (memory != nullptr && !memory->is_clock()) {
      return ConfigFault{0, "/terms", std::string(term->name()) + " has a past: no steady state"};
    }
  }
  if (const PhysicsTerm* holds = held_by(model, std::get<Eigen::VectorXd>(common))) {
    return ConfigFault{0, "/terms", std::string(holds->name()) + " holds on to one turn"};
  }
  return SteadyPlant(plant, std::move(model), std::get<Eigen::VectorXd>(std::move(common)));
}

PeriodOrders SteadyPlant::orders_up_to(int highest) const {
  std::vector<std::set<int>> pushes(model_.terms.size());
  for (std::size_t i = 0; i < pushes.size(); ++i) model_.terms[i]->add_orders(common_, pushes[i]);
  return {pushes, highest};
}

std::variant<SteadyState, ConfigFault> SteadyPlant::under(const Eigen::VectorXd& inputs,
                                                          const PeriodOrders& orders,
                                                          const SteadyState* near) const {
  SteadyMotion motion(model_, common_, inputs, orders);
  if (near == nullptr || !motion.solve_near(near->slowest_rad_s, near->motion)) {
    if (const auto fault = motion.solve()) return *fault;
  }
  return shown(*plant_, model_, motion);
}

std::optional<PushResponse> SteadyPlant::response(const SteadyState& state,
                                                  const Eigen::VectorXd& inputs,
                                                  const PeriodOrders& orders,
                                                  const std::vector<double>& frequencies_Hz) const {
  SteadyMotion motion(model_, common_, inputs, orders);
  if (!motion.solve_near(state.slowest_rad_s, state.motion)) return std::nullopt;
  return push_response(*plant_, model_, motion, frequencies_Hz);
}

}  // namespace rvbench::sim
