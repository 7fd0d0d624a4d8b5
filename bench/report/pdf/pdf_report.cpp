#include "bench/report/pdf/pdf_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/report/pdf/html_blocks.hpp"
#include "bench/report/pdf/pages.hpp"
#include "bench/report/pdf/typesetter.hpp"
#include "bench/report/pdf/verdict_page.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/verdict_text.hpp"
#include "bench/results/run_filter.hpp"

namespace rvbench::bench {
namespace {

using namespace report;

constexpr const char* no_fonts =
    "there is no font to set it in: install one (Debian: fonts-dejavu-core, and "
    "fonts-droid-fallback for Chinese and Japanese)";

// Without a time the file must not tell today's.
std::string iso_time(const std::string& utc) {
  const std::string iso = iso_utc(utc);
  return iso.empty() ? "1970-01-01T00:00:00Z" : iso;
}

// Of one line: what a serial or plan holds of line breaks would be outside of the frame.
std::string in_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20; }, ' ');
  return text;
}

pdf::PageFrame frame_of(const Judgement& judgement) {
  const RunFacts& facts = judgement.facts;
  const std::string unit = in_one_line(facts.serial.empty() ? judgement.machine : facts.serial);
  return {fmt::format("{}: {}", to_string(judgement.ending.outcome), unit), unit,
          in_one_line(fmt::format("rvbench {} · plan {} · {}", facts.software, facts.plan,
                                  readable_time(facts.started_utc))),
          iso_time(facts.started_utc), judgement.ending.outcome};
}

std::string appendix_of(const ReportInput& input) {
  return verdict_section(input) + findings_section(input) + limits_section(input) +
         indicators_section(input) + population_section(input) + hysteresis_section(input) +
         frequency_section(input) + signal_section(input) + sensors_section(input) +
         settings_section(input);
}

}  // namespace

std::variant<PdfReport, std::string> make_pdf_report(const ReportInput& input) {
  const pdf::Typesetter typesetter;
  if (!typesetter.has_fonts()) return no_fonts;
  const std::string bytes =
      pdf::make_pages(typesetter,
                      {pdf::verdict_page(typesetter, input),
                       pdf::html_blocks(typesetter, appendix_of(input), pdf::body_width_pt)},
                      frame_of(input.judgement));
  return PdfReport{bytes, typesetter.lacks_characters()};
}

}  // namespace rvbench::bench
