// Versions of limits: proposed, approved by a named engineer, active. What a version would have
// changed is shown before anybody can approve it.
import { act, ask } from "./api.js";
import { chip } from "./chip.js";
import { by_id, make, tell } from "./dom.js";
import { fill_table, row_button } from "./table.js";
import { told_by } from "./told.js";
import { say, say_number, say_or, say_time } from "./words.js";

const dialog = by_id("version");
const step_of = { draft: "approve", approved: "activate" };
let shown = null;
let page = null;

function effect_of(version) {
  const effect = version.effect;
  if (!effect) return say("limits.no_effect");
  return say("limits.changes", { judged: effect.judged ?? 0, fail: effect.would_fail ?? 0, pass: effect.would_pass ?? 0 });
}

function bounds(limit) {
  const low = Number.isFinite(limit.min) ? `≥ ${say_number(limit.min)} ` : "";
  const high = Number.isFinite(limit.max) ? `≤ ${say_number(limit.max)} ` : "";
  return `${low}${high}${limit.unit ?? ""}`;
}

function open_version(version) {
  shown = version;
  const step = step_of[version.status];
  tell(by_id("version_title"), say("limits.title", { version: version.version }));
  tell(by_id("version_effect"), effect_of(version));
  tell(by_id("version_told"), "");
  fill_table(by_id("version_changes"), ["limits.run", "limits.was", "limits.would_be"],
    (version.effect?.changes ?? []).map((change) => [change.run, chip(change.was), chip(change.would_be)]));
  fill_table(by_id("version_limits"), ["trend.indicator", "trend.point", "limits.limit", "limits.units"],
    (version.limits ?? []).map((limit) => [limit.indicator, limit.point ?? "", bounds(limit), String(limit.n ?? "")]));
  by_id("version_go").hidden = !step || page.session?.role !== "engineer";
  if (step) by_id("version_go").textContent = say(`limits.${step}_by`, { name: page.session?.name ?? "" });
  dialog.showModal();
  by_id("version_title").tabIndex = -1;
  by_id("version_title").focus();
}

function row_of(version) {
  const word = `limits.${step_of[version.status] ?? "show"}`;
  return [String(version.version), say_or(`limits.${version.status}`, version.status),
    say_time(version.proposed_utc), version.approved_by ?? "", effect_of(version),
    [row_button(word, version.version, () => open_version(version))]];
}

export async function show_limits() {
  by_id("propose").disabled = page.session?.role !== "engineer";
  await told_by(by_id("limits_told"), async () => {
    const versions = ((await ask("limits")).versions ?? []).slice().reverse();
    fill_table(by_id("limits"),
      ["limits.version", "limits.status", "limits.proposed", "limits.approved_by", "limits.effect", ""], versions.map(row_of));
    return versions.length ? "" : say("limits.none");
  });
}

export function begin_limits(of_page) {
  page = of_page;
  by_id("propose").addEventListener("click", async () => {
    let has_proposed = false;
    await told_by(by_id("limits_told"), async () => {
      await act("limits/propose");
      has_proposed = true;
    });
    if (has_proposed) await show_limits();
  });
  by_id("version_go").addEventListener("click", () => told_by(by_id("version_told"), async () => {
    await act(`limits/${step_of[shown.status]}`, { version: shown.version });
    dialog.close("done");
    await show_limits();
  }));
}
