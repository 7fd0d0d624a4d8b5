// Plots by uPlot.

const soft = "#56636f";
const grid = { stroke: "#dde3e8", width: 1 };
const font = "12px sans-serif";

export function make_plot(UPlot, element, { colour, x, dots = false }) {
  let plot = null;
  let limits = [];
  const size = () => ({ width: Math.max(80, element.clientWidth), height: Math.max(50, element.clientHeight) });

  function draw_limits(u) {
    for (const limit of limits) {
      const y = u.valToPos(limit, "y", true);
      u.ctx.save();
      u.ctx.strokeStyle = "#b34700";
      u.ctx.lineWidth = 2;
      u.ctx.setLineDash([8, 5]);
      u.ctx.beginPath();
      u.ctx.moveTo(u.bbox.left, y);
      u.ctx.lineTo(u.bbox.left + u.bbox.width, y);
      u.ctx.stroke();
      u.ctx.restore();
    }
  }

  // A flat curve lies in the middle; limits are seen too.
  function range(u, low, high) {
    const all = [low, high, ...limits].filter(Number.isFinite);
    if (!all.length) return [0, 1];
    const least = Math.min(...all), most = Math.max(...all);
    const room = (most - least) * 0.08 || Math.abs(most) * 0.1 || 1;
    return [least - room, most + room];
  }

  function build(data) {
    plot = new UPlot({
      ...size(),
      legend: { show: false },
      cursor: { show: false },
      padding: [6, 30, 0, 0],
      scales: { x: { time: false }, y: { range } },
      axes: [
        { stroke: soft, grid, font, size: 20, gap: 2, ticks: { show: false }, space: 70,
          values: (u, values) => values.map((v, i) => (i === values.length - 1 ? `${v} ${x}` : `${v}`)) },
        { stroke: soft, grid, font, size: 46, gap: 4, ticks: { show: false }, space: 24,
          values: (u, values) => values.map(String) },
      ],
      series: [{}, { stroke: colour, width: 2, points: { show: dots, size: 8, fill: colour } }],
      hooks: { draw: [draw_limits] },
    }, data, element);
    new ResizeObserver(() => plot.setSize(size())).observe(element);
  }

  return (xs, ys, lines = []) => {
    limits = lines;
    element.classList.toggle("nothing", !xs.length);
    if (plot) plot.setData([xs, ys]);
    else build([xs, ys]);
  };
}
