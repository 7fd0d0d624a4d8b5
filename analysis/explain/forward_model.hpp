#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rvbench::analysis {

/// A number of a model that a fit may move.
struct ModelParameter {
  std::string name;  ///< "slide/mass", "torque sensor/delay"
  std::string unit;  ///< SI symbol; empty if it has none
  double nominal = 0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  /// How well it is known before anything is measured, as a standard deviation; infinite if it is
  /// free to be identified.
  double spread = std::numeric_limits<double>::infinity();
  double scale = 1;       ///< > 0; a noticeable change of it: steps and differences are told by it
  bool nuisance = false;  ///< of the measurement (delay, gain, offset, path), not of the machine
  bool is_known = true;   ///< low and high say what is known of it, not only what its law allows
};

/// Size and phase of a wave, fitted as its cosine part a·cos φ and its sine part a·sin φ: in these
/// a wave is straight, and no start leads round a circle.
struct Phasor {
  std::string size, phase;  ///< their names
};

/// An effect that may have been left out, at one place of the machine.
struct Candidate {
  std::string name;   ///< the field's own word, as "coulomb_friction"
  std::string where;  ///< "slide", "coupling between motor and input shaft"
  /// The first ones are its sizes.
  std::vector<ModelParameter> parameters;
  std::size_t sizes = 1;              ///< parameters that measure it; the others are its shape
  std::optional<Phasor> phasor = {};  ///< what the first two are, if they are the parts of one
  /// What a small one does: changes values in proportion to its size; drowns, for it shows in
  /// amplitudes that stand alone in noise; or there is none, for it changes the structure.
  enum class WhenSmall { in_proportion, drowns, structural };
  WhenSmall when_small = WhenSmall::in_proportion;
  std::vector<std::vector<double>> starts;  ///< values to start fits from, at least two
  bool has_far_starts = false;      ///< each in a valley of its own: the best screened counts
  std::vector<std::string> mimics;  ///< names that can look alike
  std::string experiment;           ///< what would tell it from them
  std::string not_exercised;        ///< why these data cannot show it; empty if they can
  /// Effects that these data cannot part from it: they are not tried by themselves.
  struct Alike {
    std::string name, where;
  };
  std::vector<Alike> alike = {};

  /// A start with its sizes so many times as large.
  std::vector<double> resized(std::vector<double> start, double by) const {
    for (std::size_t i = 0; i < sizes; ++i) start[i] *= by;
    return start;
  }
};

/// A stretch of values that is one observation: values within may depend on each other, units do
/// not. A record is one, or a block of it that is longer than its memory.
struct ObservedUnit {
  std::string record;     ///< where it comes from, for people
  std::string condition;  ///< units of one condition are left out together, as are
  std::string speed;      ///< those of one speed; empty if the speed is no condition,
  std::string load;       ///< and those of one load; empty likewise
  Eigen::Index first = 0;
  Eigen::Index size = 0;
  std::string programme = {};  ///< records of one programme repeat each other; empty if none does
};

/// What analysis needs of a machine's model in order to compare it with recordings: the
/// differences between measured and predicted values, whatever these are (samples, means, lines).
///
/// Units    of the parameters, SI; residuals as counts_standard_errors() says
/// Errors   none are thrown: what cannot be evaluated is no residuals
/// Threads  const calls may overlap
/// Source   ours: analysis asks, who knows the physics answers
class ForwardModel {
 public:
  virtual ~ForwardModel() = default;

  virtual const std::vector<ObservedUnit>& units() const = 0;  ///< in order of values, without gaps
  virtual const std::vector<ModelParameter>& base() const = 0;
  virtual const std::vector<Candidate>& library() const = 0;

  /// Measured minus predicted, over what counts_standard_errors() says.
  /// @param effects  indices into library(), each at most once
  /// @param values   of base(), then of each effect's parameters
  /// @param trained  per unit: whether it may be learned from. What is free and linear (paths,
  ///                 offsets) is solved for within, on those units alone
  /// @return nothing if the model cannot be evaluated at these values
  virtual std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                                   const std::vector<double>& values,
                                                   const std::vector<bool>& trained) const = 0;

  /// Whether residuals count standard errors of the measurement; else they are relative to what a
  /// record shows.
  virtual bool counts_standard_errors() const { return false; }

  /// Standard errors that residuals are pressed beyond: see pressed(). Infinite: none is.
  virtual double believable() const { return std::numeric_limits<double>::infinity(); }

  /// What residuals scatter by at least, squared, however well a model fits them: of errors that
  /// repeat from unit to unit and count for each of them.
  virtual double least_mean_square() const { return 0; }

  /// Root mean square of the residuals if nothing at all were predicted, where they do not count
  /// standard errors.
  virtual double nothing_predicted() const { return 1; }

  /// Whether an evaluation costs so little that left-out conditions are fitted anew where they
  /// would else be forecast.
  virtual bool is_quick() const { return false; }

  /// What a law of unknown shape might depend on (ways, speeds, forces, load), one row for each
  /// value of the residuals. Empty if that is not known.
  virtual Eigen::MatrixXd states() const { return {}; }
};

}  // namespace rvbench::analysis
