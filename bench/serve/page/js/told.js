// Refusals in words: the page's where it has some, else the server's own reason.
import { tell } from "./dom.js";
import { say, say_or } from "./words.js";

export function words_of(refusal, values = {}) {
  if (refusal.reason) return refusal.reason.trim();
  const key = `error.${refusal.word}`;
  return say_or(key, null) === null ? say("error.other", { word: refusal.word ?? String(refusal) }) : say(key, values);
}

/** Runs a call; writes its refusal, or what it returns, into an element. */
export async function told_by(element, call) {
  tell(element, say("wait"));
  try {
    tell(element, (await call()) ?? "");
  } catch (refusal) {
    tell(element, words_of(refusal), "fault");
  }
}
