#pragma once

#include <cstddef>
#include <vector>

namespace rvbench::analysis {

/// A line of a spectrum, as families of lines are looked for in.
struct FamilyLine {
  double order = 0;
  double amplitude = 0;    ///< 0-to-peak, in any unit: says which line of several is the carrier
  bool explained = false;  ///< by the kinematics: a carrier of sidebands, but no new line itself
};

/// What a line is in its family.
struct FamilyMember {
  std::size_t line = 0;  ///< of the list
  /// The line whose sideband it is; its own index if it is a harmonic, or the carrier itself.
  std::size_t carrier = 0;
  int multiple = 0;  ///< of the spacing: from order 0 (harmonics), or from the carrier
};

/// Lines that stand a common spacing apart.
struct LineFamily {
  double spacing = 0;                   ///< in orders
  double spacing_error = 0;             ///< standard error, from how well the members fit
  double p_value = 1;                   ///< of so many pairs of lines that far apart by chance
  std::vector<FamilyMember> harmonics;  ///< on multiples of the spacing itself, lowest first
  std::vector<FamilyMember> sidebands;  ///< around carriers elsewhere, in order of their orders
};

struct FamilySearch {
  double near = 0;              ///< how far the order of a line may be off
  double smallest_spacing = 0;  ///< at least 4 · near
  double largest_spacing = 0;
  std::vector<double> known_spacings =
      {};  ///< of the kinematics: shafts. No family has one of them,
           ///< and lines that far from an explained one are explained
};

/// Families of lines that given kinematics do not explain: harmonic series, and sidebands around
/// lines explained or not, found by the spacing that most pairs of lines share. A pair counts if at
/// least one of it is not explained; order 0 counts as an explained line, so that a series starts
/// with its fundamental.
///
///     p = P(Poisson(λ) ≥ pairs at the spacing) · spacings tried
///
/// λ is what spacings nearby have, and no less than what lines spread evenly would have. The most
/// significant spacing is taken first, or what it is a multiple of, or a sum with a spacing that
/// was found before, if that is significant, too. From then on its harmonics are explained, and
/// sidebands of explained lines; the other families are made of the rest, with spacings that are no
/// multiples of those found. A family has p below 1e-3 and at least 3 pairs.
///
/// Shape    any number of lines (cost grows as their third power) → families, surest first
/// Units    orders of a shaft, or Hz, or cycles per sample: all of one kind
/// Errors   throws std::invalid_argument: near not above 0, spacings not in order, a line that is
///          not finite or not above 0
/// Limits   a single pair of sidebands around one carrier is no evidence of a spacing: two lines
///          are always some distance apart. sidebands_of() has another kind of evidence for it
/// Source   ours; the cepstrum finds the same spacings (Bogert, Healy & Tukey, 1963), without a
///          probability
std::vector<LineFamily> line_families(const std::vector<FamilyLine>& lines,
                                      const FamilySearch& search);

}  // namespace rvbench::analysis
