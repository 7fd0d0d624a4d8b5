// The runs that were, newest first; each with its report, and for engineers another judgement.
import { ask } from "./api.js";
import { chip } from "./chip.js";
import { by_id, make } from "./dom.js";
import { open_rejudge } from "./rejudge.js";
import { fill_table, row_button } from "./table.js";
import { told_by } from "./told.js";
import { say, say_time } from "./words.js";

const most = 200;
const form = by_id("history_filter");

const unit_cell = (run) => [make("b", {}, run.serial), make("span", { class: "then" }, run.plan ?? "")];

// As judged then, and again since.
function verdict_cell(run) {
  return [chip(run.verdict), ...(run.rejudged ?? []).map((judgement) =>
    make("span", { class: "then" }, `${say("history.rejudged")}: `, chip(judgement.verdict)))];
}

function actions(run, page) {
  const name = `${run.serial} ${say_time(run.started_utc)}`;
  const path = run.folder.split("/").map(encodeURIComponent).join("/");
  const report = make("a", { class: "button", href: `/api/runs/${path}/report`, target: "_blank",
    rel: "noopener", "aria-label": `${say("button.report")}: ${name}` }, say("button.report"));
  const again = row_button("history.rejudge", name, () => open_rejudge(run, () => show_history(page)));
  return page.session?.role === "engineer" ? [again, report] : [report];
}

export async function show_history(page) {
  const query = { ...Object.fromEntries(new FormData(form)), last: most };
  await told_by(by_id("history_told"), async () => {
    const answer = await ask("history", query);
    const runs = (answer.runs ?? []).slice().sort((a, b) => (a.started_utc < b.started_utc ? 1 : -1));
    const rows = runs.map((run) =>
      [say_time(run.started_utc), unit_cell(run), verdict_cell(run), run.reason ?? "", actions(run, page)]);
    fill_table(by_id("history"),
      ["history.started", "history.serial", "history.verdict", "history.reason", ""], rows);
    return rows.length ? say("history.newest", { count: rows.length, most }) : say("history.none");
  });
}

export function begin_history(page) {
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    show_history(page);
  });
}
