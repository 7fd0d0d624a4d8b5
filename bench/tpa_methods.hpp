#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "analysis/tpa/parametric_mounts.hpp"
#include "analysis/tpa/ranking_certainty.hpp"
#include "analysis/tpa/tpa_faults.hpp"
#include "bench/tpa_frfs.hpp"
#include "hal/config_reader.hpp"

namespace rvbench::bench {

/// A mount along the direction of a path, as operation tells it.
struct MountAnswer {
  DegreeOfFreedom path;
  analysis::MountParameters found, deviations;  ///< deviations: standard errors
};

/// What one method alone tells of a motion.
struct MethodFindings {
  std::vector<analysis::TpaFault> faults;
  double disagreement = not_known;  ///< of both halves of the indicators about blocked forces
  std::vector<MountAnswer> mounts;
  double mounts_score = not_known;  ///< at the lines that mounts were not fitted to
  Eigen::VectorXd ways;             ///< per line: in which references moved; empty: no references
};

/// One way from a motion to what paths contribute to it, at work on that motion.
class TpaMethod {
 public:
  virtual ~TpaMethod() = default;

  /// Over these blocks of the motion, by FRFs as measured or drawn within their errors.
  /// Errors  none thrown of what make() let pass. Threads  up to `threads`, 0: the free cores
  virtual analysis::PathContributions contributions(const analysis::FrfMatrix& frfs,
                                                    const std::vector<Eigen::Index>& blocks,
                                                    unsigned threads) const = 0;

  /// @param whole  contributions over all blocks, by the FRFs as measured
  virtual MethodFindings findings(const analysis::PathContributions& whole) const = 0;
};

/// A method at work, or why the data cannot be used by it.
using MadeTpaMethod = std::variant<std::unique_ptr<TpaMethod>, std::string>;

/// A method as a project names it. A new one is a new file and a line in tpa_methods().
struct NamedTpaMethod {
  std::string_view name;
  std::string_view how;    ///< for people: what it does
  bool needs_frfs = true;  ///< "frfs" or "hammer", "paths" and sensors to validate by
  void (*read)(hal::ConfigReader& project, TpaProject& into);  ///< keys of its own
  MadeTpaMethod (*make)(const TpaProject& project, const TpaFrfs& frfs,
                        analysis::OperatingSpectra motion);
};

NamedTpaMethod inverse_method();         ///< matrix_inverse_contributions()
NamedTpaMethod blocked_forces_method();  ///< blocked_forces()
NamedTpaMethod mounts_method();          ///< parametric_mounts()
NamedTpaMethod operational_method();     ///< operational_paths()

/// All of them; the first is the one of a project that names none.
const std::vector<NamedTpaMethod>& tpa_methods();

/// @throws std::invalid_argument if there is none of that name
const NamedTpaMethod& tpa_method(std::string_view name);

}  // namespace rvbench::bench
