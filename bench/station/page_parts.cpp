#include "bench/station/page_parts.hpp"

#include <cmath>
#include <utility>

#include "bench/report/sections.hpp"
#include "bench/software_version.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench {

std::string station_document(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         xml_escaped(title) + "</title>\n<style>\n" + report::style_sheet() +
         "</style></head><body><main>\n" + body + "<p class=\"note\">rvbench " +
         xml_escaped(software_version()) + "</p>\n</main></body></html>\n";
}

std::string word_block(const std::string& heading, const std::string& word,
                       const std::string& style, const std::string& sentence,
                       const std::string& reservation) {
  return "<h1>" + xml_escaped(heading) + "</h1>\n<div class=\"verdict " + style +
         "\"><div class=\"word\">" + xml_escaped(word) + "</div><div class=\"reason\">" +
         xml_escaped(sentence) + "</div><p>" + xml_escaped(reservation) + "</p></div>\n";
}

PlotAxis axis_between(std::string label, double least, double greatest) {
  const double width = greatest - least;
  const double air = width > 0 ? 0.06 * width : 0.5 * std::fmax(1, std::abs(least));
  return {std::move(label), least - air, greatest + air};
}

std::string figures(const std::vector<SvgPlot>& plots) {
  std::string html = "<div class=\"figures\">\n";
  for (const SvgPlot& plot : plots) {
    html += "<figure style=\"margin:0\">" + plot.svg() + "</figure>\n";
  }
  return html + "</div>\n";
}

std::string value_label(const std::string& unit) {
  return unit.empty() ? "value [unit not stated]" : "value [" + unit + "]";
}

}  // namespace rvbench::bench
