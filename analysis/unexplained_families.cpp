#include "analysis/unexplained_families.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/spectral_lines.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t families_listed = 12;

}  // namespace

std::vector<SpectralLine> unexplained_families(const std::vector<Examination>& points,
                                               const Kinematics& kinematics) {
  std::vector<SpectralLine> lines;
  for (const Examination& point : points) {
    for (const ChannelExamination& channel : point.channels) {
      for (const SpectralLine& line : channel.lines) {
        if (!line.meaning.empty()) continue;
        const auto same = std::find_if(lines.begin(), lines.end(), [&](const SpectralLine& other) {
          return std::abs(other.order - line.order) < 1e-3 * line.order;
        });
        if (same == lines.end()) {
          lines.push_back(line);
        } else if (line.amplitude > same->amplitude) {
          *same = line;
        }
      }
    }
  }
  std::sort(lines.begin(), lines.end(),
            [](const SpectralLine& a, const SpectralLine& b) { return a.amplitude > b.amplitude; });
  if (lines.size() > 200) lines.resize(200);
  std::vector<SpectralLine> result = families(std::move(lines), kinematics);
  if (result.size() > families_listed) result.resize(families_listed);
  return result;
}

}  // namespace rvbench::analysis
