// Versions of limits: proposed, approved by a named engineer, active. What a version would have
// changed is shown before anybody can approve it.
import { act, ask, long_patience_ms } from "./api.js";
import { chip } from "./chip.js";
import { by_id, make, tell } from "./dom.js";
import { last_step, part_of, standing_of } from "./limit_versions.js";
import { fill_table, row_button } from "./table.js";
import { told_by, with_detail } from "./told.js";
import { say, say_number, say_or, say_time } from "./words.js";

const dialog = by_id("version");
const step_of = { draft: "approve", approved: "activate" };
let shown = null;
const at_work = new Set();  // names of versions that a step is being taken of
let page = null;

const name_of = (version) => String(version.limits_version);

function effect_of({ effect }) {
  if (!effect) return "";
  const to = (verdict) => effect.changes.filter((change) => change.would_be === verdict).length;
  return say("limits.changes", { judged: effect.runs, fail: to("FAIL"), pass: to("PASS") });
}

function bound(limit) {
  const unit = limit.unit === "1" ? "" : limit.unit;
  return Number.isFinite(limit.min) ? `≥ ${say_number(limit.min)} ${unit}` : `≤ ${say_number(limit.max)} ${unit}`;
}

// What a limit is narrowed to: a part, or some points of the matrix, or both.
function narrowed_to(limit) {
  const speed = Number.isFinite(limit.speed_rpm) ? `${say_number(limit.speed_rpm, 6)} rpm` : "";
  const load = Number.isFinite(limit.load_pct) ? `${say_number(limit.load_pct)} %` : "";
  return [part_of(limit), speed, load].filter(Boolean).join(", ");
}

function show_effect() {
  const changes = shown.effect?.changes ?? [];
  tell(by_id("version_effect"), effect_of(shown));
  fill_table(by_id("version_changes"), ["limits.run", "limits.was", "limits.would_be", "history.reason"],
    changes.map((change) => [change.folder, chip(change.was), chip(change.would_be), with_detail("", change.reason)]));
  by_id("version_changes").hidden = !changes.length;
  show_go();
}

// What a version would change is seen before it counts.
function show_go() {
  by_id("version_go").disabled = !shown.effect || at_work.has(name_of(shown));
}

async function effect_in(asked) {
  const { effect } = await asked;
  return Array.isArray(effect?.changes) ? effect : undefined;
}

// A list may leave the effect out: working it out takes time.
async function ask_effect() {
  const version = shown;
  await told_by(by_id("version_told"), async () => {
    version.effect ??= await effect_in(ask("limits", { version: name_of(version) }, long_patience_ms));
    if (at_work.has(name_of(version))) return say("wait");
    return version.effect ? "" : say("limits.no_effect");
  }, () => shown === version);
  if (shown === version) show_effect();
}

function open_version(version) {
  shown = version;
  const step = step_of[version.status];
  tell(by_id("version_title"), say("limits.title", { version: name_of(version) }));
  fill_table(by_id("version_limits"), ["trend.indicator", "limits.of", "limits.limit", "limits.why"],
    (version.limits ?? []).map((limit) => [limit.measure, narrowed_to(limit), bound(limit), limit.why ?? ""]));
  by_id("version_go").hidden = !step || page.session?.role !== "engineer";
  if (step) by_id("version_go").textContent = say(`limits.${step}_by`, { name: page.session?.name ?? "" });
  show_effect();
  dialog.showModal();
  by_id("version_title").tabIndex = -1;
  by_id("version_title").focus();
  ask_effect();
}

function row_of(version) {
  const standing = standing_of(version);
  const word = `limits.${step_of[version.status] ?? "show"}`;
  const told = with_detail(say_or(`limits.${standing}`, standing), version.fault);
  return [name_of(version), told, version.plan ?? "",
    say_time(last_step(version, "proposed")?.utc), last_step(version, "approved")?.by ?? "",
    [row_button(word, name_of(version), () => open_version(version))]];
}

export async function show_limits() {
  by_id("propose").disabled = page.session?.role !== "engineer";
  await told_by(by_id("limits_told"), async (is_newest) => {
    const versions = ((await ask("limits")).versions ?? []).slice().reverse();
    if (!is_newest()) return;
    fill_table(by_id("limits"),
      ["limits.version", "limits.status", "limits.plan", "limits.proposed", "limits.approved_by", ""],
      versions.map(row_of));
    return versions.length ? "" : say("limits.none");
  });
}

// The dialogue may be closed meanwhile, and opened for another version.
async function take_step(version) {
  const name = name_of(version);
  const is_shown = () => name_of(shown) === name;
  at_work.add(name);
  show_go();
  await told_by(by_id("version_told"), async () => {
    await act(`limits/${step_of[version.status]}`, { version: name }, long_patience_ms);
    if (is_shown()) dialog.close("done");
    await show_limits();
  }, is_shown);
  at_work.delete(name);
  show_go();
}

export function begin_limits(of_page) {
  page = of_page;
  by_id("propose").addEventListener("click", async () => {
    let has_proposed = false;
    await told_by(by_id("limits_told"), async () => {
      const version = new Date().toISOString().replace(/[-:]|\.\d+/g, "");  // as runs are named
      await act("limits/propose", { version }, long_patience_ms);
      has_proposed = true;
    }, () => true);  // whatever the list was asked for meanwhile
    if (has_proposed) await show_limits();
  });
  by_id("version_go").addEventListener("click", () => take_step(shown));
}
