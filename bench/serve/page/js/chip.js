// A verdict in a line of text: shape and word, in its colour.
import { make, shape } from "./dom.js";
import { say } from "./words.js";

const known = ["PASS", "FAIL", "INVALID", "ERROR", "ABORTED"];

export function chip(verdict) {
  if (!known.includes(verdict)) return make("span", { class: "chip" }, verdict || "–");
  return make("span", { class: "chip", "data-verdict": verdict }, shape(verdict), say(`state.${verdict}`));
}
