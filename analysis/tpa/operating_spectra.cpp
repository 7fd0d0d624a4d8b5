#include "analysis/tpa/operating_spectra.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/fft.hpp"
#include "analysis/frf/signed_axis.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

constexpr double same_line = 0.05;  // of a step: Hann lines lose 0.02 dB there
constexpr Index fewest_blocks = 2;

struct Found {
  const Channel* channel = nullptr;
  double sign = 1;
};

class Reading {
 public:
  Reading(const Recording& recording, const LineGrid& grid, double overlap)
      : recording_(recording), grid_(grid), overlap_(overlap) {}

  TakenSpectra spectra_of(const std::vector<DegreeOfFreedom>& places) {
    for (const DegreeOfFreedom& place : places) find(positive(place));
    if (found_.size() == places.size()) check_alike();
    if (faults_.empty()) check_blocks();
    if (!faults_.empty()) return {std::nullopt, faults_};
    return {transformed(), {}};
  }

 private:
  void fault(const DegreeOfFreedom& place, const std::string& what) {
    faults_.push_back(name_of(place) + ": " + what);
  }

  void find(const DegreeOfFreedom& place) {
    std::vector<Found> found;
    for (const Channel& channel : recording_.channels) {
      const double sense = same_axis({channel.info.name, channel.info.direction}, place);
      if (sense != 0) found.push_back({&channel, sense});
    }
    if (found.empty()) return fault(place, "no channel");
    if (found.size() > 1) return fault(place, std::to_string(found.size()) + " channels");
    places_.push_back(place);
    found_.push_back(found.front());
  }

  void check_alike() {
    const Channel& first = *found_.front().channel;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const Channel& channel = *found_[i].channel;
      if (channel.rate_Hz != first.rate_Hz) {
        fault(places_[i],
              number(channel.rate_Hz) + " samples a second, not " + number(first.rate_Hz));
      } else if (channel.samples.size() != first.samples.size()) {
        fault(places_[i], std::to_string(channel.samples.size()) + " samples, not " +
                              std::to_string(first.samples.size()));
      }
      if (std::abs(channel.start_s - first.start_s) * first.rate_Hz > same_line) {
        fault(places_[i], "begins " + number(channel.start_s - first.start_s) + " s later");
      }
      if (channel.info.unit != first.info.unit) {
        fault(places_[i],
              "unit \"" + channel.info.unit + "\" where the first has \"" + first.info.unit + "\"");
      }
      if (!channel.samples.allFinite()) {
        fault(places_[i], "a sample that is not finite");
      } else if (channel.samples.size() > 0 &&
                 (channel.samples.array() == channel.samples[0]).all()) {
        fault(places_[i], "shows " + number(channel.samples[0] + 0.0) + " throughout: it is dead");
      }
    }
  }

  void check_blocks() {
    const Channel& first = *found_.front().channel;
    if (!(first.rate_Hz > 0)) return fault(places_.front(), "no sample rate");
    block_ = Index(std::lround(first.rate_Hz / grid_.step_Hz));
    const double step_Hz = block_ > 0 ? first.rate_Hz / double(block_) : 0;
    first_line_ = Index(std::lround(grid_.first_Hz / grid_.step_Hz));
    const Index last = first_line_ + grid_.lines - 1;
    if (2 * last >= block_) {
      return record_fault("lines up to " + number(grid_.frequency_Hz(grid_.lines - 1)) +
                          " Hz, of " + number(first.rate_Hz) + " samples a second");
    }
    const double worst_Hz =
        std::max(std::abs(double(first_line_) * step_Hz - grid_.first_Hz),
                 std::abs(double(last) * step_Hz - grid_.frequency_Hz(grid_.lines - 1)));
    if (worst_Hz > same_line * grid_.step_Hz) {
      return record_fault("blocks of whole samples at " + number(first.rate_Hz) +
                          " samples a second have no lines " + number(grid_.step_Hz) +
                          " Hz apart from " + number(grid_.first_Hz) + " Hz on");
    }
    hop_ = std::max<Index>(1, Index(std::lround(double(block_) * (1 - overlap_))));
    const Index beyond = first.samples.size() - block_;
    blocks_ = beyond < 0 ? 0 : beyond / hop_ + 1;
    if (blocks_ < fewest_blocks) {
      record_fault(number(double(first.samples.size()) / first.rate_Hz) +
                   " s are too short for two blocks of " + number(1 / grid_.step_Hz) + " s");
    }
  }

  void record_fault(const std::string& what) {
    faults_.push_back((recording_.source.empty() ? "record" : recording_.source) + ": " + what);
  }

  OperatingSpectra transformed() const {
    OperatingSpectra spectra{places_, found_.front().channel->info.unit, grid_,
                             LineMatrices::unset(Index(places_.size()), blocks_, grid_.lines)};
    const Eigen::VectorXd window =
        0.5 - 0.5 * (Eigen::ArrayXd::LinSpaced(block_, 0, double(block_ - 1)) *
                     (units::two_pi / double(block_)))
                        .cos();
    const double scale = 2 / window.sum();
    const auto one = [&](std::size_t i) {
      for (Index block = 0; block < blocks_; ++block) {
        const Eigen::VectorXcd lines =
            fft(found_[i].channel->samples.segment(block * hop_, block_).cwiseProduct(window));
        for (Index line = 0; line < grid_.lines; ++line) {
          spectra.values[line](Index(i), block) =
              found_[i].sign * scale * lines[first_line_ + line];
        }
      }
    };
    parallel_for(found_.size(), one);
    return spectra;
  }

  static std::string number(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }

  const Recording& recording_;
  LineGrid grid_;
  double overlap_;
  std::vector<DegreeOfFreedom> places_;
  std::vector<Found> found_;
  std::vector<std::string> faults_;
  Index block_ = 0, hop_ = 0, blocks_ = 0, first_line_ = 0;
};

}  // namespace

TakenSpectra operating_spectra(const Recording& recording,
                               const std::vector<DegreeOfFreedom>& places, const LineGrid& grid,
                               double overlap) {
  constexpr Require require{"operating_spectra"};
  require(!places.empty(), "no place");
  require(grid.lines > 0 && grid.step_Hz > 0 && grid.first_Hz >= 0, "no lines");
  require(overlap >= 0 && overlap < 1, "overlap must be in [0, 1)");
  return Reading(recording, grid, overlap).spectra_of(places);
}

OperatingSpectra blocks_of(const OperatingSpectra& spectra, const std::vector<Index>& blocks) {
  return {spectra.places, spectra.unit, spectra.grid, columns_of(spectra.values, blocks)};
}

}  // namespace rvbench::analysis
