#include "bench/time_twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "bench/programme_cells.hpp"
#include "bench/standstill.hpp"
#include "sim/effect_edits.hpp"
#include "sim/interpolation.hpp"
#include "sim/mains.hpp"
#include "sim/plant_check.hpp"
#include "sim/simulate.hpp"

namespace rvbench::bench {
namespace {

constexpr double unit_length_s = 0.25;
constexpr double least_reversal = 0.02;  // of the fastest speed the other way: more than ringing

}  // namespace

TimeTwin::TimeTwin(sim::PlantSpec plant, TimeRecords records, const sim::TermLibrary& library)
    : Twin(std::move(plant), library), records_(std::move(records)) {}

TwinOrRefusal TimeTwin::make(sim::PlantSpec plant, const Campaign& campaign,
                             const sim::TermLibrary& library) {
  if (auto faults = sim::check_plant(plant, library); !faults.empty()) {
    return Refusal{std::move(faults), false};
  }
  auto read = time_records(plant, campaign, library);
  if (auto* refusal = std::get_if<Refusal>(&read)) return std::move(*refusal);
  std::unique_ptr<TimeTwin> twin(
      new TimeTwin(std::move(plant), std::get<TimeRecords>(std::move(read)), library));
  ParameterScales scales{twin->natural_scales(),
                         1 / twin->records_.first_learned().excitation.rate_Hz(),
                         std::ranges::max(twin->records_.spread)};
  scales.rhythms_Hz.assign(sim::mains_frequencies_Hz.begin(), sim::mains_frequencies_Hz.end());
  scales.fits_rhythms = true;
  twin->family_.emplace(twin->plant_, scales, library);
  twin->base_ = twin->family_->base();
  twin->leave_out_what_needs_reversal();
  twin->leave_out_what_is_too_fast();
  leave_out_standstill(twin->plant_, library, twin->records_);
  twin->cut_units();
  return std::unique_ptr<Twin>(std::move(twin));
}

sim::NaturalScales TimeTwin::natural_scales() const {
  const sim::BodySpec& body = plant_.bodies.front();
  const bool driven = std::ranges::any_of(plant_.inputs, [&](const sim::InputSpec& input) {
    return input.kind >= sim::InputKind::position && input.body == body.name;
  });
  const sim::PlantSpec probe =
      sim::with_probes(plant_, body.name,
                       {sim::OutputKind::position, sim::OutputKind::speed,
                        driven ? sim::OutputKind::drive : sim::OutputKind::acceleration});
  sim::NaturalScales scales;
  std::array<double, 3> squares{};
  double count = 0;
  for (const TimeRecord& record : records_.all) {
    if (!record.about.learned_from) continue;
    const auto run = sim::simulate(probe, record.excitation, terms_);
    const auto* shown = std::get_if<sim::Simulated>(&run);
    if (shown == nullptr) return scales;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      squares[i] += std::pow(deviation(shown->channels[i].samples), 2);
    }
    ++count;
  }
  const auto size = [&](std::size_t i) {
    return squares[i] > 0 ? std::sqrt(squares[i] / count) : 1;
  };
  scales = {driven ? size(2) : size(2) * body.inertia.value, size(0), size(1)};
  return scales;
}

// Whether what moves at a site goes both ways in what is learned from, by the plant as it is.
bool TimeTwin::reverses(const sim::EffectSite& site) const {
  const auto speeds_of = [&](const std::string& body, const TimeRecord& record) -> Eigen::VectorXd {
    const auto run = sim::simulate(sim::with_probes(plant_, body, {sim::OutputKind::speed}),
                                   record.excitation, terms_);
    const auto* shown = std::get_if<sim::Simulated>(&run);
    return shown == nullptr ? Eigen::VectorXd() : shown->channels.front().samples;
  };
  double slowest = 0, fastest = 0;
  for (const TimeRecord& record : records_.all) {
    if (!record.about.learned_from) continue;
    Eigen::VectorXd speed = speeds_of(site.body_a, record);
    if (site.body_b != sim::housing_name && speed.size() > 0)
      speed -= speeds_of(site.body_b, record);
    if (speed.size() == 0) continue;
    slowest = std::min(slowest, speed.minCoeff());
    fastest = std::max(fastest, speed.maxCoeff());
  }
  return std::min(-slowest, fastest) > least_reversal * std::max(-slowest, fastest);
}

