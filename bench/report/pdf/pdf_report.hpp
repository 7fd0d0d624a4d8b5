#pragma once

#include <string>
#include <variant>

#include "bench/report/report.hpp"

namespace rvbench::bench {

/// A report on paper.
struct PdfReport {
  std::string bytes;
  bool lacks_characters = false;  ///< some of its text is in no font of this machine
};

/// report.pdf: a page for the verdict, then an appendix with what the HTML report says of findings,
/// limits, indicators, signals, sensors and settings. A4, each page with serial, verdict and
/// number; of the same run and the same earlier units the same bytes.
///
/// Errors  the answer says why nothing can be set: there are no fonts
std::variant<PdfReport, std::string> make_pdf_report(const ReportInput& input);

}  // namespace rvbench::bench
