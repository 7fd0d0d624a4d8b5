// The matrix of a plan: a row per speed, a column per load, a mark per repeat.
import { by_id, make } from "./dom.js";
import { say, say_number } from "./words.js";

let built_for = "";
let marks = [];

const key_of = (speed, load, repeat) => `${speed}/${load}/${repeat}`;

function build(matrix) {
  const places = new Map(matrix.cells.map((cell, i) => [key_of(cell.speed_rpm, cell.load_pct, cell.repeat), i]));
  marks = matrix.cells.map((cell) => make("span", { class: "mark", title: String(cell.repeat) }));
  const columns = matrix.loads_pct.length ? matrix.loads_pct : [null];
  const speeds = matrix.speeds_rpm.length ? matrix.speeds_rpm : matrix.cells.length ? [null] : [];
  const cell_of = (speed, load) => {
    const td = make("td");
    for (let repeat = 0; repeat <= matrix.repeats; ++repeat) {
      const place = places.get(key_of(speed, load, repeat));
      if (place !== undefined) td.append(marks[place]);
    }
    if (!td.children.length) td.className = "empty";
    return td;
  };
  const head = make("tr", {}, make("th", { scope: "col" }, say("matrix.corner")),
    ...columns.map((load) => make("th", { scope: "col" }, load === null ? "" : `${say_number(load)} %`)));
  const rows = speeds.map((speed) => make("tr", {},
    make("th", { scope: "row" }, speed === null ? "" : `${say_number(speed, 6)} rpm`),
    ...columns.map((load) => cell_of(speed, load))));
  by_id("matrix").replaceChildren(make("caption", { class: "unseen" }, say("matrix.caption")),
    make("thead", {}, head), make("tbody", {}, ...rows));
}

export function show_matrix(page) {
  const matrix = page.state?.matrix;
  if (!matrix) return;
  const { cells, speeds_rpm, loads_pct } = matrix;
  const keys = cells.map((cell) => key_of(cell.speed_rpm, cell.load_pct, cell.repeat));
  const shape = JSON.stringify([document.documentElement.lang, speeds_rpm, loads_pct, keys]);
  if (shape !== built_for) build(matrix);
  built_for = shape;
  cells.forEach((cell, i) => {
    if (marks[i].dataset.status === cell.status) return;
    marks[i].dataset.status = cell.status;
    marks[i].setAttribute("aria-label", say(`cell.${cell.status}`));
    marks[i].setAttribute("role", "img");
  });
}
