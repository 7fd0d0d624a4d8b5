#pragma once

#include <string>

#include "bench/tpa_study.hpp"

namespace rvbench::bench {

/// The document tpa.html, one file without links to others: who leads in sentences, made from the
/// answers; per motion contributions, validation and forces; the reducer's findings; before and
/// after a repair; data and method.
std::string make_tpa_page(const TpaStudy& study);

}  // namespace rvbench::bench
