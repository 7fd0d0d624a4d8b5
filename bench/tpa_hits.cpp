#include "bench/tpa_hits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/frf/hammer_test.hpp"
#include "analysis/frf/signed_axis.hpp"
#include "bench/stop_on_signal.hpp"
#include "hal/formats/read_recordings.hpp"

namespace rvbench::bench {
namespace {

using analysis::FrfChannel;
using analysis::HammerSeries;

// What is wrong with the channels of a hit; empty: nothing.
std::string find_channels(const Recording& record, const TpaProject& project,
                          std::vector<const Channel*>& found) {
  const Channel* force = record.find(project.hammer->channel);
  if (force == nullptr) return "no channel " + project.hammer->channel + ", the hammer";
  found.push_back(force);
  for (const DegreeOfFreedom& sensor : sensors_of(project)) {
    const auto is_it = [&](const Channel& channel) {
      return &channel != force &&
             analysis::same_axis({channel.info.name, channel.info.direction}, sensor) != 0;
    };
    const auto count = std::ranges::count_if(record.channels, is_it);
    if (count != 1) {
      return analysis::name_of(sensor) +
             (count == 0 ? ": no channel" : fmt::format(": {} channels", count));
    }
    found.push_back(&*std::ranges::find_if(record.channels, is_it));
  }
  for (const Channel* channel : found) {
    if (!(channel->rate_Hz > 0)) return "states no sample rate";
    if (channel->rate_Hz != force->rate_Hz || channel->samples.size() != force->samples.size()) {
      return channel->info.name + " " + channel->info.direction +
             ": other rate or length than the hammer's";
    }
  }
  return "";
}

analysis::FrfSetup setup_of(const std::vector<const Channel*>& channels, const TpaHits& hits,
                            const TpaHammer& hammer) {
  analysis::FrfSetup setup;
  setup.excitations.push_back({hits.place, channels[0]->info.unit, hammer.range_N});
  for (std::size_t i = 1; i < channels.size(); ++i) {
    const ChannelInfo& info = channels[i]->info;
    setup.responses.push_back({analysis::positive({info.name, info.direction}), info.unit,
                               hammer.acceleration_range_m_s2});
  }
  return setup;
}

analysis::FrfRecord frf_record(const std::string& source,
                               const std::vector<const Channel*>& channels) {
  const Channel& force = *channels.front();
  analysis::FrfRecord record{
      source, force.rate_Hz, force.samples,
      Eigen::MatrixXd(force.samples.size(), Eigen::Index(channels.size()) - 1)};
  for (std::size_t i = 1; i < channels.size(); ++i) {
    record.responses.col(Eigen::Index(i) - 1) =
        analysis::axis_of(channels[i]->info.direction).sign * channels[i]->samples;
  }
  return record;
}

// The series of a place; those of one place are one.
HammerSeries& series_at(std::vector<HammerSeries>& session, analysis::FrfSetup setup) {
  for (HammerSeries& series : session) {
    if (series.setup.excitations.front().place == setup.excitations.front().place) return series;
  }
  session.push_back({std::move(setup), {}});
  return session.back();
}

// What of a hit is in other units than the first one at its place; empty: nothing.
std::string other_units(const analysis::FrfSetup& setup, const analysis::FrfSetup& first) {
  const auto differs = [](const FrfChannel& one, const FrfChannel& other) {
    return one.unit != other.unit;
  };
  const auto text = [](const FrfChannel& one, const FrfChannel& other) {
    return analysis::name_of(one.place) + ": in \"" + one.unit +
           "\", an earlier hit at this place in \"" + other.unit + "\"";
  };
  if (differs(setup.excitations.front(), first.excitations.front())) {
    return text(setup.excitations.front(), first.excitations.front());
  }
  for (std::size_t i = 0; i < setup.responses.size(); ++i) {
    if (differs(setup.responses[i], first.responses[i])) {
      return text(setup.responses[i], first.responses[i]);
    }
  }
  return "";
}

// Adds the hits of one file. @return why not; empty if it did
std::string add_file(const TpaHits& hits, const TpaProject& project,
                     std::vector<HammerSeries>& session) {
  auto read = hal::read_recordings(hits.file);
  if (!read) return read.error().where;
  for (const Recording& record : read.value()) {
    std::vector<const Channel*> channels;
    const std::string why = find_channels(record, project, channels);
    if (!why.empty()) return record.source + ": " + why;
    const analysis::FrfSetup setup = setup_of(channels, hits, *project.hammer);
    HammerSeries& series = series_at(session, setup);
    const std::string units = other_units(setup, series.setup);
    if (!units.empty()) return record.source + ": " + units;
    series.hits.push_back(frf_record(record.source, channels));
  }
  return "";
}

std::string reasons_of(const analysis::JudgedHit& hit) {
  std::string text;
  for (const analysis::HitFault& fault : hit.faults) {
    text += (text.empty() ? "" : "; ") + fault.reason;
  }
  return text;
}

PlaceDeviations deviations_of(const analysis::FrfSetup& setup,
                              std::vector<Eigen::MatrixXcf> deviations) {
  PlaceDeviations place{setup.excitations.front().place, {}, std::move(deviations)};
  for (const FrfChannel& channel : setup.responses) place.responses.push_back(channel.place);
  return place;
}

// Whether the band holds lines of a hit, and none beyond them; if not, that is told when responses
// are cut to it.
bool has_lines(const HammerSeries& series, const analysis::FrfBand& band) {
  return std::ranges::all_of(series.hits, [&](const analysis::FrfRecord& hit) {
    const double samples = double(hit.responses.rows());
    const auto lines = analysis::lines_of(band, 0, hit.rate_Hz / samples);
    return lines.count > 0 && double(lines.first + lines.count) <= std::floor(samples / 2) + 1;
  });
}

std::variant<MeasuredHits, TpaRefusal> averaged(const std::vector<HammerSeries>& session,
                                                const analysis::FrfBand& band) {
  MeasuredHits measured;
  TpaRefusal refusal;
  analysis::HammerOptions options;
  if (std::ranges::all_of(session, [&](const auto& one) { return has_lines(one, band); })) {
    options.deviations_in = band;
  }
  std::vector<analysis::HammerResult> results = analysis::measure_session(session, options);
  for (std::size_t i = 0; i < results.size(); ++i) {
    measured.hits += results[i].hits.size();
    for (const analysis::JudgedHit& hit : results[i].hits) {
      if (!hit.accepted()) measured.rejected.push_back({hit.source, reasons_of(hit)});
    }
    for (const analysis::EstimatedResponse& estimated : results[i].estimates.responses) {
      measured.responses.push_back(estimated.response);
    }
    measured.deviations.push_back(
        deviations_of(session[i].setup, std::move(results[i].deviations)));
    if (!results[i].estimates.responses.empty()) continue;
    refusal.push_back(fmt::format(
        "{}: none of its {} hits can be used; the last: {}",
        analysis::name_of(session[i].setup.excitations.front().place), results[i].hits.size(),
        measured.rejected.empty() ? "" : measured.rejected.back().reason));
  }
  if (!refusal.empty()) return refusal;
  return measured;
}

}  // namespace

analysis::FrfBand whole_band(const TpaProject& project) {
  analysis::FrfBand band{project.bands.front().first_Hz, project.bands.front().last_Hz};
  for (const analysis::TpaBand& one : project.bands) {
    band.from_Hz = std::min(band.from_Hz, one.first_Hz);
    band.to_Hz = std::max(band.to_Hz, one.last_Hz);
  }
  return band;
}

std::vector<DegreeOfFreedom> sensors_of(const TpaProject& project) {
  std::vector<DegreeOfFreedom> all = project.indicators;
  for (const auto* role : {&project.targets, &project.validation}) {
    for (const DegreeOfFreedom& place : *role) {
      if (std::ranges::find(all, place) == all.end()) all.push_back(place);
    }
  }
  return all;
}

std::variant<MeasuredHits, TpaRefusal> measure_hits(const TpaProject& project, ProgressBar& bar,
                                                    const std::stop_token& stop) {
  std::vector<HammerSeries> session;
  TpaRefusal refusal;
  const std::vector<TpaHits>& files = project.hammer->hits;
  for (std::size_t i = 0; i < files.size(); ++i) {
    end_if_stopped(stop);
    bar.show("hammer", double(i) / double(files.size() + 1), analysis::name_of(files[i].place));
    const std::string why = add_file(files[i], project, session);
    if (!why.empty()) refusal.push_back(why);
  }
  if (!refusal.empty()) return refusal;
  bar.show("hammer", double(files.size()) / double(files.size() + 1), "averages");
  return averaged(session, whole_band(project));
}

}  // namespace rvbench::bench
