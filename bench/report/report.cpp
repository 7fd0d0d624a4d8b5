#include "bench/report/report.hpp"

#include <fmt/format.h>

#include "bench/report/sections.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {

std::string make_report(const ReportInput& input) {
  const Judgement& judgement = input.judgement;
  const std::string title =
      fmt::format("{}: {}", to_string(judgement.ending.outcome),
                  judgement.facts.serial.empty() ? judgement.machine : judgement.facts.serial);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      xml_escaped(title) + "</title>\n<style>\n" + report::style_sheet() +
      "</style></head><body><main>\n";
  html += report::verdict_section(input);
  html += report::findings_section(input);
  html += report::deciding_section(input);
  html += report::article_section(input);
  html += report::matrix_section(input);
  html += report::limits_section(input);
  html += report::indicators_section(input);
  html += report::population_section(input);
  html += report::hysteresis_section(input);
  html += report::frequency_section(input);
  html += report::methods_section(input);
  html += report::correlation_section(input);
  html += report::signal_section(input);
  html += report::sensors_section(input);
  html += report::settings_section(input);
  html += report::signature_section(input);
  return html + "</main></body></html>\n";
}

}  // namespace rvbench::bench
