#pragma once

#include <cstddef>
#include <string>

#include "bench/report/pdf/block.hpp"
#include "bench/report/pdf/typesetter.hpp"
#include "bench/report/report.hpp"

/// The pieces of the first page, each of a height that is bounded whatever the judgement says: what
/// is too long ends in "…", and the appendix has it in full.
namespace rvbench::bench::pdf {

inline const TextStyle small_text{.size_pt = 7.5};

Blocks part_heading(const Typesetter& typesetter, const std::string& text);

Blocks banner(const Typesetter& typesetter, const Judgement& judgement);
Blocks facts_table(const Typesetter& typesetter, const Judgement& judgement);

/// The first `most` findings, what to do about them, and how many there are besides.
Blocks findings_in_words(const Typesetter& typesetter, const Judgement& judgement,
                         std::size_t most);

/// The `most` limits of the plan that are nearest to what was measured, or farthest exceeded.
Blocks limits_in_short(const Typesetter& typesetter, const Judgement& judgement, std::size_t most);

/// What this report is of: hashes of the verdict, the recordings and the list of all files.
Blocks hashes_to_sign(const Typesetter& typesetter, const ReportInput& input);

Block signature_lines(const Typesetter& typesetter);

}  // namespace rvbench::bench::pdf
