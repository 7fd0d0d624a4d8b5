// The dialogue about a unit that was tested before. Its first button is the safe one.
import { act } from "./api.js";
import { by_id, make } from "./dom.js";
import { say, say_time } from "./words.js";
import { chip } from "./chip.js";

const dialog = by_id("duplicate");
let asked_for = "";  // the unit that the dialogue names

function fill(state) {
  by_id("duplicate_title").textContent = say("duplicate.title", { serial: state.serial });
  by_id("known_runs").replaceChildren(...state.known_runs.slice().reverse().map((run) =>
    make("li", {}, chip(run.verdict), say_time(run.started_utc))));
}

/** Opens itself once for each unit scanned, and closes itself when the matter is settled. */
export function show_duplicate(page) {
  const state = page.state;
  const is_open_question = page.is_connected && state?.next_action === "decide_retest";
  if (!is_open_question) {
    asked_for = "";
    if (dialog.open) dialog.close("settled");
    return;
  }
  fill(state);
  if (asked_for === state.serial) return;
  asked_for = state.serial;
  open_duplicate();
}

// From another page a unit may be scanned while it is open: nobody answers for that one unawares.
function open_duplicate() {
  if (!dialog.open) dialog.showModal();
  by_id("another").focus();
}

export function begin_duplicate(attempt, focus_scan) {
  by_id("decide").addEventListener("click", open_duplicate);
  by_id("retest").addEventListener("click", () => {
    dialog.close("retest");
    attempt(() => act("start", { serial: asked_for, retest: true }));
  });
  by_id("another").addEventListener("click", () => {
    dialog.close("another");
    attempt(() => act("clear"));
  });
  dialog.addEventListener("cancel", () => attempt(() => act("clear")));  // Escape
  dialog.addEventListener("close", focus_scan);
}
