// The one big state: word, shape and colour, and what to do next in one sentence.
import { by_id, tell } from "./dom.js";
import { say } from "./words.js";

/** Which of the looks the page has: the first that holds. */
export function look_of(page) {
  if (!page.is_connected) return "not_connected";
  if (!page.session) return "login";
  const state = page.state;
  if (!state) return "not_connected";
  if (state.phase === "running") return "running";
  if (state.phase === "ended" && state.verdict) return state.verdict.word;
  if (state.next_action === "station_not_qualified") return "not_qualified";
  if (state.next_action === "not_allowed") return "not_allowed";
  return state.phase === "ended" ? "ERROR" : state.phase;
}

function next_of(page, look) {
  if (look === "not_connected" || look === "login") return say(`next.${look}`);
  if (look in { PASS: 0, FAIL: 0, INVALID: 0, ERROR: 0, ABORTED: 0 }) return say(`next.${look}`);
  return say(`next.${page.state.next_action}`);
}

export function show_band(page) {
  const look = look_of(page);
  const word = say(`state.${look}`);
  const next = next_of(page, look);
  const serial = page.session && page.state ? page.state.serial : "";
  by_id("band").dataset.look = look;
  by_id("shape").setAttribute("href", `#shape_${look}`);
  tell(by_id("state_word"), word);
  tell(by_id("next_action"), next);
  tell(by_id("serial"), serial);
  tell(by_id("announcer"), [word, serial, next].filter(Boolean).join(". "));
  document.title = `${word} – rvbench`;
}
