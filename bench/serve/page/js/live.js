// Hears the station. Says when it is lost, and finds it again by itself.
import { session } from "./api.js";

const patience_ms = 1500;  // a heartbeat comes every 500 ms
const look_every_ms = 200;
const retry_after_ms = 400;

/**
 * @param on  functions: snapshot({state, strips}), state(State), strip(...), spectrum(...),
 *            lost(), found(session), logged_out()
 * @returns {begin, end}: begin once somebody is logged in
 */
export function make_live(on) {
  let source = null;
  let heard_ms = 0;
  let is_wanted = false;
  let is_trying = false;

  function hang_up() {
    source?.close();
    source = null;
  }

  function listen() {
    hang_up();
    source = new EventSource("/api/events");
    heard_ms = performance.now();
    for (const name of ["snapshot", "state", "strip", "spectrum", "heartbeat"]) {
      source.addEventListener(name, (event) => {
        heard_ms = performance.now();
        on[name]?.(JSON.parse(event.data));
      });
    }
    source.onerror = lose;
  }

  function lose() {
    if (!source) return;
    hang_up();
    on.lost();
    try_again();
  }

  async function try_again() {
    if (is_trying) return;
    is_trying = true;
    while (is_wanted && !source) {
      try {
        const found = await session();
        if (!is_wanted) break;
        listen();
        on.found(found);
      } catch (refusal) {
        if (refusal.status === 401) {
          is_wanted = false;
          on.logged_out();
          break;
        }
        await new Promise((resolve) => setTimeout(resolve, retry_after_ms));
      }
    }
    is_trying = false;
  }

  setInterval(() => {
    if (source && performance.now() - heard_ms > patience_ms) lose();
  }, look_every_ms);

  return {
    begin() {
      is_wanted = true;
      try_again();
    },
    end() {
      is_wanted = false;
      hang_up();
    },
  };
}
