#pragma once

#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/unit_kind.hpp"

namespace rvbench::sim {

/// A number of the plant, and how well it is known.
struct Quantity {
  static constexpr double free_pct = std::numeric_limits<double>::infinity();

  double value = 0;
  std::string unit;
  double tolerance_pct = 0;  ///< 0: exact; free_pct: to be identified
};

using Parameters = std::map<std::string, Quantity, std::less<>>;

/// What the bodies of an axis end in: the ground that does not move.
inline constexpr std::string_view housing_name = "housing";

struct BodySpec {
  std::string name;
  Motion motion = Motion::translation;
  Quantity inertia;           ///< kg or kg·m²
  double start_position = 0;  ///< m or rad
  double start_speed = 0;     ///< m/s or rad/s
  std::string about = {};     ///< where its numbers come from
};

struct TermSpec {
  std::string name;  ///< unique in the plant
  std::string type;  ///< of the term library
  std::string body_a;
  std::string body_b = std::string(housing_name);
  std::string reference;  ///< the input, term or body that the type asks for; "" if none
  Parameters parameters;
  std::string about = {};  ///< where its numbers come from

  /// Whichever of the two the term calls its first.
  bool is_between(std::string_view a, std::string_view b) const {
    return (body_a == a && body_b == b) || (body_a == b && body_b == a);
  }
};

enum class InputKind { force, signal, position, speed, acceleration };

/// What a recorded value stands for until the next one comes.
enum class Between { band_limited, linear, hold };

/// A recorded channel that drives the plant: SI value = gain·channel + offset.
///
/// `force` pushes a body; `signal` is what a term reads (set-point, voltage); the others prescribe
/// a body's motion. What is not recorded of a motion is differentiated below band_Hz.
struct InputSpec {
  std::string name;     ///< unique in the plant
  std::string channel;  ///< in the recording
  std::string unit;     ///< of the channel
  InputKind kind = InputKind::force;
  std::string body;  ///< "" of a signal
  Quantity gain;
  Quantity offset;
  Between between = Between::band_limited;
  double band_Hz = 0;  ///< of a prescribed motion; 0 otherwise
};

/// Whether a recording of it is compared sample by sample, by the means and lines of a steady
/// rotation, or by the levels of a random vibration and the lines of its squared envelope.
enum class ComparedBy { samples, orders, envelope };

enum class OutputKind { position, speed, acceleration, effort, drive };

/// What the mains induce in a channel's wire: A·cos(2πft + φ), t by the record's own clock.
struct Hum {
  Quantity amplitude;  ///< in the channel's unit
  Quantity phase;      ///< rad
  Quantity frequency;  ///< Hz
};

/// What a sensor would show: channel(t) = gain·SI value(t − delay) + offset + its hums.
///
/// `effort` is what a term takes from its body, with all that acts between the same two bodies:
/// what a transducer in series with it is passed; `drive` what must push a body for it to move as
/// prescribed: inverse dynamics.
struct OutputSpec {
  std::string channel;  ///< its name in the recording
  std::string unit;     ///< of the channel
  OutputKind kind = OutputKind::position;
  std::string of;  ///< a body, or for `effort` a term
  Quantity gain;
  Quantity offset;
  Quantity delay;                                ///< s
  ComparedBy compared_by = ComparedBy::samples;  ///< the same for all outputs of a plant
  double from_Hz = 0, to_Hz = 0;                 ///< band that an envelope is taken of
  std::vector<Hum> hums = {};                    ///< none moves a body
};

/// A lumped-parameter machine as data: bodies, terms that add, what drives it and what is seen.
struct PlantSpec {
  std::string name;
  std::string about;
  std::vector<BodySpec> bodies;
  std::vector<TermSpec> terms;
  std::vector<InputSpec> inputs;
  std::vector<OutputSpec> outputs;

  const BodySpec* find_body(std::string_view body) const;         ///< nullptr if there is none
  const TermSpec* find_term(std::string_view term) const;         ///< nullptr if there is none
  const InputSpec* find_input(std::string_view input) const;      ///< nullptr if there is none
  const OutputSpec* find_output(std::string_view channel) const;  ///< nullptr if there is none

  /// Of the body, or term's body_a, that an output or input is about; translation if unknown.
  Motion motion_of(std::string_view body_or_term) const;
};

struct PlacedQuantity {
  std::string pointer;  ///< "/terms/0/parameters/stiffness"
  Quantity* quantity;   ///< lives in the plant
};

/// Every quantity of the plant, in order of the file: what a fit may move by its tolerance.
std::vector<PlacedQuantity> quantities(PlantSpec& plant);

/// What an output shows before gain and offset.
UnitKind unit_kind(OutputKind kind);

/// Unit of what an input brings, or an output shows, before gain and offset.
std::string_view si_unit(InputKind kind, Motion motion);
std::string_view si_unit(OutputKind kind, Motion motion);

}  // namespace rvbench::sim
