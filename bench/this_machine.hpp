#pragma once

#include <string>

#include "analysis/kinematics.hpp"
#include "bench/judgement.hpp"

namespace rvbench::bench {

/// What alone confirms the speed and the rate of records that are of this machine; empty if its
/// gear train, or a measured angle, does. Errors  none thrown. Source  has_own_lines()
std::string what_confirms_it(const Judgement& judgement, const analysis::Kinematics& kinematics);

/// Why the records may be of another machine, another speed or another rate, with the speed at
/// which their lines would fit if one stands out; empty if they are of this one. Errors  none
/// thrown. Source  shows_shaft(), gear_train_fit()
std::string why_not_this_machine(const Judgement& judgement,
                                 const analysis::Kinematics& kinematics);

}  // namespace rvbench::bench
