// The runs that were, newest first; each with its report, and for engineers another judgement.
import { ask } from "./api.js";
import { chip } from "./chip.js";
import { by_id, make } from "./dom.js";
import { open_rejudge } from "./rejudge.js";
import { fill_table, row_button } from "./table.js";
import { told_by, with_detail } from "./told.js";
import { say, say_or, say_time } from "./words.js";

const most = 200;
const form = by_id("history_filter");

const unit_cell = (run) => [make("b", {}, run.serial), make("span", { class: "then" }, run.plan ?? "")];

// As judged then, and again since.
function verdict_cell(run) {
  return [chip(run.verdict), ...(run.rejudged ?? []).map((judgement) =>
    make("span", { class: "then" }, `${say("history.rejudged")}: `, chip(judgement.verdict)))];
}

function reason_cell(run) {
  const sentence = run.verdict ? say_or(`reason.${run.error_kind}`, "") : say("history.no_verdict");
  return with_detail(sentence, run.reason);
}

// Without a verdict there is neither a report nor a judgement to repeat.
function actions(run, page) {
  if (!run.verdict) return [];
  const name = `${run.serial} ${say_time(run.started_utc)}`;
  const path = run.folder.split("/").map(encodeURIComponent).join("/");
  const report = make("a", { class: "button", href: `/api/runs/${path}/report`, target: "_blank",
    rel: "noopener", "aria-label": `${say("button.report")}: ${name}` }, say("button.report"));
  const again = row_button("history.rejudge", name, () => open_rejudge(run, () => show_history(page)));
  return page.session?.role === "engineer" ? [again, report] : [report];
}

// The station counts days in UTC; people mean those of the times that they see in the table.
const utc_of = (local) => `${new Date(local).toISOString().slice(0, 19)}Z`;

function query_of({ from, to, ...others }) {
  return { ...others, from: from && utc_of(`${from}T00:00:00`), to: to && utc_of(`${to}T23:59:59`), last: most };
}

function show_runs(runs, page) {
  const newest_first = runs.slice().sort((a, b) => (a.started_utc < b.started_utc ? 1 : -1));
  fill_table(by_id("history"), ["history.started", "history.serial", "history.verdict", "history.reason", ""],
    newest_first.map((run) =>
      [say_time(run.started_utc), unit_cell(run), verdict_cell(run), reason_cell(run), actions(run, page)]));
}

export async function show_history(page) {
  const asked = Object.fromEntries(new FormData(form));
  await told_by(by_id("history_told"), async (is_newest) => {
    let runs = [];
    try {
      runs = (await ask("history", query_of(asked))).runs ?? [];
    } finally {
      if (is_newest()) show_runs(runs, page);  // none after a refusal: others were asked for
    }
    return runs.length ? say("history.newest", { count: runs.length, most }) : say("history.none");
  });
}

export function begin_history(page) {
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    show_runs([], page);
    show_history(page);
  });
}
