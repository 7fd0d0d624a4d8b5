// How an indicator went from unit to unit.
import { ask } from "./api.js";
import { chip } from "./chip.js";
import { by_id, make, tell } from "./dom.js";
import { part_of, standing_of } from "./limit_versions.js";
import { make_plot } from "./strip.js";
import { fill_table } from "./table.js";
import { newest_of, told_by } from "./told.js";
import { say, say_number, say_time } from "./words.js";

const form = by_id("trend_filter");
let draw;

// Of the limits in force on an indicator, those in the unit of its values, and that hold at all points
// or at the very ones that are asked for.
function lines_of(limits, { indicator, unit, speed_rpm, load_pct }) {
  const holds = (limit) => (limit.speed_rpm ?? speed_rpm) === speed_rpm && (limit.load_pct ?? load_pct) === load_pct;
  const meant = limits.filter((limit) => limit.measure === indicator && limit.unit === unit && !part_of(limit) && holds(limit));
  return meant.map((limit) => limit.max ?? limit.min).filter(Number.isFinite);
}

async function limits_in_force() {
  const versions = (await ask("limits").catch(() => ({}))).versions ?? [];
  const names = [...new Set(versions.flatMap(({ limits = [] }) => limits.map(({ measure }) => measure)))].sort();
  by_id("indicators").replaceChildren(...names.map((name) => make("option", { value: name })));
  const in_force = versions.filter((version) => standing_of(version) === "activated");
  return in_force.flatMap(({ limits = [] }) => limits);
}

const say_in = (unit, value) => `${say_number(value)} ${unit === "1" ? "" : unit ?? ""}`;

function show_values(answer, limits) {
  const values = answer.values ?? [];
  draw ??= make_plot(by_id("trend_plot").querySelector("div"), { colour: "#005f9e", x: say("trend.runs"), dots: true });
  draw(values.map((_, i) => i + 1), values.map(({ value }) => value ?? null), lines_of(limits, answer));
  const rows = values.slice().reverse().map((at) =>
    [say_time(at.started_utc), at.serial ?? "", at.point ?? "", say_in(answer.unit, at.value), at.verdict ? chip(at.verdict) : ""]);
  fill_table(by_id("trend"), ["history.started", "history.serial", "trend.point", "trend.value", "history.verdict"], rows);
}

function sentence_of({ values = [], trend }) {
  if (!values.length) return say("trend.none");
  if (!trend?.told) return say("trend.untold");
  return trend.slope_per_day > 0 ? say("trend.rises") : say("trend.falls");
}

export async function show_trend() {
  if (!form.indicator.value) {
    newest_of(by_id("trend_told"));  // no earlier answer is meant any more
    return tell(by_id("trend_told"), "");
  }
  const query = Object.fromEntries(new FormData(form));
  await told_by(by_id("trend_told"), async (is_newest) => {
    let limits = [], answer = {};
    try {
      [limits, answer] = await Promise.all([limits_in_force(), ask("trend", query)]);
    } finally {
      if (is_newest()) show_values(answer, limits);  // none after a refusal: others were asked for
    }
    return [sentence_of(answer), answer.values?.length ? answer.sentence : ""];
  });
}

export function begin_trend() {
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    show_values({}, []);
    show_trend();
  });
}
