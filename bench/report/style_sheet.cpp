#include "bench/report/sections.hpp"

namespace rvbench::bench::report {
namespace {

constexpr const char* page_style =
    R"(:root { --ink: #1c2530; --faint: #5b6876; --line: #d3dae1; --good: #1b7f3b; --bad: #b3261e;
  --warn: #9a6700; --trace: #1f5fa8; --mark: #b3261e;
  --before: #e08a2e; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: var(--ink); font: 15px/1.45 system-ui, "Segoe UI",
  "Liberation Sans", Arial, sans-serif; }
main { max-width: 1000px; margin: 0 auto; padding: 16px; }
h1 { font-size: 1.3rem; margin: 0 0 10px; }
h2 { font-size: 1.15rem; border-bottom: 2px solid var(--line); padding-bottom: 3px;
  margin: 28px 0 10px; }
h3 { font-size: 1rem; margin: 18px 0 6px; }
p { margin: 6px 0; max-width: 78ch; }
.verdict { border-left: 10px solid var(--warn); padding: 10px 16px; background: #f5f7f9; }
.verdict .word { font-size: 2.6rem; font-weight: 800; line-height: 1.1; color: var(--warn); }
.verdict.pass { border-color: var(--good); } .verdict.pass .word { color: var(--good); }
.verdict.fail { border-color: var(--bad); } .verdict.fail .word { color: var(--bad); }
.verdict .reason { font-size: 1.1rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 2px 16px; margin: 10px 0; }
dt { color: var(--faint); } dd { margin: 0; overflow-wrap: anywhere; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.88rem; margin: 6px 0; }
th, td { border: 1px solid var(--line); padding: 3px 8px; text-align: left; vertical-align: top; }
th { background: #eef2f5; font-weight: 600; }
.unbroken { white-space: nowrap; } .limits td:nth-child(2) { min-width: 9em; }
.hash { font-family: ui-monospace, "Liberation Mono", monospace; font-size: 0.8rem;
  overflow-wrap: anywhere; }
.map td, .map th { text-align: center; } .map td { padding: 4px; }
.map td:first-child { white-space: nowrap; }
.cell { display: inline-block; min-width: 44px; margin: 1px; padding: 3px 5px;
  border: 1px solid #0002; border-radius: 3px; font-variant-numeric: tabular-nums; }
.low { background: #cfead6; } .mid-level { background: #fff0b8; }
.high { background: #f3b3ad; font-weight: 700; }
.fell { background: #b9d6f2; font-weight: 700; }
.spoiled { background: repeating-linear-gradient(45deg, #ddd 0 4px, #f6f6f6 4px 8px); }
.absent { background: #fff; color: var(--faint); border-style: dashed; }
.finding { border: 1px solid var(--line); border-left: 6px solid var(--bad); padding: 6px 14px;
  margin: 10px 0; }
.finding.within { border-left-color: var(--line); }
.note { color: var(--faint); font-size: 0.88rem; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 440px), 1fr));
  gap: 8px; }
svg { display: block; width: 100%; height: auto; }
pre { background: #f5f7f9; border: 1px solid var(--line); padding: 8px; font-size: 0.76rem;
  overflow-x: auto; white-space: pre-wrap; overflow-wrap: anywhere; }
.left-out { margin: 10px 0 0; padding: 0 0 0 1.2em; font-size: 1.02rem; }
.left-out li { margin: 4px 0; }
.bars { display: grid; grid-template-columns: max-content 1fr max-content; gap: 6px 12px;
  align-items: center; margin: 8px 0; }
.bars b { font-variant-numeric: tabular-nums; } .track { background: #f0f3f6; height: 16px; }
.track i { display: block; height: 100%; }
.track .before, .legend .before { background: var(--before); }
.track .after, .legend .after { background: var(--trace); } .track .floor { background: #9fb0bf; }
.legend { font-size: 0.88rem; }
.legend i { display: inline-block; width: 22px; height: 4px; margin: 0 6px 3px 0; }
.legend span { margin-right: 14px; white-space: nowrap; display: inline-block; }
.legend .measured { background: var(--ink); }
.legend .band { background: #c9d2da; height: 12px; margin-bottom: -1px; }
.wide { margin: -14px 0 0; overflow-x: auto; overflow-y: hidden; } .wide svg { min-width: 620px; }
.scale { display: flex; align-items: center; font-size: 0.82rem; max-width: 520px;
  margin-top: 4px; }
.scale i { flex: 1; height: 12px; } .scale span { margin: 0 8px; white-space: nowrap; }
details summary { cursor: pointer; color: var(--trace); margin: 6px 0; }
.signature { display: grid; grid-template-columns: repeat(3, 1fr); gap: 24px; margin-top: 40px; }
.signature div { border-top: 1px solid var(--ink); padding-top: 4px; color: var(--faint); }
@media (max-width: 600px) { main { padding: 8px; } .bars { grid-template-columns: 1fr max-content; }
  .bars span:first-child, .bars b + span { grid-column: 1 / -1; }
  dl { grid-template-columns: 1fr; gap: 0; }
  dd { margin-bottom: 6px; } .signature { grid-template-columns: 1fr; gap: 36px; }
  .verdict .word { font-size: 2rem; } }
@media print { @page { size: A4; margin: 14mm; } body { font-size: 10pt; }
  main { max-width: none; padding: 0; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; } .scroll { overflow: visible; }
  figure, svg, tr, .finding, .verdict, .signature { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  .figures { grid-template-columns: 1fr 1fr; } }
)";

}  // namespace

std::string style_sheet() { return page_style + plot_style_sheet(); }

}  // namespace rvbench::bench::report
