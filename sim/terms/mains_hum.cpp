#include "sim/terms/mains_hum.hpp"

#include <fmt/format.h>

#include "sim/effect_edits.hpp"
#include "sim/mains.hpp"
#include "sim/retuning.hpp"

namespace rvbench::sim {
namespace {

PlantSpec pick_up(PlantSpec plant, const EffectSite& site, const Parameters& parameters) {
  output_of(plant, "mains_hum", site.channel)
      .hums.push_back(
          {parameters.at("amplitude"), parameters.at("phase"), parameters.at("frequency")});
  return plant;
}

// Any hum: the plant file knows what its channel picks up.
bool picks_up(const PlantSpec&, const OutputSpec& output) { return !output.hums.empty(); }

std::vector<ParameterCard::Choice> of_mains() {
  std::vector<ParameterCard::Choice> choices;
  for (const double frequency_Hz : mains_frequencies_Hz) {
    choices.push_back({frequency_Hz, fmt::format("at {:g} Hz", frequency_Hz)});
  }
  return choices;
}

}  // namespace

TermType mains_hum() {
  return {
      .card = {.name = "mains_hum",
               .equation = "channel += A·cos(2πft + φ)",
               .sign = "A >= 0, in the channel's unit",
               .leaves_out = "drift of the mains' frequency, another phase in each record, "
                             "higher harmonics",
               .source = "Ott, Electromagnetic Compatibility Engineering, ch. 2 (2009)",
               .touches = {{Ledger::fixed_frequency,
                            "one line at the mains' frequency or twice it, in one channel, at all "
                            "speeds and loads"}},
               .must_not_touch = {{Ledger::fixed_frequency, "the same line in any other channel"},
                                  {Ledger::shaft, "lines that follow the speed"},
                                  {Ledger::quasi_static, "means"}},
               .mimics = {"external_force", "brake_ripple", "inverter_ripple"},
               .experiment = "short the channel's input, or stand still: it stays"},
      .parameters = {{.name = "amplitude",
                      .unit = UnitKind::channel,
                      .min = 0,
                      .max = unbounded,
                      .start = 0.02},
                     phase_card("phase"),
                     {.name = "frequency",
                      .unit = UnitKind::frequency,
                      .min = smallest,
                      .max = 1e6,
                      .start = 50,
                      .fitted = false,
                      .choices = of_mains()}},
      .gate = {.in_channel = InChannel::of_any_sensor, .is_in = picks_up},
      .edit = pick_up,
      .adds = true};
}

}  // namespace rvbench::sim
