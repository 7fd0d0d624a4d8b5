// The scan field. A scanner is a keyboard that ends with Enter: what it types lands here wherever the
// focus was, but for a field to type in: that keeps its text, as nothing tells a scan from typing. An
// empty Enter does nothing: a scanner that sends two must not start a motor.
import { act } from "./api.js";
import { by_id, tell } from "./dom.js";

const field = by_id("scan_text");

export function focus_scan() {
  if (document.body.dataset.view === "station" && !document.querySelector("dialog[open]")) field.focus();
}

// A list to choose from is no such field: by its first letters a scan would choose from it. Arrows do.
function is_typing(element) {
  return element.matches("input, textarea");
}

// Space presses buttons; what is held with Ctrl, Alt or Meta is no text.
function is_text(event) {
  return event.key.length === 1 && event.key !== " " && !event.ctrlKey && !event.altKey && !event.metaKey;
}

/**
 * @param page       its session
 * @param attempt    does a call and shows its refusal
 * @param go_station shows the station's view
 */
export function begin_scan(page, attempt, go_station) {
  document.addEventListener("keydown", (event) => {
    if (!page.session || !is_text(event) || is_typing(document.activeElement)) return;
    const dialog = document.querySelector("dialog[open]");
    if (dialog && dialog.id !== "duplicate") {
      if (document.activeElement.matches("select")) event.preventDefault();  // nor does it choose there
      return;
    }
    dialog?.close("scanned");
    go_station();
    field.focus();
  });
  by_id("scan").addEventListener("submit", async (event) => {
    event.preventDefault();
    const text = field.value.trim();
    field.value = "";
    if (text) await attempt(() => act("scan", { text }), { text });
  });
  field.addEventListener("input", () => tell(by_id("scan_fault"), ""));
}
