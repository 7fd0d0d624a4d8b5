#pragma once

#include <string>

#include "analysis/compare/comparison.hpp"
#include "analysis/compare/headlines.hpp"
#include "analysis/kinematics.hpp"
#include "bench/console.hpp"

namespace rvbench::bench {

/// "CHANGED", "NOT CHANGED", "CANNOT TELL"
std::string spoken_word(analysis::ChangeWord word);

/// What changed from A to B, in a sentence or two: whose lines, and the strongest lines and levels
/// by name.
std::string compare_sentence(const analysis::Comparison& comparison,
                             const analysis::Kinematics& kinematics);

/// What is known of the rest: what would have been seen where nothing changed, of how much nothing
/// can be told, and what the scatter is worth. Never empty.
std::string compare_reservation(const analysis::Comparison& comparison);

/// "planet gear (tooth damage): 88 % of its cells, by +19.3 dB", the median; "by -7.6 to +9.4 dB"
/// where some rose and some fell. A cell is a line in a channel at a point.
std::string family_text(const analysis::FamilyHeadline& family,
                        const analysis::Kinematics& kinematics);

/// Of two amplitudes that are so many dB apart; of a level the amplitude itself, in its unit.
double ratio_from_dB(double dB);

/// "+6.1 dB"
std::string change_text(double change_dB);

/// "0.0123 → 0.0363 m/s²": the levels in A and in B.
std::string levels_text(const analysis::Change& change, const analysis::Comparison& comparison);

/// "1815 rpm, 100 % load, accel_1x"
std::string place_text(const analysis::Change& change, const analysis::Comparison& comparison);

/// The comparison on standard output.
void print_comparison(Console& console, const analysis::Comparison& comparison,
                      const analysis::Kinematics& kinematics);

}  // namespace rvbench::bench
