// Tables of rows that people read and act on.
import { make } from "./dom.js";
import { say } from "./words.js";

/**
 * @param columns  keys of words; "" is for buttons
 * @param rows     each a list of nodes or texts, or lists of them, one a column
 */
export function fill_table(table, columns, rows) {
  const head = make("tr", {}, ...columns.map((key) => make("th", { scope: "col" }, key ? say(key) : "")));
  const body = rows.map((cells) => make("tr", {}, ...cells.map((cell, i) =>
    make("td", columns[i] ? {} : { class: "actions" }, ...[cell].flat()))));
  table.replaceChildren(make("thead", {}, head), make("tbody", {}, ...body));
}

/** A button that says what it does, and to which row. */
export function row_button(word, of, press) {
  const button = make("button", { type: "button", "aria-label": `${say(word)}: ${of}` }, say(word));
  button.addEventListener("click", press);
  return button;
}
