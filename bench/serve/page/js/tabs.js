// The views and their tabs: arrows move between tabs, as in every list of tabs.
import { by_id } from "./dom.js";

const names = ["station", "history", "trend", "limits"];

/** @param on_show  function(name) for the view that has come up */
export function make_tabs(on_show) {
  const tab = (name) => by_id(`tab_${name}`);

  function go(name) {
    if (document.body.dataset.view === name) return;
    document.body.dataset.view = name;
    for (const other of names) {
      tab(other).setAttribute("aria-selected", String(other === name));
      tab(other).tabIndex = other === name ? 0 : -1;
    }
    on_show(name);
  }

  for (const name of names) tab(name).addEventListener("click", () => go(name));
  by_id("tabs").addEventListener("keydown", (event) => {
    const now = names.findIndex((name) => tab(name) === document.activeElement);
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (now < 0 || !step) return;
    event.preventDefault();
    const next = names[(now + step + names.length) % names.length];
    go(next);
    tab(next).focus();
  });
  by_id("skip").addEventListener("click", (event) => {
    event.preventDefault();
    go("station");
    by_id("scan_text").focus();
  });
  return { go };
}
