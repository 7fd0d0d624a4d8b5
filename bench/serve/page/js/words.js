// All words that people read, in the language chosen. words/<language>.json: key -> text, with
// {name} where a value goes.
import { by_id } from "./dom.js";

const languages = { en: "en", zh: "zh-Hans", ja: "ja" };
const languages_of_times = { en: "en-GB", zh: "zh-Hans", ja: "ja" };
const kept_at = "rvbench_language";
const patience_ms = 5000;
const retry_after_ms = 500;
let words = {};
let chosen = "";

/** The text of a key; a key that is not there shows itself. */
export function say(key, values = {}) {
  return (words[key] ?? key).replace(/\{(\w+)\}/g, (all, name) => values[name] ?? all);
}

/** The text of a key, or what stands in for it where the words have none: a word of a server. */
export const say_or = (key, other) => (key in words ? words[key] : other);

/** "3 Feb 2026, 10:15" of "20260203T101500Z" or an ISO 8601 time, in local time. */
export function say_time(utc) {
  const parts = /^(\d{4})-?(\d\d)-?(\d\d)T(\d\d):?(\d\d):?(\d\d)/.exec(utc ?? "");
  if (!parts) return utc ?? "";
  const [year, month, ...rest] = parts.slice(1).map(Number);
  const time = new Date(Date.UTC(year, month - 1, ...rest));
  return new Intl.DateTimeFormat(languages_of_times[by_id("language").value], { dateStyle: "medium", timeStyle: "short" }).format(time);
}

export function say_number(value, digits = 4) {
  if (typeof value !== "number" || !Number.isFinite(value)) return "–";
  return new Intl.NumberFormat(document.documentElement.lang, { maximumSignificantDigits: digits, useGrouping: false }).format(value);
}

function say_all() {
  for (const e of document.querySelectorAll("[data-word]")) e.textContent = say(e.dataset.word);
  for (const e of document.querySelectorAll("[data-word-label]")) e.setAttribute("aria-label", say(e.dataset.wordLabel));
  for (const e of document.querySelectorAll("[data-word-hint]")) e.placeholder = say(e.dataset.wordHint);
  for (const e of document.querySelectorAll("[data-verdict]:is(option)")) e.textContent = say(`state.${e.value}`);
}

function kept_language() {
  const wanted = [localStorage.getItem(kept_at), ...navigator.languages.map((tag) => tag.slice(0, 2))];
  return wanted.find((language) => language in languages) ?? "en";
}

async function words_of(language) {
  const response = await fetch(`/words/${language}.json`, { signal: AbortSignal.timeout(patience_ms) });
  if (!response.ok) throw new Error(`words: status ${response.status}`);
  return response.json();
}

// A station that begins, or is busy, gives no words: they are asked for until they come. Meanwhile
// another language may be chosen.
async function speak(wanted) {
  chosen = wanted;
  let language, found;
  do {
    language = chosen;
    found = await words_of(language).catch(() => new Promise((resolve) => setTimeout(resolve, retry_after_ms)));
  } while (!found || language !== chosen);
  words = found;
  document.documentElement.lang = languages[language];
  by_id("language").value = language;
  say_all();
}

/** Speaks the language kept from last time, and each one that is chosen from now on. */
export async function begin_words(on_change) {
  by_id("language").addEventListener("change", async (event) => {
    localStorage.setItem(kept_at, event.target.value);
    await speak(event.target.value);  // without a backend the old words stay
    on_change();
  });
  await speak(kept_language());
}