void TimeTwin::leave_out_what_needs_reversal() {
  for (std::size_t i = 0; i < library().size(); ++i) {
    if (family_->gate_of(i).one_way_like.empty() || reverses(family_->site_of(i))) continue;
    family_->never_reverses(i);
  }
}

// At half the rate and above, a sinusoid is another one or a constant; above the band it is not
// compared.
void TimeTwin::leave_out_what_is_too_fast() {
  double limit_Hz = 0;
  for (const TimeRecord& record : records_.all) {
    if (record.about.learned_from) limit_Hz = std::max(limit_Hz, record.excitation.rate_Hz() / 2);
  }
  if (records_.band_Hz > 0) limit_Hz = std::min(limit_Hz, records_.band_Hz);
  for (std::size_t i = 0; i < library().size(); ++i) {
    const std::optional<double> frequency_Hz = family_->chosen_frequency_Hz(i);
    if (!frequency_Hz || *frequency_Hz < limit_Hz) continue;
    family_->cannot_show(i, fmt::format("recordings show nothing above {:g} Hz", limit_Hz));
  }
}

std::vector<std::string> TimeTwin::notes() const { return standstill_notes(records_); }

void TimeTwin::cut_units() {
  Eigen::Index at = 0;
  const auto outputs = static_cast<Eigen::Index>(plant_.outputs.size());
  for (const TimeRecord& record : records_.all) {
    if (!record.about.learned_from) continue;
    const double rate_Hz = record.excitation.rate_Hz();
    const auto size = static_cast<Eigen::Index>(record.kept.size());
    const double length_s = static_cast<double>(record.last - record.first) / rate_Hz;
    const auto count = static_cast<Eigen::Index>(
        std::clamp(length_s / unit_length_s, 1.0, double(units_per_record)));
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index own = (size * (i + 1) / count - size * i / count) * outputs;
      units_.push_back({record.about.name, record.about.condition, record.about.speed,
                        record.about.load, at, own, record.about.programme});
      at += own;
    }
  }
}

// Where the record is compared, below the band, each `step`-th sample.
Eigen::VectorXd TimeTwin::below_band(const TimeRecord& record, const Eigen::VectorXd& x,
                                     Eigen::Index step) const {
  Eigen::VectorXd out((record.last - record.first) / step);
  const double rate_Hz = record.excitation.rate_Hz();
  if (records_.band_Hz == 0 || 2 * records_.band_Hz >= rate_Hz) {
    for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = x[record.first + i * step];
    return out;
  }
  const sim::Interpolation filter(0, 0, records_.band_Hz / rate_Hz);
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = filter(x, record.first + i * step);
  return out;
}

Eigen::VectorXd TimeTwin::compared(const TimeRecord& record, const Eigen::VectorXd& x) const {
  return below_band(record, x, record.thin)(record.kept);
}

// @param show  of a record, one signal per output of the plant
// @return what it shows of the records that are learned from, in order of the units
std::optional<Eigen::VectorXd> TimeTwin::by_units(
    const std::function<std::optional<std::vector<Eigen::VectorXd>>(const TimeRecord&)>& show)
    const {
  const analysis::ObservedUnit& last = units_.back();
  Eigen::VectorXd out(last.first + last.size);
  auto unit = units_.begin();
  for (const TimeRecord& record : records_.all) {
    if (!record.about.learned_from) continue;
    auto shown = show(record);
    if (!shown) return std::nullopt;
    for (Eigen::VectorXd& signal : *shown) {
      signal = compared(record, signal);
    }
    Eigen::Index from = 0;
    while (unit != units_.end() && unit->record == record.about.name &&
           from < shown->front().size()) {
      const Eigen::Index each = unit->size / static_cast<Eigen::Index>(shown->size());
      for (std::size_t o = 0; o < shown->size(); ++o) {
        out.segment(unit->first + static_cast<Eigen::Index>(o) * each, each) =
            (*shown)[o].segment(from, each);
      }
      from += each;
      ++unit;
    }
  }
  return out;
}

// Per output of the plant; nothing if it cannot be simulated.
std::optional<std::vector<Eigen::VectorXd>> TimeTwin::apart(const sim::PlantSpec& plant,
                                                            const TimeRecord& record) const {
  const auto run = sim::simulate(plant, record.excitation, terms_);
  const auto* shown = std::get_if<sim::Simulated>(&run);
  if (shown == nullptr) return std::nullopt;
  std::vector<Eigen::VectorXd> apart;
  for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
    apart.emplace_back(record.measured[o] - shown->channels[o].samples);
  }
  return apart;
}

