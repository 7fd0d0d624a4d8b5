#pragma once

#include <vector>

#include "bench/candidate_probes.hpp"
#include "bench/order_records.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// Lines at multiples of the supply's frequency, of the mains', and at twice the slip of motors,
/// that a condition's records can show.
std::vector<OrderFeature> timed_lines(const sim::PlantSpec& plant, const OrderCondition& condition);

/// Where such a line is at this share of the condition's nominal speed.
double frequency_Hz(const sim::PlantSpec& plant, const OrderCondition& condition,
                    const OrderFeature& line, double speed_share);

/// Where an output shows lines that follow time, in orders of each record's period, and where these
/// modulate what goes round: sums and differences, of which SteadyPlant tells nothing.
/// @param records       of the condition
/// @param period_turns  turns of the reference shaft per period
std::vector<double> orders_of_timed(const sim::PlantSpec& plant, const OrderCondition& condition,
                                    const std::vector<const OrderRecord*>& records,
                                    double period_turns, std::size_t output);

/// Of any record: the forces of all conditions bend alike, and are sampled alike.
int highest_order(const std::vector<OrderCondition>& conditions);

/// First, middle and last condition: what no load or no speed shows, another may.
std::vector<std::size_t> probed_conditions(const std::vector<OrderCondition>& conditions);

/// Frequencies of the lines that the nominal plant shows strongly, those under the middle one of
/// the conditions first. None is within a tenth of another.
std::vector<double> strong_lines_Hz(const std::vector<OrderCondition>& conditions);

/// Gives each condition its features: the outputs' means, lines of the orders that a recording
/// shows or that the plant or a candidate would bring, but for those beside a line that follows
/// time, and these.
/// @param probes        of the probed conditions
/// @param period_turns  turns of the reference shaft per period
void choose_features(const sim::PlantSpec& plant, const std::vector<OrderRecord>& records,
                     const std::vector<CandidateProbe>& probes, double period_turns,
                     std::vector<OrderCondition>& conditions);

}  // namespace rvbench::bench
