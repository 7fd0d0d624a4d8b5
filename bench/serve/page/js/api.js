// Calls of the station's API. Every refusal is a Refusal with the API's word for it.

export class Refusal extends Error {
  constructor(status, answer) {
    super(answer.error ?? `http_${status}`);
    this.word = answer.error ?? `http_${status}`;
    this.reason = answer.reason ?? "";
    this.field = answer.field ?? "";
    this.status = status;
  }
}

const patience_ms = 20000;
let csrf = "";

async function call(path, options = {}, wait_ms = patience_ms) {
  let response;
  try {
    response = await fetch(path, { signal: AbortSignal.timeout(wait_ms), cache: "no-store", ...options });
  } catch {
    throw new Refusal(0, { error: "not_connected" });
  }
  const answer = await response.json().catch(() => ({}));
  if (!response.ok) throw new Refusal(response.status, answer);
  return answer;
}

/** Of what works through recordings. */
export const long_patience_ms = 600000;

export function ask(path, query = {}, wait_ms = patience_ms) {
  const filled = Object.entries(query).filter(([, value]) => value);
  return call(`/api/${path}${filled.length ? `?${new URLSearchParams(filled)}` : ""}`, {}, wait_ms);
}

export function act(path, body = {}, wait_ms = patience_ms) {
  return call(`/api/${path}`, {
    method: "POST",
    headers: { "Content-Type": "application/json", "X-CSRF-Token": csrf },
    body: JSON.stringify(body),
  }, wait_ms);
}

/** Who is logged in: {name, role}. */
export async function session(wait_ms = 1000) {
  return keep(await call("/api/session", {}, wait_ms));
}

export async function log_in(token) {
  return keep(await act("login", { token }));
}

function keep(answer) {
  csrf = answer.csrf;
  return answer;
}
