#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "bench/judgement.hpp"

namespace rvbench::bench {

/// Fewer do not show how much sound units scatter.
inline constexpr std::size_t fewest_sound_units = 3;

/// Files of sound units, one a unit: verdict.json, or a recording that is yet to be judged.
///
/// @param words  a file; a folder, of which each verdict.json below it counts, or, where there is
///               none, each recording; or a serial, of which the newest finished run counts
/// @param runs   the folder of runs
/// @return the files by name, or what is wrong with a word
/// Errors  none thrown. Source  definition
std::variant<std::vector<std::filesystem::path>, std::string> sound_files(
    const std::vector<std::string>& words, const std::filesystem::path& runs);

/// Judgements of sound units, each of a recording of its own.
class SoundUnits {
 public:
  struct Counted {};
  struct Untrusted {};  ///< its data cannot be trusted
  struct Repeated {     ///< its samples are those of another unit
    std::string file;   ///< of the other one
  };
  using Added = std::variant<Counted, Untrusted, Repeated>;

  /// Keeps the unit where it counts.
  Added add(const std::string& file, Judgement judgement);

  std::size_t size() const { return units_.size(); }

  std::vector<std::string> files() const;

  /// The file of the first unit that shares a recording with this judgement; empty if none does.
  std::string file_with_samples_of(const Judgement& judgement) const;

  std::vector<analysis::Diagnosis> diagnoses() const;

 private:
  struct Unit {
    std::string file;
    Judgement judgement;
  };
  std::vector<Unit> units_;
};

/// The kinematics with limits that sound units of the same kind set, and with what they show:
/// median + factor·scatter of each part's severity. The factor leaves 99.9 % of sound units within,
/// as far as so many can tell; from robust_limit()'s fewest on robustly, so that a bad one among
/// them does not count. A part that most units do not show keeps at least half the limit assumed:
/// their noise hides how much they scatter. Blows in phase keep a limit that is lower than these,
/// unless sound units reach it. A record in more noise is held against what its noise hides, up to
/// the limit assumed.
///
/// Shape   one diagnosis a unit, fewest_sound_units at the least
/// Units   of severities: 1
/// Errors  none thrown; a part that fewer units could judge keeps its limit
/// Source  analysis::robust_tolerance_factor(), analysis::one_sided_tolerance_factor()
analysis::Kinematics with_sound_units(analysis::Kinematics kinematics,
                                      const std::vector<analysis::Diagnosis>& units);

}  // namespace rvbench::bench
