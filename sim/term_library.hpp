#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/physics_term.hpp"
#include "sim/plant_spec.hpp"
#include "sim/terms/one_axis_term.hpp"

namespace rvbench::sim {

inline constexpr double unbounded = 1e300;  ///< of a parameter: no bound that physics gives
inline constexpr double smallest = 1e-300;  ///< of a parameter that must be > 0

/// One parameter of a type of term: what `explain` must know before it fits it.
struct ParameterCard {
  std::string name;
  UnitKind unit = UnitKind::ratio;
  double min = 0;  ///< bounds of the value; they give its sign
  double max = 0;
  double start = 0;                     ///< where a fit begins, in natural_scale()
  std::optional<double> fallback = {};  ///< of a plant file that says nothing; required if empty
  bool fitted = true;                   ///< false: chosen beforehand, not part of the effect
  bool is_phase = false;                ///< of a wave whose size is the parameter before it
  bool same_law = false;  ///< at any value; false: one far from the start is another in disguise
  struct Choice {
    double value;
    std::string what;  ///< "inner race"
  };
  std::vector<Choice> choices = {};  ///< no number to fit: the effect is tried with each of them
};

/// Where a residual shows: the ledgers of a campaign.
enum class Ledger { quasi_static, shaft, electrical, fixed_frequency, broadband, transient };

struct Cell {
  Ledger ledger;
  std::string what;  ///< "mean torque", "order 1080/121"
};

/// The library's knowledge of one effect, in words that reports quote.
struct TermCard {
  std::string name = {};      ///< in plant files and verdicts
  bool effect = true;         ///< false: a part that plants are built of, never a verdict
  std::string equation = {};  ///< F is what the body has to give
  std::string sign = {};      ///< which way positive parameters push
  std::string leaves_out = {};
  std::string source = {};
  std::vector<Cell> touches = {};  ///< predicted to change
  std::vector<Cell> must_not_touch =
      {};  ///< predicted to stay: an effect that needs them is not this
  std::vector<std::string> mimics = {};  ///< names of effects that look alike
  std::string experiment = {};           ///< tells it from its mimics
};

/// `push` is an input that pushes the term's body.
enum class ReferenceKind { none, input, push, term, body };

/// Of an effect that is in one sensor and in no body: which ones may have it.
enum class InChannel { no, of_any_sensor, of_a_motion };

/// Where it may act, and what it must be told besides its bodies.
struct TermGate {
  bool rotation = true, translation = true;
  bool on_one = true, between_two = true;
  ReferenceKind reference = ReferenceKind::none;
  std::string reference_key = {};   ///< in the plant file: "load", "set_point"
  std::string reference_type = {};  ///< the only type of term that it may refer to; "": any
  std::string retunes = {};         ///< the type of terms that it deviates, instead of adding one
  bool each = false;                ///< one of them at a time
  std::string in_place_of = {};     ///< as an effect it only ever replaces a term of this type
  std::string beside = {};          ///< only where a term of this type joins the same two
  InChannel in_channel = InChannel::no;
  /// Whether a sensor has it already; empty: none does.
  std::function<bool(const PlantSpec&, const OutputSpec&)> is_in = {};
  bool stands = false;  ///< only on a body that a term joins to the housing
  /// What it looks like where nothing moves both ways: only a reversal parts them; empty: it needs
  /// none.
  std::string one_way_like = {};
};

/// What a type gets to make a term from: names resolved, values checked against the card.
struct TermSite {
  Axis axis;
  int input = -1;  ///< index in PlantState::u, if the gate asks for an input or a push
  const PhysicsTerm* term = nullptr;  ///< lives as long as the plant, if it asks for a term
  int body = -1;                      ///< if it asks for a body
  const Parameters* parameters = nullptr;

  /// @throws std::logic_error if the card has no such parameter
  double operator[](std::string_view parameter) const;
};

/// Where an effect is tried.
struct EffectSite {
  std::string body_a = {};
  std::string body_b = std::string(housing_name);
  std::string reference = {};            ///< as the gate asks; or the term that the effect replaces
  std::vector<std::string> beyond = {};  ///< terms that go to the far side of an inserted body
  std::string channel = {};              ///< of the output that it is in; "" if it is in the bodies
  std::vector<std::string> together_with = {};  ///< joints that it is in as much as in this one
};

struct TermType {
  TermCard card;
  std::vector<ParameterCard> parameters = {};
  TermGate gate = {};
  /// Empty: the effect changes the structure and is no term by itself.
  std::function<std::unique_ptr<PhysicsTerm>(const TermSite&)> make = {};
  /// Empty: the effect is one more term.
  std::function<PlantSpec(PlantSpec, const EffectSite&, const Parameters&)> edit = {};
  /// Of an edit: what it changes grows in proportion to its size, as it does with one more term.
  bool adds = false;
  /// How recordings must be compared to show it.
  std::vector<ComparedBy> shows_in = {ComparedBy::samples, ComparedBy::orders};
};

/// The types of terms that plant files may name. A program adds its own to a copy of the standard
/// ones.
class TermLibrary {
 public:
  /// @throws std::invalid_argument if there is one of that name
  void add(TermType type);

  const TermType* find(std::string_view name) const;  ///< nullptr if there is none
  const std::vector<TermType>& types() const { return types_; }
  std::vector<std::string> names() const;

 private:
  std::vector<TermType> types_;
};

/// The types of sim/terms/.
const TermLibrary& standard_terms();

/// The plant with one more effect.
/// @param parameters  those of the type's card; what has a fallback may be absent
/// @throws std::invalid_argument if the library has no such effect, or the site no such body or
/// term
PlantSpec with_effect(const PlantSpec& plant, std::string_view effect, const EffectSite& site,
                      const Parameters& parameters, const TermLibrary& library = standard_terms());

}  // namespace rvbench::sim
