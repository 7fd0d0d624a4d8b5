#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "tests/proof/seal/draw.hpp"

namespace seal {

/// Something that holds a slide back. It remembers: asked once a step, in order of time.
class SlideEffect {
 public:
  virtual ~SlideEffect() = default;
  virtual double force_N(double way_m, double speed_m_s, double step_s) = 0;
};

/// What is much in a machine.
struct SlideScales {
  double force_N = 1, way_m = 1, speed_m_s = 1;
};

/// An effect that may be hidden in a slide: what the answer ought to be, and how to make it.
struct HiddenInSlide {
  std::string name;
  std::vector<std::string> also = {};  ///< other names that such records cannot tell it from
  std::string parameter = {};          ///< of rvbench's term, that the size is comparable with
  double size = 1;                     ///< that would be much
  std::function<std::unique_ptr<SlideEffect>(double size)> make;
  /// Of a size of one: the law of rvbench's term where it is not quite this one's; the parameter is
  /// then compared with the size of that which comes nearest.
  std::function<double(double way_m, double speed_m_s)> law = {};
};

/// A law of rvbench's as an effect.
HiddenInSlide as_law(const HiddenInSlide& effect);

HiddenInSlide asymmetric_friction(const SlideScales& usual, Draw& draw);
HiddenInSlide coulomb_friction(const SlideScales& usual, Draw& draw);
HiddenInSlide cubic_stiffness(const SlideScales& usual, Draw& draw);
HiddenInSlide looseness(const SlideScales& usual, Draw& draw);
HiddenInSlide nonlinear_damping(const SlideScales& usual, Draw& draw);
HiddenInSlide pumped_spring(const SlideScales& usual, Draw& draw);
HiddenInSlide quadratic_stiffness(const SlideScales& usual, Draw& draw);
HiddenInSlide screw_ripple(const SlideScales& usual, Draw& draw);
HiddenInSlide shear_thinning(const SlideScales& usual, Draw& draw);
HiddenInSlide stiffness_hysteresis(const SlideScales& usual, Draw& draw);
HiddenInSlide stribeck_friction(const SlideScales& usual, Draw& draw);
HiddenInSlide viscous_friction(const SlideScales& usual, Draw& draw);

}  // namespace seal
