#pragma once

#include <string>
#include <vector>

#include "bench/report/report.hpp"

/// The sections of the report, in their order. Each is HTML; empty if it has nothing to say.
namespace rvbench::bench::report {

std::string verdict_section(const ReportInput& input);
std::string matrix_section(const ReportInput& input);
std::string findings_section(const ReportInput& input);
std::string deciding_section(const ReportInput& input);  ///< the lines that a part was judged by
std::string article_section(const ReportInput& input);   ///< its rules on the first finding
std::string frequency_section(const ReportInput& input);
std::string signal_section(const ReportInput& input);   ///< time, spectra, IMFs, envelope spectra
std::string methods_section(const ReportInput& input);  ///< what each envelope method found
std::string correlation_section(const ReportInput& input);
std::string limits_section(const ReportInput& input);
std::string indicators_section(const ReportInput& input);  ///< the worst of each, and its limit
std::string population_section(const ReportInput& input);  ///< the unit among earlier ones
std::string population_text(const ReportInput& input);     ///< its first sentences, not escaped
std::string hysteresis_section(const ReportInput& input);  ///< loops of torque over torsion
std::string sensors_section(const ReportInput& input);
std::string settings_section(const ReportInput& input);
std::string signature_section(const ReportInput& input);
std::string style_sheet();       ///< of the page
std::string plot_style_sheet();  ///< of its plots, complete without the page's

/// Points that stand for all, six at most: of each speed, the first good record with the least load
/// and the one nearest to 100 %; of more speeds, evenly from the lowest to the highest. Without
/// planned speeds: the first six. Two at most give way, if need be, to points that the verdict has
/// its reasons from. Indices into judgement.points.
std::vector<std::size_t> representative_points(const Judgement& judgement);

/// HTML: which points these are and which speeds are left out; empty if they are all good ones.
/// @param others  where to find what is not shown, as a sentence
std::string shown_points(const Judgement& judgement, const std::string& others);

/// Index of the channel to show: where the strongest signature was read, else the loudest.
std::size_t shown_channel(const analysis::Examination& examination);

/// HTML: "within", or in bold "above", "below" or "could not be measured", and at how many points.
std::string state_of(const LimitCheck& check);

/// "605 rpm, 100 % load, repeat 1", or the name of the file.
std::string caption_of(const JudgedPoint& point);

/// "1210 rpm, 50 % load, repeat 1, accel_2x" for "recording.h5#004, accel_2x"; a place at no point
/// as it is.
std::string readable_place(const Judgement& judgement, const std::string& where);

}  // namespace rvbench::bench::report
