// Small helpers. What a server says becomes text, never markup.

export const by_id = (id) => document.getElementById(id);

/** make("td", {class: "x"}, "text" or node, ...): an element with attributes and content. */
export function make(tag, attributes = {}, ...content) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...content);
  return element;
}

/** An <svg> that shows one of the page's shapes. */
export function shape(name) {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  const use = document.createElementNS(space, "use");
  use.setAttribute("href", `#shape_${name}`);
  svg.setAttribute("aria-hidden", "true");
  svg.append(use);
  return svg;
}

/** Writes only what differs: what did not change is not read out again. */
export function tell(element, text, kind = "") {
  if (element.textContent !== text) element.textContent = text;
  if (element.dataset.kind !== kind) element.dataset.kind = kind;
}