std::optional<Eigen::VectorXd> TimeTwin::residuals(const std::vector<std::size_t>& effects,
                                                   const std::vector<double>& values,
                                                   const std::vector<bool>&) const {
  stop_if_asked();
  const sim::PlantSpec plant = plant_with(effects, values);
  return by_units([&](const TimeRecord& record) {
    auto off = apart(plant, record);
    for (std::size_t o = 0; off && o < off->size(); ++o) (*off)[o] /= records_.spread[o];
    return off;
  });
}

double TimeTwin::nothing_predicted() const {
  const Eigen::VectorXd all = *by_units([&](const TimeRecord& record) {
    std::vector<Eigen::VectorXd> shown = record.measured;
    for (std::size_t o = 0; o < shown.size(); ++o) shown[o] /= records_.spread[o];
    return std::optional(std::move(shown));
  });
  return std::sqrt(all.squaredNorm() / static_cast<double>(all.size()));
}

Eigen::MatrixXd TimeTwin::states() const {
  const sim::OutputSpec& seen = plant_.outputs.front();
  const sim::TermSpec* term = plant_.find_term(seen.of);
  const std::string body = term != nullptr ? term->body_a : seen.of;
  const sim::PlantSpec probe =
      sim::with_probes(plant_, body, {sim::OutputKind::position, sim::OutputKind::speed});
  std::vector<Channel> shown;  // position and speed of each record in turn
  for (const TimeRecord& record : records_.all) {
    if (!record.about.learned_from) continue;
    auto run = sim::simulate(probe, record.excitation, terms_);
    auto* simulated = std::get_if<sim::Simulated>(&run);
    if (simulated == nullptr) return {};
    std::ranges::move(simulated->channels, std::back_inserter(shown));
  }
  const std::size_t columns = probe.outputs.size();
  Eigen::MatrixXd states(units_.back().first + units_.back().size, Eigen::Index(columns));
  for (std::size_t column = 0; column < columns; ++column) {
    std::size_t at = column;
    states.col(Eigen::Index(column)) = *by_units([&](const TimeRecord&) {
      const Eigen::VectorXd& state = shown[at].samples;
      at += columns;
      return std::optional(std::vector<Eigen::VectorXd>(plant_.outputs.size(), state));
    });
  }
  return states;
}

std::vector<Twin::Comparison> TimeTwin::compare(const std::vector<std::size_t>& effects,
                                                const std::vector<double>& values) const {
  const sim::PlantSpec plant = plant_with(effects, values);
  std::vector<Comparison> all;
  for (const TimeRecord& record : records_.all) {
    const auto run = sim::simulate(plant, record.excitation, terms_);
    const auto* shown = std::get_if<sim::Simulated>(&run);
    if (shown == nullptr) return {};
    const double rate_Hz = record.excitation.rate_Hz();
    for (std::size_t o = 0; o < plant_.outputs.size(); ++o) {
      all.push_back({record.about.name, plant_.outputs[o].channel, plant_.outputs[o].unit,
                     record.about.learned_from, records_.spread[o], "time [s]",
                     record.excitation.start_s() + static_cast<double>(record.first) / rate_Hz,
                     1 / rate_Hz, below_band(record, record.measured[o], 1),
                     below_band(record, shown->channels[o].samples, 1)});
    }
  }
  return all;
}

Twin::Cells TimeTwin::cells(const std::vector<std::size_t>& effects,
                            const std::vector<double>& values) const {
  const sim::PlantSpec plant = plant_with(effects, values);
  std::vector<ProgrammeRecord> repeats;
  for (const TimeRecord& record : records_.all) {
    if (!record.about.learned_from || record.about.programme.empty()) continue;
    const auto off = apart(plant, record);
    if (!off) return {};
    const double rate_Hz = record.excitation.rate_Hz();
    ProgrammeRecord repeat{record.about.programme,
                           static_cast<double>(record.first - record.lead_in) / rate_Hz,
                           static_cast<double>(record.last - record.first) / rate_Hz,
                           {}};
    for (const Eigen::VectorXd& signal : *off) {
      const Eigen::VectorXd all = below_band(record, signal, record.thin);
      Eigen::VectorXd kept = Eigen::VectorXd::Zero(all.size());
      kept(record.kept) = all(record.kept);
      repeat.apart.push_back(std::move(kept));
    }
    repeats.push_back(std::move(repeat));
  }
  return programme_cells(plant_.outputs, repeats);
}

}  // namespace rvbench::bench
