// Who is at the station. A token may be scanned, as serials are.
import { act, log_in } from "./api.js";
import { by_id, tell } from "./dom.js";
import { tell_refusal } from "./told.js";

export function ask_for_token() {
  document.body.dataset.view = "login";
  for (const dialog of document.querySelectorAll("dialog[open]")) dialog.close("logged_out");
  by_id("token").focus();
}

/** @param on  {logged_in(session), logged_out()} */
export function begin_login(on) {
  by_id("login").addEventListener("submit", async (event) => {
    event.preventDefault();
    const token = by_id("token").value.trim();
    by_id("token").value = "";
    if (!token) return;
    try {
      const session = await log_in(token);
      tell(by_id("login_fault"), "");
      on.logged_in(session);
    } catch (refusal) {
      tell_refusal(by_id("login_fault"), refusal);
    }
  });
  by_id("logout").addEventListener("click", async () => {
    await act("logout").catch(() => {});  // gone or not: nobody is logged in here any more
    on.logged_out();
  });
}
