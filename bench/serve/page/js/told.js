// Refusals in words: the page's own sentence for the server's word, and beneath it, in English, what
// the server says itself where it has more to tell.
import { make, tell } from "./dom.js";
import { say, say_or } from "./words.js";

function sentence_of(refusal, values) {
  const key = `error.${refusal.word}`;
  if (say_or(key, null) === null) return say("error.other", { word: refusal.word ?? String(refusal) });
  return say(key, { field: refusal.field, ...values });
}

/** What an element holds: a sentence, and beneath it what is only there in English; that alone where
 *  no sentence fits. */
export function with_detail(sentence, detail) {
  if (!detail) return [sentence];
  if (!sentence) return [make("span", { lang: "en" }, detail)];
  return [sentence, make("small", { class: "detail", lang: "en" }, detail)];
}

export function tell_with_detail(element, sentence, detail, kind = "") {
  if (!detail) return tell(element, sentence, kind);
  if (element.dataset.kind !== kind) element.dataset.kind = kind;
  const told = make("p", {}, ...with_detail(sentence, detail));
  if (element.textContent !== told.textContent) element.replaceChildren(...told.childNodes);
}

export function tell_refusal(element, refusal, values = {}) {
  tell_with_detail(element, sentence_of(refusal, values), refusal.reason?.trim(), "fault");
}

const newest = new WeakMap();

/** Begins a call of an element's; tells from then on whether no other has begun since. */
export function newest_of(element) {
  const own = {};
  newest.set(element, own);
  return () => newest.get(element) === own;
}

/**
 * Runs a call; writes its refusal, or what it returns, into an element: a sentence, or that and what
 * is only there in English.
 * @param is_meant  whether the element still waits for this answer: one that comes late is not written
 * @param call      is given is_meant
 */
export async function told_by(element, call, is_meant = newest_of(element)) {
  tell(element, say("wait"));
  try {
    const [sentence, detail] = [(await call(is_meant)) ?? ""].flat();
    if (is_meant()) tell_with_detail(element, sentence, detail);
  } catch (refusal) {
    if (is_meant()) tell_refusal(element, refusal);
  }
}
