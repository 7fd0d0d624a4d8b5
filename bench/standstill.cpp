#include "bench/standstill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/effect_edits.hpp"
#include "sim/simulate.hpp"

namespace rvbench::bench {
namespace {

constexpr double slowest = 0.01;  // of the fastest speed

// @param reach  samples: of half a wave
void leave_out_rests(const Eigen::VectorXd& speed, Eigen::Index reach, std::vector<char>& moves) {
  const double least = slowest * speed.cwiseAbs().maxCoeff();
  Eigen::Index since = -1;
  for (Eigen::Index i = 0; i <= speed.size(); ++i) {
    const bool rests = i < speed.size() && std::abs(speed[i]) < least;
    if (rests && since < 0) since = i;
    if (rests || since < 0) continue;
    if (i - since > 2 * reach) {  // else it only passes through zero
      const auto from = std::max<Eigen::Index>(since - reach, 0);
      const auto to = std::min(i + reach, speed.size());
      std::fill(moves.begin() + from, moves.begin() + to, char{0});
    }
    since = -1;
  }
}

Eigen::Index compared(const TimeRecord& record) {
  return (record.last - record.first) / record.thin;
}

// Per sample of a record.
std::vector<char> moving(const sim::PlantSpec& plant, const sim::TermLibrary& library,
                         const TimeRecord& record, double band_Hz) {
  std::vector<char> moves(static_cast<std::size_t>(record.excitation.samples()), 1);
  const bool is_driven = std::ranges::all_of(plant.outputs, [](const sim::OutputSpec& output) {
    return output.kind == sim::OutputKind::drive;
  });
  if (!is_driven) return moves;
  const double half_a_wave = band_Hz > 0 ? record.excitation.rate_Hz() / (2 * band_Hz) : 1;
  for (const sim::OutputSpec& output : plant.outputs) {
    const auto run = sim::simulate(sim::with_probes(plant, output.of, {sim::OutputKind::speed}),
                                   record.excitation, library);
    if (const auto* shown = std::get_if<sim::Simulated>(&run)) {
      leave_out_rests(shown->channels.front().samples, Eigen::Index(std::ceil(half_a_wave)), moves);
    }
  }
  return moves;
}

}  // namespace

void leave_out_standstill(const sim::PlantSpec& plant, const sim::TermLibrary& library,
                          TimeRecords& records) {
  for (TimeRecord& record : records.all) {
    const std::vector<char> moves = moving(plant, library, record, records.band_Hz);
    for (Eigen::Index k = 0; k < compared(record); ++k) {
      if (moves[std::size_t(record.first + k * record.thin)]) record.kept.push_back(k);
    }
  }
}

std::vector<std::string> standstill_notes(const TimeRecords& records) {
  std::vector<std::string> notes;
  for (const TimeRecord& record : records.all) {
    const auto kept = static_cast<double>(record.kept.size());
    const double share = 1 - kept / static_cast<double>(compared(record));
    if (share == 0) continue;
    notes.push_back(fmt::format(
        "{}: {:.0f} % of it stands still, where dry friction holds what it came to rest with; "
        "that is not compared",
        record.about.name, 100 * share));
  }
  return notes;
}

}  // namespace rvbench::bench
