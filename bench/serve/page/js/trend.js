// How an indicator went from unit to unit.
import { ask } from "./api.js";
import { chip } from "./chip.js";
import { by_id, make } from "./dom.js";
import { make_plot } from "./strip.js";
import { fill_table } from "./table.js";
import { told_by } from "./told.js";
import { say, say_number, say_time } from "./words.js";

const form = by_id("trend_filter");
let draw;

function lines_of(limit) {
  if (typeof limit === "number") return [limit];
  return limit ? [limit.min, limit.max].filter(Number.isFinite) : [];
}

async function offer_indicators() {
  const answer = await ask("limits").catch(() => ({}));
  const named = (answer.versions ?? []).flatMap((version) => (version.limits ?? []).map((limit) => limit.indicator));
  const names = [...new Set(named)].sort();
  by_id("indicators").replaceChildren(...names.map((name) => make("option", { value: name })));
  if (!form.indicator.value && names.length) form.indicator.value = names[0];
}

export async function show_trend() {
  if (!form.indicator.value) await offer_indicators();
  if (!form.indicator.value) return;
  await told_by(by_id("trend_told"), async () => {
    const answer = await ask("trend", Object.fromEntries(new FormData(form)));
    const values = answer.values ?? answer.points ?? [];
    draw ??= make_plot(by_id("trend_plot").querySelector("div"), { colour: "#005f9e", x: say("trend.runs"), dots: true });
    draw(values.map((_, i) => i + 1), values.map(({ value }) => value ?? null), lines_of(answer.limit));
    const rows = values.slice().reverse().map((at) =>
      [say_time(at.started_utc), at.serial ?? "", `${say_number(at.value)} ${answer.unit ?? ""}`, at.verdict ? chip(at.verdict) : ""]);
    fill_table(by_id("trend"), ["history.started", "history.serial", "trend.value", "history.verdict"], rows);
    return values.length ? (answer.told ?? answer.trend?.text ?? "") : say("trend.none");
  });
}

export function begin_trend() {
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    show_trend();
  });
}
