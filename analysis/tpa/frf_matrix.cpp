#include "analysis/tpa/frf_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/frf/signed_axis.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Places = std::vector<DegreeOfFreedom>;

// Frequencies come from files as decimal numbers.
constexpr double same_Hz = 1e-6;

std::string pair_name(const DegreeOfFreedom& response, const DegreeOfFreedom& excitation) {
  return name_of(response) + " per " + name_of(excitation);
}

double sign_of(const DegreeOfFreedom& place) { return axis_of(place.direction).sign; }

// Its place in the list, the end if it is not there.
Index index_of(const Places& places, const DegreeOfFreedom& place) {
  return std::find(places.begin(), places.end(), place) - places.begin();
}

Index find_or_add(Places& places, const DegreeOfFreedom& place) {
  const Index at = index_of(places, place);
  if (at == Index(places.size())) places.push_back(place);
  return at;
}

class Assembly {
 public:
  Assembly(const std::vector<FrequencyResponse>& set, const Places& columns) : set_(set) {
    for (const DegreeOfFreedom& column : columns) {
      matrix_.excitations.push_back(positive(column));
    }
    may_add_columns_ = columns.empty();
  }

  AssembledFrfs assembled() {
    if (set_.empty()) return {std::nullopt, {"no frequency responses"}};
    find_places();
    check_alike();
    find_pairs();
    if (!faults_.empty()) return {std::nullopt, faults_};
    fill();
    return {matrix_, {}};
  }

 private:
  void fault(const FrequencyResponse& frf, const std::string& what) {
    const std::string from = frf.source.empty() ? "" : " (" + frf.source + ")";
    faults_.push_back(pair_name(frf.response, frf.excitation) + from + ": " + what);
  }

  void find_places() {
    for (const FrequencyResponse& frf : set_) {
      const DegreeOfFreedom excitation = positive(frf.excitation);
      const bool is_column = may_add_columns_ || index_of(matrix_.excitations, excitation) <
                                                     Index(matrix_.excitations.size());
      if (!is_column) fault(frf, "its excitation is none of the paths");
      find_or_add(matrix_.responses, positive(frf.response));
      if (is_column) find_or_add(matrix_.excitations, excitation);
      if (sign_of(frf.response) < 0) note_flip("response", frf.response);
      if (sign_of(frf.excitation) < 0) note_flip("excitation", frf.excitation);
    }
  }

  void note_flip(const std::string& what, const DegreeOfFreedom& place) {
    const std::string note = what + " " + name_of(place) + " is taken as " +
                             name_of(positive(place)) + ", with the other sign";
    const auto& known = matrix_.notes;
    if (std::find(known.begin(), known.end(), note) == known.end()) matrix_.notes.push_back(note);
  }

  void check_alike() {
    const FrequencyResponse& first = set_.front();
    if (first.values.size() == 0) fault(first, "no lines");
    if (!(first.step_Hz > 0) || !(first.first_Hz >= 0)) fault(first, "its lines have no step");
    for (const FrequencyResponse& frf : set_) {
      const double last_Hz = frf.frequency_Hz(frf.values.size() - 1);
      const double tolerance_Hz = same_Hz * std::abs(first.step_Hz);
      const bool same_lines =
          frf.values.size() == first.values.size() &&
          std::abs(frf.first_Hz - first.first_Hz) <= tolerance_Hz &&
          std::abs(last_Hz - first.frequency_Hz(first.values.size() - 1)) <= tolerance_Hz;
      if (!same_lines) {
        fault(frf, "other lines than " + pair_name(first.response, first.excitation));
      }
      check_unit(frf, frf.response_unit, first.response_unit);
      check_unit(frf, frf.excitation_unit, first.excitation_unit);
      check_values(frf);
    }
  }

  void check_unit(const FrequencyResponse& frf, const std::string& unit, const std::string& first) {
    if (unit != first) fault(frf, "unit \"" + unit + "\" where the first has \"" + first + "\"");
  }

  void check_values(const FrequencyResponse& frf) {
    for (Index line = 0; line < frf.values.size(); ++line) {
      if (std::isfinite(frf.values[line].real()) && std::isfinite(frf.values[line].imag()))
        continue;
      fault(frf, "not finite at line " + std::to_string(line));
      break;
    }
    const Eigen::VectorXd& coherence = frf.coherence;
    if (coherence.size() == 0) return;
    if (coherence.size() != frf.values.size()) {
      fault(frf, std::to_string(coherence.size()) + " lines of coherence");
    } else if (!(coherence.array() >= 0 && coherence.array() <= 1).all()) {
      fault(frf, "coherence outside 0 to 1");
    }
  }

  void find_pairs() {
    const Index rows = Index(matrix_.responses.size()), columns = Index(matrix_.excitations.size());
    pairs_.assign(std::size_t(rows * columns), nullptr);
    for (const FrequencyResponse& frf : set_) {
      const Index column = index_of(matrix_.excitations, positive(frf.excitation));
      if (column == columns) continue;
      const Index row = index_of(matrix_.responses, positive(frf.response));
      const FrequencyResponse*& pair = pairs_[std::size_t(column * rows + row)];
      if (pair != nullptr) fault(frf, "given twice");
      pair = &frf;
    }
    for (Index i = 0; i < rows * columns; ++i) {
      if (pairs_[std::size_t(i)] != nullptr) continue;
      faults_.push_back(pair_name(matrix_.responses[std::size_t(i % rows)],
                                  matrix_.excitations[std::size_t(i / rows)]) +
                        ": missing");
    }
  }

  void fill() {
    const FrequencyResponse& first = set_.front();
    matrix_.response_unit = first.response_unit;
    matrix_.excitation_unit = first.excitation_unit;
    matrix_.first_Hz = first.first_Hz;
    matrix_.step_Hz = first.step_Hz;
    const Index rows = Index(matrix_.responses.size()), columns = Index(matrix_.excitations.size());
    const Index lines = first.values.size();
    matrix_.values = LineMatrices(rows, columns, lines);
    const bool errors_are_known = std::all_of(set_.begin(), set_.end(), [](const auto& frf) {
      return frf.coherence.size() > 0 && frf.averages > 0;
    });
    if (errors_are_known) matrix_.variances.resize(rows * columns, lines);
    for (Index i = 0; i < rows * columns; ++i) {
      const FrequencyResponse& frf = *pairs_[std::size_t(i)];
      const double sign = sign_of(frf.response) * sign_of(frf.excitation);
      for (Index line = 0; line < lines; ++line) {
        matrix_.values.values[line * rows * columns + i] = sign * frf.values[line];
        if (errors_are_known) matrix_.variances(i, line) = variance(frf, line);
      }
    }
  }

  // Without coherence at a line nothing is known of it: all of it may be error, and more.
  static double variance(const FrequencyResponse& frf, Index line) {
    const double coherence = std::max(frf.coherence[line], 1e-12);
    return std::norm(frf.values[line]) * (1 - coherence) / (coherence * frf.averages);
  }

  const std::vector<FrequencyResponse>& set_;
  bool may_add_columns_ = true;
  FrfMatrix matrix_;
  std::vector<std::string> faults_;
  std::vector<const FrequencyResponse*> pairs_;  // column by column
};

}  // namespace

AssembledFrfs assemble_frf_matrix(const std::vector<FrequencyResponse>& set,
                                  const std::vector<DegreeOfFreedom>& columns) {
  return Assembly(set, columns).assembled();
}

}  // namespace rvbench::analysis
