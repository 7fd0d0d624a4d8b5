#include "sim/plant_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "hal/did_you_mean.hpp"
#include "sim/named.hpp"

namespace rvbench::sim {
namespace {

using hal::did_you_mean;
using hal::in_quotes;

// kg or kg·m²: beyond these, forces no longer move it, or numbers run out.
constexpr double lightest = 1e-12;
constexpr double heaviest = 1e12;

std::string with_article(std::string_view name) {
  return fmt::format("{} {}", name.find_first_of("aeiou") == 0 ? "an" : "a", name);
}

// One walk over a plant, noting what is wrong.
class Check {
 public:
  Check(const PlantSpec& plant, const TermLibrary& library) : plant_(plant), library_(library) {}

  std::vector<hal::ConfigFault> faults() {
    if (plant_.bodies.empty()) note("/bodies", "needs at least one body");
    check_list("/bodies", plant_.bodies, &Check::check_body);
    check_list("/terms", plant_.terms, &Check::check_term);
    if (plant_.inputs.empty()) note("/inputs", "needs at least one input");
    check_list("/inputs", plant_.inputs, &Check::check_input);
    if (plant_.outputs.empty()) note("/outputs", "needs at least one output");
    for (std::size_t i = 0; i < plant_.outputs.size(); ++i) {
      check_output(fmt::format("/outputs/{}", i), plant_.outputs[i]);
    }
    check_motions();
    return std::move(faults_);
  }

 private:
  void note(std::string pointer, std::string message) {
    faults_.push_back({0, std::move(pointer), std::move(message)});
  }

  template <typename T>
  void check_list(const std::string& pointer, const std::vector<T>& list,
                  void (Check::*check)(const std::string&, const T&)) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string place = fmt::format("{}/{}", pointer, i);
      if (!seen.insert(list[i].name).second) {
        note(place + "/name", "there is already one called " + in_quotes(list[i].name));
      }
      (this->*check)(place, list[i]);
    }
  }

  void check_quantity(const std::string& place, const Quantity& quantity, std::string_view unit,
                      double min = -unbounded, double max = unbounded) {
    if (!std::isfinite(quantity.value)) {
      note(place + "/value", "must be finite");
    } else if (quantity.value < min) {
      note(place + "/value", quantity.value <= 0 && (min == smallest || min == lightest)
                                 ? fmt::format("{} must be above 0", quantity.value)
                                 : fmt::format("{} is below {}", quantity.value, min));
    } else if (quantity.value > max) {
      note(place + "/value", fmt::format("{} is above {}", quantity.value, max));
    }
    if (quantity.unit != unit) {
      note(place + "/unit",
           fmt::format("expected {}, found {}", in_quotes(unit), in_quotes(quantity.unit)));
    }
    if (!(quantity.tolerance_pct >= 0)) note(place + "/tolerance_pct", "must be >= 0");
  }

  void check_body(const std::string& place, const BodySpec& body) {
    if (body.name == housing_name) note(place + "/name", "\"housing\" is what does not move");
    const bool turns = body.motion == Motion::rotation;
    check_quantity(place + (turns ? "/inertia" : "/mass"), body.inertia,
                   unit_of(UnitKind::inertia, body.motion), lightest, heaviest);
  }

  bool known_body(const std::string& place, const std::string& name) {
    if (plant_.find_body(name) != nullptr) return true;
    note(place,
         "no body is called " + in_quotes(name) + did_you_mean(name, names_of(plant_.bodies)));
    return false;
  }

  void check_term(const std::string& place, const TermSpec& term) {
    const TermType* type = library_.find(term.type);
    if (type == nullptr) {
      note(place + "/type", "no type of term is called " + in_quotes(term.type) +
                                did_you_mean(term.type, library_.names()));
      return;
    }
    if (!type->make) {
      note(place + "/type",
           type->gate.in_channel == InChannel::of_any_sensor
               ? "is no term: it is in a sensor, write it down as \"hums\" of an output"
               : "changes the structure: write down the bodies and springs it makes");
      return;
    }
    check_gate(place, term, *type);
    check_reference(place, term, *type);
    check_parameters(place, term, *type);
  }

