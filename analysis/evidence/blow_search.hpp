#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/blow_lines.hpp"
#include "analysis/evidence/residual_envelope.hpp"

namespace rvbench::analysis {

/// Lines of a part that strikes: blow_harmonics, each with sidebands that count up to their
/// harmonic.
/// Units   orders of the input shaft
struct BlowComb {
  double order = 0;
  double sideband = 0;  ///< 0: none

  double sum(const BlowLines& lines, double stretch) const;
};

struct FoundBlows {
  double stretch = 1;
  double sum = 0;
  double excess = 0;  ///< over the median of the decoys
  double p_value = 1;
  double smallest_visible = not_known;
};

/// Half a line at the highest harmonic: no finer stretch makes a difference.
double step_of(const BlowComb& comb, const BlowLines& lines);

/// Takes all that one part explains: more harmonics than are asked for, and two sidebands to each
/// side.
void take_family(const BlowComb& comb, double stretch, BlowLines& lines);

/// Searches one record for a comb, and weighs it against the same search where the part has no
/// lines.
class BlowSearch {
 public:
  BlowSearch(const std::vector<ResidualEnvelope>& channels, const Kinematics& kinematics)
      : channels_(channels), k_(kinematics) {}

  /// The best stretch within `reach` of `centre`, both relative.
  FoundBlows operator()(const BlowComb& comb, const BlowLines& lines, double centre,
                        double reach) const;

 private:
  const std::vector<ResidualEnvelope>& channels_;
  const Kinematics& k_;
};

}  // namespace rvbench::analysis
