#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace rvbench {

/// A place of a structure and a direction there: where a hammer hits, or a sensor points.
struct DegreeOfFreedom {
  std::string point;      ///< name or number of the node: "J3 active", "12"
  std::string direction;  ///< "+X", "-Z", about an axis "+RX"; empty if it is not known
  bool operator==(const DegreeOfFreedom&) const = default;
};

/// What a linear structure answers at one place per unit of excitation at another, over frequency.
/// Phase: positive where the response leads; a response in phase has a positive real part.
struct FrequencyResponse {
  std::string source;  ///< file and place in it, or how it was estimated
  DegreeOfFreedom response;
  DegreeOfFreedom excitation;
  std::string response_unit;    ///< SI symbol: "m/s²", "m/s", "m"; empty if not known
  std::string excitation_unit;  ///< "N", "N·m"; empty if not known
  double first_Hz = 0;          ///< frequency of values[0], >= 0
  double step_Hz = 0;           ///< > 0
  Eigen::VectorXcd values;      ///< N lines, in response_unit per excitation_unit
  Eigen::VectorXd coherence;    ///< N lines of 0 to 1; empty if it is not known
  int averages = 0;             ///< records it was averaged over; 0 if not known
  std::vector<std::string> notes;

  double frequency_Hz(Eigen::Index line) const {
    return first_Hz + static_cast<double>(line) * step_Hz;
  }
};

}  // namespace rvbench
