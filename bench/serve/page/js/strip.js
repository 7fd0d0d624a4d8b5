// Which plots there are: uPlot's if it was built in, else the page's own.
//
// make_plot(element, {colour, x, dots}) -> draw(xs, ys, limits): numbers or null (a hole in the
// curve), x rising, its unit named by `x`; limits are horizontal lines. Without values it is empty.

async function choose() {
  try {
    const uplot = await import("/uplot.js");
    const sheet = document.createElement("link");
    sheet.rel = "stylesheet";
    sheet.href = "/uplot.css";
    document.head.append(sheet);
    const { make_plot } = await import("./strip_uplot.js");
    return (element, look) => make_plot(uplot.default, element, look);
  } catch {
    return (await import("./strip_svg.js")).make_plot;
  }
}

export const make_plot = await choose();