  void check_gate(const std::string& place, const TermSpec& term, const TermType& type) {
    if (!known_body(place + "/body_a", term.body_a)) return;
    const Motion motion = plant_.motion_of(term.body_a);
    if (!(motion == Motion::rotation ? type.gate.rotation : type.gate.translation)) {
      note(place + "/body_a", fmt::format("{} acts on a {} body only", term.type,
                                          type.gate.rotation ? "rotational" : "translational"));
    }
    if (term.body_b == housing_name) {
      if (!type.gate.on_one) note(place + "/body_b", term.type + " acts between two bodies");
      return;
    }
    if (!known_body(place + "/body_b", term.body_b)) return;
    if (!type.gate.between_two) note(place + "/body_b", term.type + " acts on one body only");
    if (term.body_a == term.body_b) note(place + "/body_b", "must not be body_a again");
    if (plant_.motion_of(term.body_b) != motion) {
      note(place + "/body_b", "one body turns, the other slides: no term joins them");
    }
  }

  void check_reference(const std::string& place, const TermSpec& term, const TermType& type) {
    const std::string at = place + '/' + type.gate.reference_key;
    const std::string& name = term.reference;
    switch (type.gate.reference) {
      case ReferenceKind::none: break;
      case ReferenceKind::body: known_body(at, name); break;
      case ReferenceKind::input:
      case ReferenceKind::push: check_input_reference(at, term, type); break;
      case ReferenceKind::term: check_term_reference(at, term, type); break;
    }
  }

  void check_input_reference(const std::string& at, const TermSpec& term, const TermType& type) {
    const std::string& name = term.reference;
    const InputSpec* input = plant_.find_input(name);
    if (input == nullptr) {
      note(at,
           "no input is called " + in_quotes(name) + did_you_mean(name, names_of(plant_.inputs)));
    } else if (input->kind != InputKind::force && input->kind != InputKind::signal) {
      note(at, in_quotes(name) + " prescribes a motion: a term cannot read it");
    } else if (type.gate.reference == ReferenceKind::push && input->body != term.body_a) {
      note(at, in_quotes(name) + " does not push " + in_quotes(term.body_a));
    }
  }

  void check_term_reference(const std::string& at, const TermSpec& term, const TermType& type) {
    const std::string& name = term.reference;
    const std::string& only = type.gate.reference_type;
    const TermSpec* other = plant_.find_term(name);
    if (other == nullptr) {
      note(at, "no term is called " + in_quotes(name) + did_you_mean(name, names_of(plant_.terms)));
    } else if (other >= &term) {
      note(at, in_quotes(name) + " must stand before the term that asks for it");
    } else if (!only.empty() && other->type != only) {
      note(at, fmt::format("{} is {}, {} asks for {}", in_quotes(name), with_article(other->type),
                           term.type, with_article(only)));
    } else if (!only.empty() && other->body_a != term.body_a) {
      note(at, in_quotes(name) + " does not act on " + in_quotes(term.body_a));
    }
  }

  void check_parameters(const std::string& place, const TermSpec& term, const TermType& type) {
    const Motion motion = plant_.motion_of(term.body_a);
    std::vector<std::string> names;
    for (const ParameterCard& card : type.parameters) {
      names.push_back(card.name);
      const std::string at = place + "/parameters/" + card.name;
      const auto found = term.parameters.find(card.name);
      if (found == term.parameters.end()) {
        note(at, "this key is missing");
      } else {
        check_quantity(at, found->second, unit_of(card.unit, motion), card.min, card.max);
      }
    }
    for (const auto& [name, quantity] : term.parameters) {
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      note(place + "/parameters/" + name,
           term.type + " has no such parameter" + did_you_mean(name, names));
    }
  }

  void check_input(const std::string& place, const InputSpec& input) {
    if (input.kind == InputKind::signal) {
      check_quantity(place + "/gain", input.gain, "1");
      check_quantity(place + "/offset", input.offset, input.unit.empty() ? "1" : input.unit);
      return;
    }
    if (!known_body(place + "/body", input.body)) return;
    const std::string_view si = si_unit(input.kind, plant_.motion_of(input.body));
    const std::string gain = gain_unit(si, input.unit);
    if (input.gain.unit == "1" && gain != "1") {
      note(place + "/gain", fmt::format("a channel in {} needs a gain in {}", input.unit, gain));
    } else {
      check_quantity(place + "/gain", input.gain, gain);
    }
    check_quantity(place + "/offset", input.offset, si);
    if (input.kind != InputKind::force && !(input.band_Hz > 0)) {
      note(place + "/band_Hz", "a prescribed motion needs the band it is known in, > 0");
    }
  }

