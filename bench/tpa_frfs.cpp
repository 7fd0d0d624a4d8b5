#include "bench/tpa_frfs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/frf/signed_axis.hpp"
#include "analysis/tpa/smoothed_frfs.hpp"
#include "bench/stop_on_signal.hpp"
#include "bench/tpa_hits.hpp"
#include "bench/tpa_methods.hpp"
#include "hal/formats/read_frequency_responses.hpp"

namespace rvbench::bench {
namespace {

using Responses = std::vector<FrequencyResponse>;

std::variant<MeasuredHits, TpaRefusal> ready_frfs(const TpaProject& project, ProgressBar& bar,
                                                  const std::stop_token& stop) {
  MeasuredHits read;
  TpaRefusal refusal;
  for (std::size_t i = 0; i < project.frf_files.size(); ++i) {
    end_if_stopped(stop);
    bar.show("FRFs", double(i) / double(project.frf_files.size()), project.frf_files[i]);
    auto file = hal::read_frequency_responses(project.frf_files[i]);
    if (!file) {
      refusal.push_back(file.error().where);
      continue;
    }
    std::ranges::move(std::move(file).value(), std::back_inserter(read.responses));
  }
  if (!refusal.empty()) return refusal;
  return read;
}

// What belongs to the project; a file may hold more.
void keep_wanted(const TpaProject& project, Responses& responses) {
  const std::vector<DegreeOfFreedom> sensors = sensors_of(project);
  std::erase_if(responses, [&](const FrequencyResponse& response) {
    return !analysis::holds(sensors, analysis::positive(response.response)) ||
           !analysis::holds(project.paths, analysis::positive(response.excitation));
  });
}

// Leaves the lines from the lowest band's first to the highest one's last. @return why not
std::string cut_to(const analysis::FrfBand& band, FrequencyResponse& response) {
  const auto [first, count] = analysis::lines_of(band, response.first_Hz, response.step_Hz);
  if (first + count > response.values.size() || count < 1 ||
      band.from_Hz < response.first_Hz - response.step_Hz) {
    return fmt::format("lines from {:g} to {:g} Hz do not reach over the bands, {:g} to {:g} Hz",
                       response.first_Hz, response.frequency_Hz(response.values.size() - 1),
                       band.from_Hz, band.to_Hz);
  }
  response.first_Hz = response.frequency_Hz(first);
  response.values = response.values.segment(first, count).eval();
  if (response.coherence.size() >= first + count) {
    // Rounding of a perfect one may lift it above 1.
    response.coherence = response.coherence.segment(first, count).cwiseMin(1).eval();
  }
  return "";
}

// What of the project has no response at all: a matrix cannot miss a row that it does not know.
void note_absent(const TpaProject& project, const Responses& responses, TpaRefusal& refusal) {
  for (const DegreeOfFreedom& sensor : sensors_of(project)) {
    const bool is_there = std::ranges::any_of(responses, [&](const FrequencyResponse& response) {
      return analysis::positive(response.response) == sensor;
    });
    if (!is_there) refusal.push_back(analysis::name_of(sensor) + ": no FRF to this sensor");
  }
  for (const DegreeOfFreedom& path : project.paths) {
    const bool is_there = std::ranges::any_of(responses, [&](const FrequencyResponse& response) {
      return analysis::positive(response.excitation) == path;
    });
    if (!is_there) refusal.push_back(analysis::name_of(path) + ": no FRF from this path");
  }
}

void note_bands_without_line(const TpaProject& project, const analysis::FrfMatrix& matrix,
                             TpaRefusal& refusal) {
  const analysis::LineGrid grid = grid_of(matrix);
  for (const analysis::TpaBand& band : project.bands) {
    Eigen::Index lines = 0;
    for (Eigen::Index line = 0; line < grid.lines; ++line) {
      if (analysis::holds(band, grid, line)) ++lines;
    }
    if (lines > 0) continue;
    refusal.push_back(
        fmt::format("band {:g} to {:g} Hz: holds none of the lines, which are {:g} Hz apart",
                    band.first_Hz, band.last_Hz, grid.step_Hz));
  }
}

// No FRFs, but the lines at which spectra are to be taken.
std::variant<TpaFrfs, TpaRefusal> lines_alone(const TpaProject& project) {
  const auto [first, count] = analysis::lines_of(whole_band(project), 0, project.step_Hz);
  TpaFrfs none;
  none.matrix.first_Hz = double(first) * project.step_Hz;
  none.matrix.step_Hz = project.step_Hz;
  none.matrix.values = {0, 0, std::max<Eigen::Index>(0, count)};
  none.coherent.is_used.assign(std::size_t(none.matrix.values.lines), true);
  TpaRefusal refusal;
  note_bands_without_line(project, none.matrix, refusal);
  if (!refusal.empty()) return refusal;
  return none;
}

// Rows and signs as the matrix has them.
Eigen::MatrixXcf as_in_matrix(const Eigen::MatrixXcf& deviations, const PlaceDeviations& place,
                              const analysis::FrfMatrix& matrix) {
  Eigen::MatrixXcf rows(matrix.values.rows, deviations.cols());
  for (std::size_t row = 0; row < matrix.responses.size(); ++row) {
    for (std::size_t i = 0; i < place.responses.size(); ++i) {
      const double sense = analysis::same_axis(place.responses[i], matrix.responses[row]) *
                           analysis::axis_of(place.excitation.direction).sign;
      if (sense != 0) {
        rows.row(Eigen::Index(row)) = float(sense) * deviations.row(Eigen::Index(i));
      }
    }
  }
  return rows;
}

// How hits differ, smoothed as the FRFs; empty where none are known.
std::vector<analysis::ColumnDeviations> column_deviations(
    const std::vector<PlaceDeviations>& places, const analysis::SmoothedFrfs& smooth) {
  const analysis::FrfMatrix& matrix = smooth.frfs;
  std::vector<analysis::ColumnDeviations> columns;
  for (const DegreeOfFreedom& excitation : matrix.excitations) {
    const auto place = std::ranges::find_if(places, [&](const PlaceDeviations& one) {
      return analysis::positive(one.excitation) == excitation;
    });
    if (place == places.end() || place->deviations.empty()) return {};
    analysis::ColumnDeviations& hits = columns.emplace_back();
    for (const Eigen::MatrixXcf& hit : place->deviations) {
      hits.push_back(analysis::smoothed_alike(as_in_matrix(hit, *place, matrix), smooth.lines));
    }
  }
  return columns;
}

std::variant<TpaFrfs, TpaRefusal> assembled(const TpaProject& project, MeasuredHits measured) {
  Responses& responses = measured.responses;
  keep_wanted(project, responses);
  TpaRefusal refusal;
  note_absent(project, responses, refusal);
  if (!refusal.empty()) return refusal;
  const analysis::FrfBand band = whole_band(project);
  for (FrequencyResponse& response : responses) {
    const std::string why = cut_to(band, response);
    if (!why.empty()) return TpaRefusal{response.source + ": " + why};
  }
  auto put_together = analysis::assemble_frf_matrix(responses, project.paths);
  if (!put_together.matrix) return put_together.faults;
  note_bands_without_line(project, *put_together.matrix, refusal);
  if (!refusal.empty()) return refusal;
  analysis::SmoothedFrfs smooth = analysis::smooth_frfs(std::move(*put_together.matrix));
  auto deviations = column_deviations(measured.deviations, smooth);
  analysis::HammerAlignment alignment = analysis::hammer_alignment(smooth.frfs);
  return TpaFrfs{analysis::aligned_frfs(smooth.frfs, alignment),
                 smooth.frfs,
                 std::move(deviations),
                 std::move(alignment),
                 analysis::coherent_lines(responses, project.least_coherence),
                 analysis::direction_doubts(responses, band),
                 measured.hits,
                 std::move(measured.rejected)};
}

}  // namespace

analysis::LineGrid grid_of(const analysis::FrfMatrix& matrix) {
  return {matrix.first_Hz, matrix.step_Hz, matrix.values.lines};
}

std::variant<TpaFrfs, TpaRefusal> read_tpa_frfs(const TpaProject& project, ProgressBar& bar,
                                                const std::stop_token& stop) {
  if (!tpa_method(project.method).needs_frfs) return lines_alone(project);
  auto read = project.hammer ? measure_hits(project, bar, stop) : ready_frfs(project, bar, stop);
  if (auto* refusal = std::get_if<TpaRefusal>(&read)) return std::move(*refusal);
  end_if_stopped(stop);
  return assembled(project, std::get<0>(std::move(read)));
}

}  // namespace rvbench::bench
