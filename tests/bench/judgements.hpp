#pragma once

#include "bench/judgement.hpp"

namespace rvbench::test {

inline analysis::Finding misaligned_shaft() {
  analysis::Finding finding;
  finding.component = "input_shaft";
  finding.mechanism = "misalignment";
  finding.table4_item = "drive shaft";
  finding.order = 1;
  finding.frequency_Hz = 10.08;
  finding.points = {"recording.h5#000"};
  finding.imfs = {1, 2};
  finding.log_likelihood_ratio = 812.5;
  finding.p_value = 1e-12;
  finding.severity = 0.6;
  finding.severity_low = 0.55;
  finding.severity_high = 0.64;
  finding.limit = 0.2;
  finding.confidence = 0.75;
  finding.advice = "Stiffen, shorten or support the input shaft.";
  finding.line_orders = {1, 2, 39.0 / 121};
  finding.line_depths = {0.5, 0.3, 0.05};
  finding.growth.load = {0.9, 0.1};
  return finding;
}

inline analysis::Finding silent_sun() {
  analysis::Finding finding;
  finding.component = "sun_gear";
  finding.mechanism = "profile_error";
  finding.order = 120.0 / 121;
  finding.log_likelihood_ratio = 17.5;
  finding.p_value = 0.4;
  finding.severity = 0.01;
  finding.severity_low = 0;
  finding.severity_high = 0.02;
  finding.limit = 0.1;
  return finding;
}

inline bench::JudgedPoint recorded_point() {
  bench::JudgedPoint recorded;
  recorded.planned_speed_rpm = 605;
  recorded.torque_Nm = 1.4;
  recorded.examination.source = "recording.h5#000";
  recorded.examination.speed_rpm = 604.8;
  recorded.examination.load_pct = 100;
  recorded.examination.repeat = 1;
  recorded.examination.periods = 4.2;
  recorded.examination.resolvable = true;
  recorded.examination.channels = {{"accel_1x",
                                    "m/s²",
                                    2.0,
                                    18.6,
                                    3.1,
                                    {0.8, 0.4, 0.2, 0.1, 0.08, 0.01, 0.0, 0.0, 0.0},
                                    {{1, 10.08, 0.2, 1e-9, "input shaft"}},
                                    {{"kurtosis", "", 3.1, "1"},
                                     {"band_rms", "below the meshes", 0.4, "m/s²"},
                                     {"band_rms", "sun-planet mesh", 1.5, "m/s²"}}}};
  recorded.examination.indicators = {{"torque_ripple", "input_torque", 0.12, "1"}};
  analysis::SignatureScore score;
  score.order = 1;
  score.depth = 0.6;
  score.amplitude = 1.2;
  score.depth2_variance = 1e-4;
  score.log_likelihood_ratio = 812.5;
  score.p_value = 1e-12;
  score.imf = 1;
  score.line_orders = {1, 2};
  score.line_depths = {0.5, 0.3};
  score.channel_amplitudes = {0.6};
  recorded.examination.scores = {score};
  return recorded;
}

/// A reducer that was wound to and fro: no vibration, no orders, and nothing amiss.
inline bench::JudgedPoint wound_point() {
  bench::JudgedPoint wound;
  wound.planned_speed_rpm = 30;
  wound.examination.source = "recording.h5#001";
  wound.examination.load_pct = 125;
  wound.examination.repeat = 1;
  wound.examination.of_hysteresis = true;
  wound.examination.scores.resize(1);
  wound.examination.indicators = {{"lost_motion", "", 0.8, "arcmin", 0.02}};
  return wound;
}

/// A hand-made run of a bad unit: two points, one of them never recorded, and one finding.
inline bench::Judgement failed_run() {
  bench::Judgement judgement;
  judgement.ending = {Outcome::fail, ErrorKind::none, "input_shaft: misalignment"};
  judgement.machine = "RV-20E";
  judgement.facts.serial = "A-17 <&\"'>";
  judgement.facts.started_utc = "20260102T030405Z";
  judgement.facts.judged_utc = "20260102T030611Z";
  judgement.facts.plan = "quick";
  judgement.facts.rig = "sim";
  judgement.facts.preset = "input_shaft";
  judgement.facts.seed = 18446744073709551615ULL;  // does not fit a double
  judgement.facts.software = "0.1.0 (test)";
  judgement.facts.duration_s = 123.5;
  judgement.facts.events = {{1.5, "armed"}};
  judgement.diagnosis.findings = {misaligned_shaft()};
  judgement.diagnosis.not_shown = {silent_sun()};
  judgement.diagnosis.unexplained = {{5.147, 171.56, 0.2, 1e-9, ""}};
  judgement.diagnosis.quality = {{"point 000, accel_1x", "3 samples lost", false}};
  judgement.diagnosis.resolvable = true;
  judgement.limits = {{"acceleration_peak", "", "g", 0.5, 1.9, "recording.h5#000, accel_1x", false,
                       "healthy units stay near 0.1 g"}};

  bench::JudgedPoint missing;
  missing.status = "not_recorded";
  missing.planned_speed_rpm = 1210;
  missing.examination.load_pct = 50;
  missing.examination.repeat = 2;
  judgement.points = {recorded_point(), missing};
  return judgement;
}

inline bench::Judgement passed_run() {
  bench::Judgement judgement = failed_run();
  judgement.ending = {Outcome::pass, ErrorKind::none, "no finding above its limit"};
  judgement.facts.serial = "A18";
  judgement.facts.preset = "healthy";
  judgement.diagnosis.findings.clear();
  judgement.limits.front().measured = 0.1;
  judgement.limits.front().passed = true;
  judgement.points.pop_back();
  return judgement;
}

}  // namespace rvbench::test
