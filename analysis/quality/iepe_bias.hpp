#pragma once

#include <optional>
#include <vector>

#include "analysis/quality/heard.hpp"

namespace rvbench::analysis {

/// What is left to see of a broken IEPE supply. The supply drives 2-20 mA into the sensor, whose
/// working bias is 8-14 V; a short pulls it to 0 V, an open cable lets it rise to the 20-30 V of
/// the source. AC coupling keeps the bias from the record: what arrives of both is the front end's
/// own noise, and, where the cable opened during the record, a jump that decays (see find_drift,
/// and clipping).
///
/// Whether a channel hears the front end only:
/// * less than 1/100 of the middle one of at least two others of its (stated) unit. On one machine
///   paths differ, but the cross-talk of a sound sensor's axes alone, 1-5 %, is more;
/// * white from 20 Hz on, within 6 dB from octave to octave, less power in lines than in noise: a
///   machine that turns is neither.
///
/// Limits  a channel that is a hundred times below its neighbours and shows a line is quiet, not
///         dead: nothing is said, nor of a record of one or two channels, nor where the machine
///         itself is less than 100 times the front end's noise. A short and an open cable look
///         alike.
/// @param one  index of the channel in question
/// Errors  throws std::out_of_range: no such channel. Source  ours, from the supply as above
bool hears_front_end_only(const std::vector<Heard>& channels, std::size_t one);

/// Bias of a channel that is recorded DC-coupled, where it is that of an open cable: 18-36 V.
/// Empty otherwise. A bias of 0 V, of a short, is what AC-coupled channels have as well; sensors of
/// other kinds work up to 5 V, and gravity itself is no more than 11 V even at 1.1 V per m/s², the
/// most that is made (10 V/g). A sensitivity above that is taken for one in other units.
/// Units   V
/// Errors  none thrown; empty, too, of a channel with a lost sample, which is told as such
/// Source  ours
std::optional<double> open_cable_bias_V(const Channel& channel);

}  // namespace rvbench::analysis
