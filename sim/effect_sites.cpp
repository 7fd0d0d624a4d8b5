#include "sim/effect_sites.hpp"

#include <algorithm>
#include <cmath>

#include "sim/effect_edits.hpp"

namespace rvbench::sim {
namespace {

bool may_move(const TermGate& gate, Motion motion) {
  return motion == Motion::rotation ? gate.rotation : gate.translation;
}

bool may_act_on(const PlantSpec& plant, const TermGate& gate, const BodySpec& body,
                const TermLibrary& library) {
  return gate.on_one && may_move(gate, body.motion) &&
         (!gate.stands || !holding(plant, body.name, library).empty());
}

// Each body against the housing, each pair that a term joins.
std::vector<EffectSite> axes_of(const PlantSpec& plant, const TermGate& gate,
                                const TermLibrary& library) {
  std::vector<EffectSite> axes;
  for (const BodySpec& body : plant.bodies) {
    if (may_act_on(plant, gate, body, library)) axes.push_back({body.name});
  }
  for (const TermSpec& term : plant.terms) {
    if (!gate.between_two || term.body_b == housing_name) continue;
    const bool known = std::ranges::any_of(
        axes, [&](const EffectSite& axis) { return term.is_between(axis.body_a, axis.body_b); });
    if (!known && may_move(gate, plant.motion_of(term.body_a))) {
      axes.push_back({term.body_a, term.body_b});
    }
  }
  std::erase_if(axes, [&](const EffectSite& axis) {
    return !gate.beside.empty() && std::ranges::none_of(plant.terms, [&](const TermSpec& term) {
      return term.type == gate.beside && term.is_between(axis.body_a, axis.body_b);
    });
  });
  return axes;
}

// Friction and the like carry no load that another friction could grow with.
bool may_refer_to(const TermSpec& term, const TermGate& gate, const TermLibrary& library) {
  if (!gate.reference_type.empty()) return term.type == gate.reference_type;
  const TermType* type = library.find(term.type);
  return type != nullptr && !type->card.effect;
}

std::vector<std::string> references_of(const PlantSpec& plant, const TermGate& gate,
                                       const TermLibrary& library) {
  std::vector<std::string> names;
  switch (gate.reference) {
    case ReferenceKind::none: names.emplace_back(); break;
    case ReferenceKind::input:
      for (const InputSpec& input : plant.inputs) {
        if (input.kind == InputKind::signal) names.push_back(input.name);
      }
      break;
    case ReferenceKind::push:
      for (const InputSpec& input : plant.inputs) {
        if (input.kind == InputKind::force) names.push_back(input.name);
      }
      break;
    case ReferenceKind::term:
      for (const TermSpec& term : plant.terms) {
        if (may_refer_to(term, gate, library)) names.push_back(term.name);
      }
      break;
    case ReferenceKind::body:
      for (const BodySpec& body : plant.bodies) {  // by whose angle something goes round
        if (body.motion == Motion::rotation) names.push_back(body.name);
      }
      break;
  }
  return names;
}

// What a term carries is known to the bodies that it joins only, a push to the body that it pushes.
bool joins(const PlantSpec& plant, const TermType& type, const EffectSite& site) {
  if (type.gate.reference == ReferenceKind::push) {
    return plant.find_input(site.reference)->body == site.body_a;
  }
  if (type.gate.reference != ReferenceKind::term) return true;
  const TermSpec* term = plant.find_term(site.reference);
  const auto is_end = [&](const std::string& body) {
    return body != housing_name && (body == term->body_a || body == term->body_b);
  };
  return is_end(site.body_a) || is_end(site.body_b);
}

// Where terms of one type are, for an effect that takes their place.
std::vector<EffectSite> places_of(const PlantSpec& plant, const std::string& type) {
  std::vector<EffectSite> places;
  for (const TermSpec& term : plant.terms) {
    if (term.type == type) places.push_back({term.body_a, term.body_b, term.name});
  }
  return places;
}

bool acts_already(const PlantSpec& plant, const TermType& type, const EffectSite& site) {
  return std::ranges::any_of(plant.terms, [&](const TermSpec& term) {
    return term.type == type.card.name && term.is_between(site.body_a, site.body_b) &&
           term.reference == site.reference;
  });
}

bool deviates(const TermSpec& term, const TermType& type) {
  const auto size = term.parameters.find(type.parameters.front().name);
  return size != term.parameters.end() && size->second.value != 0;
}

std::string joint(const std::string& body_a, const std::string& body_b) {
  return body_b == housing_name ? body_a + " against the housing" : body_a + " and " + body_b;
}

// Terms that the effect would deviate, each by itself.
std::vector<EffectSite> retuned_one_by_one(const PlantSpec& plant, const TermType& type) {
  std::vector<EffectSite> sites;
  for (const TermSpec& term : plant.terms) {
    if (term.type == type.gate.retunes && !deviates(term, type)) {
      sites.push_back({term.body_a, term.body_b, term.name});
    }
  }
  return sites;
}

// All of them at once: one place.
std::vector<EffectSite> retuned_together(const PlantSpec& plant, const TermType& type) {
  std::vector<EffectSite> sites;
  for (const TermSpec& term : plant.terms) {
    if (term.type != type.gate.retunes) continue;
    if (deviates(term, type)) return {};
    if (sites.empty()) {
      sites.push_back({term.body_a, term.body_b});
    } else {
      sites.front().together_with.push_back(joint(term.body_a, term.body_b));
    }
  }
  return sites;
}

// Each sensor that may have it, with the bodies that it looks at.
std::vector<EffectSite> channels_of(const PlantSpec& plant, const TermType& type) {
  const TermGate& gate = type.gate;
  std::vector<EffectSite> channels;
  for (const OutputSpec& output : plant.outputs) {
    const bool of_motion = output.kind <= OutputKind::acceleration;
    if (gate.in_channel == InChannel::of_a_motion && !of_motion) continue;
    if (!may_move(gate, plant.motion_of(output.of))) continue;
    if (gate.is_in && gate.is_in(plant, output)) continue;
    EffectSite site{output.of};
    if (output.kind == OutputKind::effort) {
      const TermSpec& term = *plant.find_term(output.of);
      site = {term.body_a, term.body_b};
    }
    site.channel = output.channel;
    channels.push_back(std::move(site));
  }
  return channels;
}

}  // namespace

std::vector<EffectSite> sites_of(const PlantSpec& plant, const TermType& type,
                                 const TermLibrary& library) {
  const ComparedBy compared =
      plant.outputs.empty() ? ComparedBy::samples : plant.outputs.front().compared_by;
  if (std::ranges::find(type.shows_in, compared) == type.shows_in.end()) return {};
  if (!type.gate.retunes.empty()) {
    return type.gate.each ? retuned_one_by_one(plant, type) : retuned_together(plant, type);
  }
  if (!type.gate.in_place_of.empty()) return places_of(plant, type.gate.in_place_of);
  if (type.gate.in_channel != InChannel::no) return channels_of(plant, type);
  std::vector<EffectSite> sites;
  for (const EffectSite& axis : axes_of(plant, type.gate, library)) {
    for (const std::string& reference : references_of(plant, type.gate, library)) {
      EffectSite site = axis;
      site.reference = reference;
      if (joins(plant, type, site) && !acts_already(plant, type, site)) {
        sites.push_back(std::move(site));
      }
    }
  }
  return sites;
}

std::string describe(const EffectSite& site) {
  if (!site.channel.empty()) return site.channel + " channel";
  std::string text = joint(site.body_a, site.body_b);
  for (const std::string& other : site.together_with) text += ", " + other;
  if (!site.together_with.empty()) text += " alike";
  if (!site.reference.empty()) text += ", by " + site.reference;
  return text;
}

std::string unit_at(const PlantSpec& plant, const EffectSite& site, UnitKind kind) {
  const OutputSpec* output = plant.find_output(site.channel);
  if (kind == UnitKind::channel && output != nullptr) return output->unit;
  return std::string(unit_of(kind, plant.motion_of(site.body_a)));
}

double natural_scale_at(const PlantSpec& plant, const EffectSite& site, UnitKind kind,
                        const NaturalScales& scales) {
  const OutputSpec* output = plant.find_output(site.channel);
  if (kind != UnitKind::channel || output == nullptr) return natural_scale(kind, scales);
  return std::abs(output->gain.value) * natural_scale(unit_kind(output->kind), scales);
}

}  // namespace rvbench::sim
