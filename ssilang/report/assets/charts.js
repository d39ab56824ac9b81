"use strict";
(() => {
const read = id => JSON.parse(document.getElementById(id).textContent);
const charts = read("data-charts"), words = read("data-words");
const figures = [...document.querySelectorAll("figure.chart")];
const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const written = (v, digits) => {
  const a = Math.abs(v);
  return a >= 1e5 || (a > 0 && a < 1e-3)
    ? v.toExponential(digits - 1).replace(/\.?0*e\+?/, "e") : String(+v.toPrecision(digits));
};
const shown = v => v == null ? "" : written(v, 5);
const ticks = (u, values) => values.map(v => v == null ? "" : written(v, 4));
const made = [];

/* Colours that are told apart without red and green (Okabe and Ito), for light and dark. */
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f"];

/* A curve whose abscissas go back and forth. */
const loop = (u, i) => {
  const [xs, ys] = u.data[i], sx = u.series[i].facets[0].scale, sy = u.series[i].facets[1].scale;
  const path = new Path2D(), points = u.series[i].alone, r = 3 * devicePixelRatio;
  let pen = false;
  for (let k = 0; k < xs.length; k++) {
    if (xs[k] == null || ys[k] == null) { pen = false; continue; }
    const x = u.valToPos(xs[k], sx, true), y = u.valToPos(ys[k], sy, true);
    if (points) { path.moveTo(x + r, y); path.arc(x, y, r, 0, 2 * Math.PI); }
    else if (pen) path.lineTo(x, y); else path.moveTo(x, y);
    pen = true;
  }
  u.ctx.save();
  u.ctx.beginPath();
  u.ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
  u.ctx.clip();
  u.ctx.strokeStyle = COLOURS[(i - 1) % COLOURS.length];
  u.ctx.lineWidth = 1.4 * devicePixelRatio;
  u.ctx.stroke(path);
  u.ctx.restore();
  return null;
};

const span = (values, log) => {
  const kept = values.filter(v => v != null && (!log || v > 0));
  let low = Infinity, high = -Infinity;
  for (const v of kept) { if (v < low) low = v; if (v > high) high = v; }
  if (!(high >= low)) return [log ? 1 : 0, log ? 10 : 1];
  if (log) return low < high ? [low, high] : [low / 2, low * 2];
  const room = (high - low) * 0.05 || Math.abs(high) * 0.05 || 1;
  return [low - room, high + room];
};

/* Values of a logarithmic axis that are written: where it spans few powers of ten, others too. */
function few(plot, values) {
  const ratio = values[values.length - 1] / values[0];
  const first = ratio < 8 ? [1, 2, 3, 4, 5, 6, 7, 8, 9] : ratio < 150 ? [1, 2, 5] : [1];
  return values.map(v => first.includes(Math.round(v / 10 ** Math.floor(Math.log10(v) + 1e-9))) ? v : null);
}

function draw(figure) {
  const chart = charts[+figure.dataset.chart], place = figure.querySelector(".plot");
  place.textContent = "";
  const width = Math.max(place.clientWidth, 240);
  const ink = style("--soft"), grid = { stroke: style("--line"), width: 1 };
  const axis = (label, log) => ({ label, ...(log ? { filter: few } : {}), labelSize: 22, stroke: ink, grid, ticks: grid, values: ticks,
    font: "12px system-ui", labelFont: "12px system-ui" });
  const every = key => chart.lines.flatMap(line => line[key]);
  const whole = { x: span(every("x"), chart.log[0]), y: span(every("y"), chart.log[1]) };
  if (!chart.loop && !chart.log[0]) {
    const xs = every("x").filter(v => v != null);
    whole.x = [Math.min(...[xs[0], ...chart.lines.map(l => l.x[0])]),
               chart.lines.reduce((m, l) => Math.max(m, l.x[l.x.length - 1]), -Infinity)];
    if (!(whole.x[1] > whole.x[0])) whole.x[1] = whole.x[0] + 1;
  }
  const scale = key => ({ time: false, distr: chart.log[key === "x" ? 0 : 1] ? 3 : 1,
    ...(key === "x" || chart.loop ? { range: (u, low, high) =>
      low == null ? whole[key] : [low, high] } : {}) });
  const common = { width, height: 260, scales: { x: scale("x"), y: scale("y") },
    axes: [axis(chart.x, chart.log[0]), { ...axis(chart.y, chart.log[1]), size: 68 }],
    cursor: { drag: { x: true, y: chart.loop, uni: 20, setScale: true } },
    legend: { show: chart.lines.length > 1 || !chart.loop } };
  const stroke = i => COLOURS[i % COLOURS.length];
  let plot;
  if (chart.loop) {
    plot = new uPlot({ ...common, mode: 2, legend: { show: chart.lines.length > 1, live: false },
      cursor: { ...common.cursor, points: { show: false }, dataIdx: () => null },
      series: [null, ...chart.lines.map((line, i) => ({ label: line.name, stroke: stroke(i), alone: line.points,
        facets: [{ scale: "x", auto: true }, { scale: "y", auto: true }], paths: loop }))] },
      [null, ...chart.lines.map(line => [line.x, line.y])], place);
    plot.setScale("x", { min: whole.x[0], max: whole.x[1] });
    plot.setScale("y", { min: whole.y[0], max: whole.y[1] });
  } else {
    const data = chart.lines.length > 1
      ? uPlot.join(chart.lines.map(line => [line.x, line.y])) : [chart.lines[0].x, chart.lines[0].y];
    plot = new uPlot({ ...common, series: [{ label: chart.x, value: (u, v) => shown(v) },
      ...chart.lines.map((line, i) => ({ label: line.name, stroke: stroke(i), width: 1.4,
        spanGaps: true, value: (u, v) => shown(v), ...(line.points ? { paths: () => null } : {}),
        points: { show: line.points || line.x.length < 40 } }))] },
      data, place);
  }
  figure.plot = plot;
  plot.whole = whole;
  tools(figure, place, plot, chart);
  pan(plot, chart);
}

/* Buttons that zoom, for the keyboard and for fingers. */
function tools(figure, place, plot, chart) {
  const bar = document.createElement("div");
  bar.className = "tools";
  const zoom = factor => {
    for (const key of chart.loop ? ["x", "y"] : ["x"]) {
      const { min, max } = plot.scales[key], log = chart.log[key === "x" ? 0 : 1];
      const to = log ? Math.log : v => v, from = log ? Math.exp : v => v;
      const middle = (to(min) + to(max)) / 2, half = (to(max) - to(min)) / 2 * factor;
      plot.setScale(key, { min: from(middle - half), max: from(middle + half) });
    }
  };
  const all = () => { for (const key of chart.loop ? ["x", "y"] : ["x"])
    plot.setScale(key, { min: plot.whole[key][0], max: plot.whole[key][1] }); };
  for (const [text, name, act] of [["+", words.zoomIn, () => zoom(0.5)],
      ["\u2212", words.zoomOut, () => zoom(2)], ["\u21ba", words.all, all]]) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = text;
    button.title = name;
    button.setAttribute("aria-label", `${name}: ${chart.title}`);
    button.addEventListener("click", act);
    bar.append(button);
  }
  plot.over.addEventListener("dblclick", all);
  place.prepend(bar);
}

/* A finger moves what is shown; the page still scrolls up and down. */
function pan(plot, chart) {
  let from = null;
  plot.over.style.touchAction = "pan-y";
  plot.over.addEventListener("pointerdown", e => {
    if (e.pointerType !== "touch") return;
    from = { x: e.clientX, min: plot.scales.x.min, max: plot.scales.x.max };
  });
  plot.over.addEventListener("pointermove", e => {
    if (!from || chart.log[0]) return;
    const shift = (from.x - e.clientX) / plot.over.clientWidth * (from.max - from.min);
    plot.setScale("x", { min: from.min + shift, max: from.max + shift });
  });
  for (const end of ["pointerup", "pointercancel"]) plot.over.addEventListener(end, () => from = null);
}

const drawAll = () => figures.forEach(figure => { if (figure.plot) draw(figure); });
if (figures.length) {
  const seen = new IntersectionObserver(entries => entries.forEach(entry => {
    if (entry.isIntersecting && !entry.target.plot) draw(entry.target);
  }), { rootMargin: "600px" });
  figures.forEach(figure => seen.observe(figure));
  let width = innerWidth;
  addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; drawAll(); } });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
  addEventListener("beforeprint", () => figures.forEach(f => { if (!f.plot) draw(f); }));
}
})();
