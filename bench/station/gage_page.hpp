#pragma once

#include <string>

#include "bench/station/gage_text.hpp"

namespace rvbench::bench {

/// The document gage.html: the word and what it rests on, components with intervals, each operator
/// against all of them part by part, the analysis of variance, and the method.
std::string make_gage_page(const GageAnswer& answer);

}  // namespace rvbench::bench
