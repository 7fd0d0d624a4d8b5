// Another judgement of a stored run. What was judged then stays.
import { act, ask, long_patience_ms } from "./api.js";
import { by_id, make, tell } from "./dom.js";
import { told_by } from "./told.js";
import { say, say_or } from "./words.js";

const dialog = by_id("rejudge");
let run = null;
let then = () => {};

async function fill_limits() {
  const answer = await ask("limits").catch(() => ({}));
  const usable = (answer.versions ?? []).filter((version) => version.status !== "draft");
  by_id("rejudge_limits").replaceChildren(make("option", { value: "" }, say("rejudge.present")),
    ...usable.map(({ limits_version: version, status }) => make("option", { value: String(version) },
      say("rejudge.version", { version, status: say_or(`limits.${status}`, status) }))));
}

/** @param judged  called when there is another judgement */
export function open_rejudge(which, judged) {
  run = which;
  then = judged;
  tell(by_id("rejudge_title"), say("rejudge.title", { serial: run.serial }));
  tell(by_id("rejudge_told"), "");
  fill_limits();
  dialog.showModal();
  by_id("rejudge_limits").focus();
}

export function begin_rejudge() {
  by_id("rejudge_go").addEventListener("click", () => told_by(by_id("rejudge_told"), async () => {
    const answer = await act("rejudge", { run: run.folder, limits: by_id("rejudge_limits").value }, long_patience_ms);
    then();
    const word = (judged) => say_or(`state.${judged?.verdict}`, judged?.verdict ?? "–");
    const { as_judged, rejudged } = answer.runs?.[0] ?? {};
    return say("rejudge.done", { before: word(as_judged), now: word(rejudged) });
  }));
}
