#pragma once

namespace rvbench::analysis {

/// Lines of a spectrum that two tones must lie apart to be told apart, under a Hann window: each
/// fills two lines to either side, so that from four lines on neither touches the other's peak.
/// Source  Harris, Proc. IEEE 66(1), 51-83 (1978), table 1: 4 lines from null to null
inline constexpr double lines_to_part = 4;

/// Of a spectrum's step: how far a line may lie from an order and still be taken for it.
/// Source  ours: half a line where the peak falls between two, and a tenth for noise
inline constexpr double same_line = 0.6;

/// Relative: what orders may be off where a mean speed was stated, and no angle measured.
/// Source  ours: 0.2 rpm of 605
inline constexpr double stated_speed_error = 3e-4;

/// Relative: how far orders may be off for the speed that they were made with.
/// Units  dimensionless. Errors  none thrown. Source  of stated_speed_error
constexpr double speed_error(bool angle_is_measured) {
  return angle_is_measured ? 0 : stated_speed_error;
}

/// How far a line may lie from an order and still be taken for it.
/// Units  orders; `resolution` is that of the spectrum. Errors  none thrown
/// Source  same_line, stated_speed_error: whichever is more
constexpr double near_order(double order, double resolution, bool angle_is_measured) {
  const double by_speed = speed_error(angle_is_measured) * (order < 0 ? -order : order);
  return same_line * resolution > by_speed ? same_line * resolution : by_speed;
}

/// Whether an order is a multiple of another, as far as it may be off.
/// @param off  relative to `order`
/// Units  of the orders. Errors  none thrown. Source  definition
bool is_multiple(double order, double of, double off);

/// Turns of the reference shaft that a record must span to part two orders: 4 / |a − b|. Orders
/// 120/121 and 1 take 484 input turns, four of the output.
///
/// Units   orders in events per turn of the reference shaft → turns of that shaft
/// Errors  throws std::invalid_argument: an order not finite, or both the same
/// Source  lines_to_part; lines of a record of T turns lie 1/T apart
double turns_to_part(double order_a, double order_b);

/// Whether a record of so many turns parts two orders: to be asked before either is named.
///
/// @param speed_error  relative: how far the speed may be off that orders were made with; what is
///                     uncertain by it cannot be parted by any record. 0 where an angle was
///                     measured
/// Units   orders in events per turn of the reference shaft, turns of that shaft
/// Errors  throws std::invalid_argument: an order not finite, turns or speed_error below 0
/// Source  of turns_to_part()
bool are_parted(double order_a, double order_b, double turns, double speed_error = 0);

/// Whether a line lies where its order says, to a tenth of a line of a record of so many turns. A
/// line of a spectrum loses 1 % by that, one of an average over turns 2 %; of one that is further
/// off, what is read is a neighbour.
///
/// Units   order in events per turn of the reference shaft, turns of that shaft; speed_error
///         relative, as are_parted() has it
/// Errors  none thrown. Source  ours: a line that is off by d lines is sin(πd)/(πd) in an average
bool is_placed(double order, double turns, double speed_error);

}  // namespace rvbench::analysis
