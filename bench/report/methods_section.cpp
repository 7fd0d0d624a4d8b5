#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "analysis/envelope/method_comparison.hpp"
#include "analysis/order/over_angle.hpp"
#include "analysis/shaft_angle.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"

namespace rvbench::bench::report {
namespace {

using analysis::EnvelopeMethod;

// An order at which parts would show, and what each method came to over all records.
struct Row {
  analysis::CandidateLine candidate;
  std::set<std::string> parts;
  std::vector<int> found = std::vector<int>(std::size(analysis::envelope_methods));
  std::vector<double> least_p = std::vector<double>(std::size(analysis::envelope_methods), 1.0);

  bool is_found() const {
    return std::ranges::any_of(found, [](int records) { return records > 0; });
  }
};

std::vector<Row> rows_of(const analysis::Kinematics& kinematics) {
  std::vector<Row> rows;
  for (const analysis::Signature& signature : kinematics.signatures) {
    const double order = signature.first_harmonic * signature.order;
    auto row = std::ranges::find_if(
        rows, [order](const Row& one) { return std::abs(one.candidate.frequency - order) < 1e-9; });
    if (row == rows.end()) row = rows.insert(row, Row{.candidate = {order, 0}, .parts = {}});
    row->candidate.within =
        std::max(row->candidate.within, order * std::max(signature.slip, signature.tolerance));
    row->parts.insert(signature.component);
  }
  std::ranges::sort(rows, {}, [](const Row& row) { return row.candidate.frequency; });
  return rows;
}

// A channel at even steps of the shaft's angle, as fine as it was sampled.
analysis::OverAngle over_angle_of(const Channel& channel, const Recording& record,
                                  double period_turns) {
  const auto angle = analysis::ShaftAngle::of(record);
  if (!angle || channel.samples.size() < 256 || !channel.samples.allFinite()) return {};
  const int per_turn = static_cast<int>(std::ceil(channel.rate_Hz / angle->mean_speed_Hz()));
  return analysis::over_angle(channel.samples, channel.rate_Hz, channel.start_s, *angle,
                              {.samples_per_turn = per_turn, .period_turns = period_turns});
}

// @return whether the record could be asked
bool add_record(const Channel& channel, const Recording& record, double period_turns,
                std::vector<Row>& rows) {
  const analysis::OverAngle even = over_angle_of(channel, record, period_turns);
  if (even.samples.size() < 256) return false;
  std::vector<analysis::CandidateLine> candidates;
  for (const Row& row : rows) {
    if (row.candidate.frequency >= even.samples_per_turn / 4.0) return false;
    candidates.push_back(row.candidate);
  }
  const analysis::MethodComparison compared =
      analysis::compare_methods(even.samples, even.samples_per_turn, candidates,
                                {.false_alarm_rate = analysis::significant_p});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t m = 0; m < std::size(analysis::envelope_methods); ++m) {
      rows[i].found[m] += compared.found(i, analysis::envelope_methods[m]) ? 1 : 0;
      rows[i].least_p[m] = std::min(rows[i].least_p[m], compared.evidence[i][m].line.p_value);
    }
  }
  return true;
}

std::string parts_of(const Row& row) {
  std::string text;
  for (const std::string& part : row.parts) text += (text.empty() ? "" : ", ") + spoken(part);
  return text;
}

std::string share_text(const std::vector<Row>& rows) {
  constexpr const auto& methods = analysis::envelope_methods;
  constexpr auto emd =
      std::size_t(std::ranges::find(methods, EnvelopeMethod::emd) - std::begin(methods));
  const auto any = std::ranges::count_if(rows, &Row::is_found);
  const auto by_emd = std::ranges::count_if(rows, [](const Row& row) { return row.found[emd]; });
  return fmt::format("Of {} orders that any way found, EMD found {}.", any, by_emd);
}

std::string found_table(const std::vector<Row>& rows, int records, double period_turns) {
  std::vector<std::string> head = {"order", "part"};
  for (const EnvelopeMethod method : analysis::envelope_methods) {
    head.emplace_back(analysis::name_of(method));
  }
  std::vector<std::vector<std::string>> cells;
  for (const Row& row : rows) {
    if (!row.is_found()) continue;
    std::vector<std::string>& line = cells.emplace_back();
    line = {order_text(row.candidate.frequency, period_turns), parts_of(row)};
    for (std::size_t m = 0; m < row.found.size(); ++m) {
      const bool found = row.found[m] > 0;
      line.push_back(found ? fmt::format("{} of {} (p {})", row.found[m], records,
                                         p_value_text(row.least_p[m]))
                           : "–");
    }
  }
  return table(head, cells);
}

}  // namespace

std::string methods_section(const ReportInput& input) {
  std::vector<Row> rows = rows_of(input.kinematics);
  if (!input.load || rows.empty()) return "";
  int records = 0;
  for (const std::size_t index : representative_points(input.judgement)) {
    const JudgedPoint& point = input.judgement.points[index];
    const std::optional<Recording> record = input.load(index);
    if (!record || point.examination.channels.empty()) continue;
    const Channel* channel =
        record->find(point.examination.channels[shown_channel(point.examination)].name);
    if (channel == nullptr) continue;
    records += add_record(*channel, *record, input.kinematics.period_turns, rows) ? 1 : 0;
  }
  if (records == 0) return "";
  const std::string intro = paragraph(fmt::format(
      "How often something is struck, asked in four ways at the first order that each part would "
      "show, on one channel of each of {} representative points: in how many of them the order "
      "stands out of the noise, each way at a false-alarm rate of {:g}. This says what is there; "
      "whether it is too much, limits say.",
      records, analysis::significant_p));
  const std::string shown = shown_points(input.judgement, "The others were not asked.");
  const bool any = std::ranges::any_of(rows, &Row::is_found);
  return section("Four ways to ask the envelope",
                 intro + shown +
                     (any ? found_table(rows, records, input.kinematics.period_turns) +
                                paragraph(share_text(rows))
                          : paragraph("None of them found any of the orders.")));
}

}  // namespace rvbench::bench::report