  void check_output(const std::string& place, const OutputSpec& output) {
    const bool of_term = output.kind == OutputKind::effort;
    if (of_term && plant_.find_term(output.of) == nullptr) {
      note(place + "/term", "no term is called " + in_quotes(output.of) +
                                did_you_mean(output.of, names_of(plant_.terms)));
      return;
    }
    if (!of_term && !known_body(place + "/body", output.of)) return;
    const std::string_view si = si_unit(output.kind, plant_.motion_of(output.of));
    const auto same_channel = [&](const InputSpec& i) { return i.channel == output.channel; };
    if (std::ranges::any_of(plant_.inputs, same_channel)) {
      note(place + "/channel", in_quotes(output.channel) + " is an input");
    }
    check_quantity(place + "/gain", output.gain, gain_unit(output.unit, si));
    if (output.gain.value == 0) note(place + "/gain/value", "0 shows nothing of the machine");
    check_quantity(place + "/offset", output.offset, output.unit);
    check_quantity(place + "/delay", output.delay, "s", -1, 1);
    if (output.compared_by != plant_.outputs.front().compared_by) {
      note(place + "/compared_by", "all outputs of a plant are compared alike");
    }
    if (output.compared_by == ComparedBy::envelope && !(output.to_Hz > output.from_Hz)) {
      note(place + "/to_Hz", "must be above from_Hz");
    }
    for (std::size_t h = 0; h < output.hums.size(); ++h) {
      check_hum(fmt::format("{}/hums/{}", place, h), output.hums[h], output.unit);
    }
    if (output.compared_by == ComparedBy::envelope && !output.hums.empty()) {
      note(place + "/hums", "levels of a random vibration leave out what hums");
    }
    if (output.kind == OutputKind::drive && !prescribed(output.of)) {
      note(place + "/body", "no input prescribes its motion: what drives it is known");
    }
  }

  void check_hum(const std::string& place, const Hum& hum, const std::string& channel_unit) {
    check_quantity(place + "/amplitude", hum.amplitude, channel_unit, 0);
    check_quantity(place + "/phase", hum.phase, "rad");
    check_quantity(place + "/frequency", hum.frequency, "Hz", smallest, 1e6);
  }

  bool prescribed(const std::string& body) const {
    return std::any_of(plant_.inputs.begin(), plant_.inputs.end(), [&](const InputSpec& input) {
      return input.body == body && input.kind >= InputKind::position;
    });
  }

  void check_motions() {
    std::set<std::pair<std::string, InputKind>> seen;
    for (std::size_t i = 0; i < plant_.inputs.size(); ++i) {
      const InputSpec& input = plant_.inputs[i];
      if (input.kind < InputKind::position) continue;
      const std::string place = fmt::format("/inputs/{}", i);
      if (!seen.insert({input.body, input.kind}).second) {
        note(place + "/is", "this motion of the body is prescribed twice");
      }
    }
    for (std::size_t i = 0; i < plant_.inputs.size(); ++i) {
      const InputSpec& input = plant_.inputs[i];
      if (input.kind == InputKind::acceleration && !seen.contains({input.body, InputKind::speed}) &&
          !seen.contains({input.body, InputKind::position})) {
        note(fmt::format("/inputs/{}/is", i), "needs the body's position or speed beside it");
      }
    }
  }

  const PlantSpec& plant_;
  const TermLibrary& library_;
  std::vector<hal::ConfigFault> faults_;
};

std::string grouped(std::string_view unit, bool also_products) {
  const bool quotient = unit.find('/') != std::string_view::npos;
  const bool product = unit.find("·") != std::string_view::npos;
  return quotient || (also_products && product) ? fmt::format("({})", unit) : std::string(unit);
}

}  // namespace

std::string gain_unit(std::string_view to, std::string_view from) {
  return to == from ? "1" : grouped(to, false) + '/' + grouped(from, true);
}

std::vector<hal::ConfigFault> check_plant(const PlantSpec& plant, const TermLibrary& library) {
  return Check(plant, library).faults();
}

}  // namespace rvbench::sim
