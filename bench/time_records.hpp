#pragma once

#include <variant>
#include <vector>

#include "bench/campaign.hpp"
#include "sim/excitation.hpp"
#include "sim/term_library.hpp"

namespace rvbench::bench {

inline constexpr int units_per_record = 12;

/// A record of a plant's inputs and outputs, and which of its samples are compared.
struct TimeRecord {
  RecordLabels about;
  Eigen::Index lead_in = 0;
  sim::Excitation excitation;
  std::vector<Eigen::VectorXd> measured;  ///< per output of the plant
  Eigen::Index into_step = 0;             ///< samples that the model needs to come into step
  Eigen::Index first = 0, last = 0;       ///< what is compared
  Eigen::Index thin = 1;                  ///< of these, each so many-th
  std::vector<Eigen::Index> kept = {};    ///< and of those, these: see leave_out_standstill()
};

struct TimeRecords {
  double band_Hz = 0;  ///< what a prescribed motion is known below; 0: no limit
  std::vector<TimeRecord> all;
  std::vector<double> spread;  ///< per output: of what was measured

  /// What is only to be predicted tells nothing, not even how large things are.
  const TimeRecord& first_learned() const;
};

/// @return why plant and recordings do not fit: all faults of recordings at once
std::variant<TimeRecords, Refusal> time_records(const sim::PlantSpec& plant,
                                                const Campaign& campaign,
                                                const sim::TermLibrary& library);

/// Standard deviation of the samples; 0 of none.
double deviation(const Eigen::VectorXd& x);

}  // namespace rvbench::bench
