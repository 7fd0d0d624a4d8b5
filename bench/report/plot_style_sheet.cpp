#include "bench/report/sections.hpp"

namespace rvbench::bench::report {
namespace {

// Colours in full: whoever draws a plot outside of a browser knows no variables.
constexpr const char* style =
    R"(svg { font: 10.5px system-ui, "Liberation Sans", Arial, sans-serif; }
svg text { fill: #1c2530; } svg .mid { text-anchor: middle; } svg .end { text-anchor: end; }
svg .title { font-weight: 600; font-size: 11.5px; }
svg .marklabel { fill: #b3261e; font-size: 9.5px; }
svg .grid { stroke: #e6ebef; } svg .frame { fill: none; stroke: #8a97a3; }
svg .trace { fill: none; stroke: #1f5fa8; stroke-width: 1; stroke-linejoin: round; }
svg .measured { fill: none; stroke: #1c2530; stroke-width: 2.4; opacity: 0.6; }
svg .before { fill: none; stroke: #e08a2e; }
svg .after { fill: none; stroke: #1f5fa8; stroke-width: 1.1; }
svg .band { fill: #c9d2da; stroke: none; }
svg .bar { stroke: none; opacity: 1; } svg .bar.measured { fill: #1c2530; }
svg .bar.before { fill: #e08a2e; }
svg .bar.after { fill: #1f5fa8; } svg .whisker { stroke: #8a97a3; stroke-width: 2; }
svg .small { font-size: 9px; }
svg .own { stroke: #1c2530; stroke-width: 1.8; fill: none; } svg .ownlabel { font-size: 9.5px; }
svg .dot { fill: #1f5fa8; fill-opacity: 0.55; }
svg .dot.failed { fill: #ffffff; stroke: #b3261e; stroke-width: 1.3; }
svg .mark { stroke: #b3261e; stroke-width: 0.8; stroke-dasharray: 3 3; fill: none; }
)";

}  // namespace

std::string plot_style_sheet() { return style; }

}  // namespace rvbench::bench::report
