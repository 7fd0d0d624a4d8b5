// Refusals in words: the page's own sentence for the server's word, and beneath it, in English, what
// the server says itself where it has more to tell.
import { make, tell } from "./dom.js";
import { say, say_or } from "./words.js";

function sentence_of(refusal, values) {
  const key = `error.${refusal.word}`;
  if (say_or(key, null) === null) return say("error.other", { word: refusal.word ?? String(refusal) });
  return say(key, { field: refusal.field, ...values });
}

/** Writes a sentence into an element, and beneath it what is only there in English. */
export function tell_with_detail(element, sentence, detail, kind = "") {
  tell(element, sentence, kind);
  if (detail) element.append(make("small", { class: "detail", lang: "en" }, detail));
}

export function tell_refusal(element, refusal, values = {}) {
  tell_with_detail(element, sentence_of(refusal, values), refusal.reason?.trim(), "fault");
}

/** Runs a call; writes its refusal, or what it returns, into an element. */
export async function told_by(element, call) {
  tell(element, say("wait"));
  try {
    tell(element, (await call()) ?? "");
  } catch (refusal) {
    tell_refusal(element, refusal);
  }
}
