#pragma once

#include <string>

#include "bench/judgement.hpp"

namespace rvbench::bench {

/// junit.xml of a judgement: one testcase per point (error if it cannot be trusted, skipped if it
/// was never recorded), one per limit and one per finding above its limit (failures), and one for
/// the run itself, which carries its ending.
std::string junit_xml(const Judgement& judgement);

}  // namespace rvbench::bench
