// The operator page: one state, told by the station, shown by modules that each own their part.
import { session } from "./api.js";
import { show_band } from "./band.js";
import { by_id, tell } from "./dom.js";
import { begin_duplicate, show_duplicate } from "./duplicate.js";
import { begin_history, show_history } from "./history.js";
import { begin_limits, show_limits } from "./limits.js";
import { make_live } from "./live.js";
import { begin_live_plots, show_no_spectrum, show_spectrum, show_strip, show_strips } from "./live_plots.js";
import { ask_for_token, begin_login } from "./login.js";
import { show_matrix } from "./matrix.js";
import { begin_rejudge } from "./rejudge.js";
import { begin_scan, focus_scan } from "./scan.js";
import { make_tabs } from "./tabs.js";
import { tell_refusal } from "./told.js";
import { begin_trend, show_trend } from "./trend.js";
import { begin_unit, show_unit } from "./unit.js";
import { begin_words, say } from "./words.js";

const page = { session: null, state: null, is_connected: false };

function show() {
  document.body.dataset.connected = page.is_connected ? "yes" : "no";
  show_band(page);
  show_unit(page);
  show_matrix(page);
  show_duplicate(page);
  tell(by_id("user"), page.session ? `${page.session.name} · ${say(`role.${page.session.role}`)}` : "");
}

function refresh_view(name = document.body.dataset.view) {
  if (!page.session) return;
  if (name === "history") show_history(page);
  if (name === "trend") show_trend();
  if (name === "limits") show_limits();
}

function show_no_curves() {
  show_strips([]);
  show_no_spectrum();
}

function take_state(state) {
  const has_ended = page.state?.phase === "running" && state.phase !== "running";
  const is_new_unit = page.state?.phase === "ended" && state.phase !== "ended";
  page.state = state;
  page.is_connected = true;
  show();
  if (is_new_unit) show_no_curves();
  if (has_ended) refresh_view();
}

const live = make_live({
  snapshot({ state, strips }) {
    take_state(state);
    show_strips(strips);
    refresh_view();
  },
  state: take_state,
  strip: show_strip,
  spectrum: show_spectrum,
  found: (found) => (page.session = found),
  lost() {
    page.is_connected = false;
    show();
  },
  logged_out,
});

function logged_in(found) {
  page.session = found;
  tabs.go("station");
  live.begin();
  focus_scan();
}

function logged_out() {
  live.end();
  Object.assign(page, { session: null, state: null, is_connected: true });
  show();
  ask_for_token();
}

// Does a call of the operator's and says why it was refused.
async function attempt(call, values) {
  tell(by_id("scan_fault"), "");
  try {
    await call();
  } catch (refusal) {
    tell_refusal(by_id("scan_fault"), refusal, values);
  }
}

const tabs = make_tabs((name) => {
  refresh_view(name);
  focus_scan();
});

await begin_words(() => {
  show();
  refresh_view();
  if (!page.session) by_id("token").focus();  // its letters would choose another language
});
begin_live_plots();
show_no_curves();
begin_login({ logged_in, logged_out });
begin_unit(page, attempt, focus_scan);
begin_scan(page, attempt, () => tabs.go("station"));
begin_duplicate(attempt, focus_scan);
begin_history(page);
begin_rejudge();
begin_trend();
begin_limits(page);
for (const button of document.querySelectorAll("dialog [data-closes]")) {
  button.addEventListener("click", () => button.closest("dialog").close("closed"));
}

// Where nobody is logged in yet, the station is looked for until it answers.
async function begin() {
  try {
    logged_in(await session());
  } catch (refusal) {
    if (refusal.status === 401) return logged_out();
    show();
    setTimeout(begin, 500);
  }
}
await begin();
