// Another judgement of a stored run. What was judged then stays. It takes minutes: meanwhile the
// dialogue may be closed, and opened for another run.
import { act, ask, long_patience_ms } from "./api.js";
import { by_id, make, tell } from "./dom.js";
import { standing_of } from "./limit_versions.js";
import { newest_of, told_by } from "./told.js";
import { say, say_or } from "./words.js";

const dialog = by_id("rejudge");
let run = null;
let then = () => {};
const at_work = new Set();  // folders of runs
let is_listed = false;  // which limits there are to judge by
const unusable = ["draft", "damaged", "missing"];

async function fill_limits() {
  const select = by_id("rejudge_limits");
  const is_newest = newest_of(select);
  is_listed = false;
  const answer = await ask("limits").catch(() => ({}));
  if (!is_newest()) return;  // what was chosen since stays
  const usable = (answer.versions ?? []).filter((version) => !unusable.includes(standing_of(version)));
  select.replaceChildren(make("option", { value: "" }, say("rejudge.present")), ...usable.map((one) => {
    const version = String(one.limits_version), standing = standing_of(one);
    return make("option", { value: version },
      say("rejudge.version", { version, status: say_or(`limits.${standing}`, standing) }));
  }));
  is_listed = true;
  show_work();
}

function show_work() {
  by_id("rejudge_go").disabled = !is_listed || at_work.has(run.folder);
}

/** @param judged  called when there is another judgement */
export function open_rejudge(which, judged) {
  run = which;
  then = judged;
  tell(by_id("rejudge_title"), say("rejudge.title", { serial: run.serial }));
  tell(by_id("rejudge_told"), at_work.has(run.folder) ? say("wait") : "");
  fill_limits();
  show_work();
  dialog.showModal();
  by_id("rejudge_limits").focus();
}

async function judge({ folder }, judged) {
  const answer = await act("rejudge", { run: folder, limits: by_id("rejudge_limits").value }, long_patience_ms);
  judged();
  const word = (judgement) => say_or(`state.${judgement?.verdict}`, judgement?.verdict ?? "–");
  const { as_judged, rejudged } = answer.runs?.[0] ?? {};
  return say("rejudge.done", { before: word(as_judged), now: word(rejudged) });
}

export function begin_rejudge() {
  by_id("rejudge_go").addEventListener("click", async () => {
    const asked = run;
    at_work.add(asked.folder);
    show_work();
    await told_by(by_id("rejudge_told"), () => judge(asked, then), () => run.folder === asked.folder);
    at_work.delete(asked.folder);
    show_work();
  });
}
