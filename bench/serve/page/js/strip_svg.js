// The page's own plain plots, for a program that was built without npm.

const space = "http://www.w3.org/2000/svg";
const left = 50, right = 10, top = 8, bottom = 18;

function node(name, attributes, text = "") {
  const element = document.createElementNS(space, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.textContent = text;
  return element;
}

// A flat curve lies in the middle.
function range_of(values) {
  const all = values.filter(Number.isFinite);
  if (!all.length) return [0, 1];
  const least = Math.min(...all), most = Math.max(...all);
  const room = (most - least) * 0.08 || Math.abs(most) * 0.1 || 1;
  return [least - room, most + room];
}

// Some numbers that are easily read: multiples of 1, 2 or 5 times a power of ten.
function round_values(low, high) {
  const rough = (high - low) / 4, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((times) => times * power).find((candidate) => candidate >= rough);
  const values = [];
  for (let i = Math.ceil(low / step); i * step <= high; ++i) values.push(i * step);
  return values;
}

// A hole in the values is a hole in the curve.
function path_of(xs, ys, across, down) {
  let is_down = false;
  return xs.map((x, i) => {
    if (!Number.isFinite(ys[i])) return (is_down = false) || "";
    const step = `${is_down ? "L" : "M"}${across(x).toFixed(1)} ${down(ys[i]).toFixed(1)}`;
    is_down = true;
    return step;
  }).join("");
}

const short = (value) => String(Number(value.toPrecision(3)));

export function make_plot(element, { colour, x: unit_of_x, dots = false }) {
  const svg = node("svg", { class: "plot_svg", "aria-hidden": "true" });
  element.append(svg);
  let last = null;

  function draw(xs, ys, limits = []) {
    last = [xs, ys, limits];
    element.classList.toggle("nothing", !xs.length);
    const width = Math.max(80, element.clientWidth), height = Math.max(50, element.clientHeight);
    const [low, high] = range_of([...ys, ...limits]);
    const first = xs[0] ?? 0, end = xs[xs.length - 1] ?? 1;
    const across = (x) => left + ((x - first) / (end - first || 1)) * (width - left - right);
    const down = (y) => height - bottom - ((y - low) / (high - low)) * (height - top - bottom);
    const parts = [];
    for (const value of round_values(low, high)) {
      const y = down(value);
      parts.push(node("line", { class: "grid", x1: left, x2: width - right, y1: y, y2: y }));
      parts.push(node("text", { x: left - 6, y: y + 4, "text-anchor": "end" }, short(value)));
    }
    if (xs.length) {
      parts.push(node("text", { x: left, y: height - 4 }, short(first)));
      parts.push(node("text", { x: width - right, y: height - 4, "text-anchor": "end" }, `${short(end)} ${unit_of_x}`));
    }
    for (const limit of limits) {
      parts.push(node("line", { class: "limit", x1: left, x2: width - right, y1: down(limit), y2: down(limit) }));
    }
    parts.push(node("path", { class: "curve", stroke: colour, d: path_of(xs, ys, across, down) }));
    if (dots) {
      xs.forEach((x, i) => Number.isFinite(ys[i]) &&
        parts.push(node("circle", { cx: across(x), cy: down(ys[i]), r: 4, fill: colour })));
    }
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.replaceChildren(...parts);
  }

  new ResizeObserver(() => last && draw(...last)).observe(element);
  return draw;
}
