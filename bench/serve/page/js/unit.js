// The unit at the station: its buttons, how its run goes, what came of it.
import { act } from "./api.js";
import { by_id, make, tell } from "./dom.js";
import { tell_with_detail } from "./told.js";
import { say, say_or } from "./words.js";

function clock(left_s) {
  const whole_s = Math.max(0, Math.round(left_s));
  const hours = Math.floor(whole_s / 3600);
  const parts = [Math.floor((whole_s % 3600) / 60), whole_s % 60];
  const texts = parts.map((part) => String(part).padStart(2, "0"));
  return hours ? `${hours}:${texts.join(":")}` : `${parts[0]}:${texts[1]}`;
}

function show_course(progress) {
  const is_known = typeof progress.left_s === "number";
  tell(by_id("left"), is_known ? say("left", { time: clock(progress.left_s) }) : say("left_unknown"));
  by_id("left").classList.toggle("unknown", !is_known);
  by_id("done").value = progress.done ?? 0;
  const stage = say_or(`stage.${progress.phase}`, progress.phase ?? "");
  tell_with_detail(by_id("stage"), stage, progress.text);
}

function show_findings(findings) {
  const items = findings.map((found) => make("li", {},
    make("b", {}, say_or(`component.${found.component}`, found.component)), ": ",
    say_or(`mechanism.${found.mechanism}`, found.mechanism), make("br"),
    make("small", { lang: "en" }, found.advice ?? "")));
  by_id("findings").replaceChildren(...items);
}

function show_answer(verdict) {
  const none = verdict.word === "PASS" && !verdict.findings?.length ? say("findings.none") : "";
  const sentence = say_or(`reason.${verdict.code}`, "");
  tell_with_detail(by_id("reason"), sentence || (verdict.reason ? "" : none), verdict.reason);
  show_findings(verdict.findings ?? []);
  by_id("report").hidden = !verdict.report?.startsWith("/api/runs/");
  if (verdict.report) by_id("report").setAttribute("href", verdict.report);
}

export function show_unit(page) {
  const state = page.state;
  if (!state) return;
  const may_act = page.is_connected && page.session?.role !== "viewer";
  const may_start = state.next_action !== "not_allowed" && state.next_action !== "station_not_qualified";
  by_id("start").hidden = state.phase !== "ready";
  by_id("start").disabled = !may_act || !may_start;
  by_id("decide").hidden = state.phase !== "duplicate";
  by_id("decide").disabled = !may_act || !may_start;
  by_id("stop").hidden = state.phase !== "running";
  by_id("stop").disabled = page.session?.role === "viewer";  // a call may get through where no state comes
  by_id("next").hidden = state.phase !== "ended";
  by_id("next").disabled = !may_act;
  by_id("scan_text").disabled = page.session?.role === "viewer";
  by_id("course").hidden = state.phase !== "running";
  by_id("answer").hidden = state.phase !== "ended";
  by_id("report").hidden = true;
  if (state.phase === "running") show_course(state.progress);
  if (state.phase === "ended" && state.verdict) show_answer(state.verdict);
  by_id("reasons").hidden = state.station.qualified;
  by_id("reasons").replaceChildren(...state.station.reasons.map((reason) => make("li", { lang: "en" }, reason)));
  tell(by_id("station_name"), state.station.name);
}

/**
 * @param page     its state
 * @param attempt  does a call and shows its refusal
 */
export function begin_unit(page, attempt, focus_scan) {
  const on = (id, call) => by_id(id).addEventListener("click", async () => {
    await attempt(call);
    focus_scan();
  });
  on("start", () => act("start", { serial: page.state.serial, retest: false }));
  on("stop", () => act("stop"));
  on("next", () => act("clear"));
}
