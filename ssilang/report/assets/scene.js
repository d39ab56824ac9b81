"use strict";
(async () => {
const get = id => document.getElementById(id);
const view = get("scene-view");
if (!view) return;
const words = JSON.parse(get("data-words").textContent);
const scenes = JSON.parse(get("data-scenes").textContent);
const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const rgb = text => { const n = parseInt(text.slice(1), 16), s = text.length === 4
  ? [n >> 8, n >> 4 & 15, n & 15].map(v => v * 17) : [n >> 16, n >> 8 & 255, n & 255];
  return s.map(v => v / 255); };
const NONE = -32768;

const probe = document.createElement("canvas");
if (!probe.getContext("webgl2")) {
  const p = document.createElement("p");
  p.textContent = words.noWebgl;
  view.append(p);
  return;
}

/* ---- data ------------------------------------------------------------------------------------ */

const TYPES = { field: Int16Array, points: Float32Array };
async function unpacked(number) {
  const raw = Uint8Array.from(atob(get(`scene-${number}`).textContent), c => c.charCodeAt(0));
  const stream = new Blob([raw]).stream().pipeThrough(new DecompressionStream("deflate"));
  const buffer = await new Response(stream).arrayBuffer();
  const scene = { ...scenes[number], values: {} };
  for (const [name, [at, size]] of Object.entries(scene.arrays)) {
    const kind = TYPES[name.split(":")[0]] || Uint32Array;
    scene.values[name] = new kind(buffer, at, size);
  }
  const count = scene.times.length;
  for (const field of scene.fields) {  /* differences from one instant to the next */
    const all = scene.values[`field:${field.name}`], size = all.length / count;
    for (let i = size; i < all.length; i++) all[i] += all[i - size];
    field.frames = Array.from({ length: count }, (_, k) => all.subarray(k * size, (k + 1) * size));
  }
  scene.moves = scene.fields.find(f => f.name === "displacement");
  return scene;
}

/* ---- what is drawn --------------------------------------------------------------------------- */

const { vtkGenericRenderWindow } = vtk.Rendering.Misc;
const { vtkActor, vtkMapper, vtkColorTransferFunction } = vtk.Rendering.Core;
const { vtkPolyData } = vtk.Common.DataModel;
const { vtkDataArray } = vtk.Common.Core;
const maps = vtkColorTransferFunction.vtkColorMaps;
const window3d = vtkGenericRenderWindow.newInstance({ listenWindowResize: false });
window3d.setContainer(view);
const renderer = window3d.getRenderer(), context = window3d.getRenderWindow();
const render = () => context.render();

const cells = (index, size) => {
  const made = new Uint32Array(index.length / size * (size + 1));
  for (let i = 0, k = 0; i < index.length; i += size) {
    made[k++] = size;
    for (let j = 0; j < size; j++) made[k++] = index[i + j];
  }
  return made;
};

class Body {
  /* Points that move, with triangles, segments and lone points of them, and perhaps a colour. */
  constructor(count, { triangles = [], lines = [], vertices = [] }, flat) {
    this.data = vtkPolyData.newInstance();
    this.where = new Float32Array(3 * count);
    this.data.getPoints().setData(this.where, 3);
    if (triangles.length) this.data.getPolys().setData(cells(triangles, 3));
    if (lines.length) this.data.getLines().setData(cells(lines, 2));
    if (vertices.length) this.data.getVerts().setData(cells(vertices, 1));
    this.scalars = vtkDataArray.newInstance({ name: "shown", values: new Float32Array(count) });
    this.mapper = vtkMapper.newInstance({ interpolateScalarsBeforeMapping: true });
    this.mapper.setInputData(this.data);
    this.actor = vtkActor.newInstance();
    this.actor.setMapper(this.mapper);
    const look = this.actor.getProperty();
    look.setPointSize(7);
    look.setBackfaceCulling(false);
    if (flat) look.setLighting(false);
    else { look.setAmbient(0.3); look.setDiffuse(0.8); }
  }
  changed() { this.data.getPoints().setData(this.where, 3); this.data.modified(); }
}

let scene = null, bodies = null, edges = null, ghost = null, joints = null, playing = false;
let frame = 0, factor = 1, phase = 0;
const cache = {};

function colours(low, high) {
  const both = low < 0 && high > 0, made = vtkColorTransferFunction.newInstance();
  const most = Math.max(Math.abs(low), Math.abs(high)) || 1;
  made.applyColorMap(maps.getPresetByName(both ? "Cool to Warm" : "Viridis (matplotlib)"));
  const range = both ? [-most, most] : low < high ? [low, high] : [low, low + (Math.abs(low) || 1)];
  made.setMappingRange(...range);
  made.updateRange();
  return { made, range };
}

function build() {
  renderer.removeAllViewProps();
  const v = scene.values, count = v.points.length / 3, flat = scene.flat;
  bodies = new Body(count, { triangles: v.triangles, lines: v.lines, vertices: v.vertices }, flat);
  edges = new Body(count, { lines: v.edges }, true);
  ghost = new Body(count, { lines: v.edges.length ? v.edges : v.lines }, true);
  joints = new Body(v.joint_points.length,
    { triangles: v.joint_triangles, lines: v.joint_lines }, true);
  bodies.actor.getProperty().setLineWidth(3);
  edges.actor.getProperty().setLineWidth(1);
  joints.actor.getProperty().setLineWidth(5);
  /* edges and joints lie on faces: these are drawn a little behind */
  for (const body of [bodies, edges, joints]) body.mapper.setResolveCoincidentTopologyToPolygonOffset();
  joints.mapper.setRelativeCoincidentTopologyPolygonOffsetParameters(-4, -4);
  ghost.where.set(v.points);
  ghost.changed();
  for (const body of [ghost, bodies, edges, joints]) renderer.addActor(body.actor);
  paint();
}

function paint() {
  renderer.setBackground(...rgb(style("--back")));
  edges.actor.getProperty().setColor(...rgb(style("--ink")));
  edges.actor.getProperty().setOpacity(0.35);
  ghost.actor.getProperty().setColor(...rgb(style("--soft")));
  ghost.actor.getProperty().setOpacity(0.5);
  bodies.actor.getProperty().setColor(0.62, 0.68, 0.74);
  joints.actor.getProperty().setColor(0.84, 0.37, 0);
}

/* Values at a frame, real numbers; null where there are none. */
const OF_JOINTS = ["opening", "pressure"];
const COMPONENTS = { ux: 0, uy: 1, uz: 2 };
function values(name, k, into) {
  if (name === "magnitude" || name in COMPONENTS) {
    const d = scene.moves.frames[k], s = scene.moves.scale;
    for (let i = 0; i < into.length; i++) into[i] = name === "magnitude"
      ? s * Math.hypot(d[3 * i], d[3 * i + 1], d[3 * i + 2]) : s * d[3 * i + COMPONENTS[name]];
    return;
  }
  const field = scene.fields.find(f => f.name === name), d = field.frames[k];
  for (let i = 0; i < into.length; i++) into[i] = d[i] === NONE ? NaN : field.scale * d[i];
}

/* Least and largest over all instants. */
function bounds(name) {
  const field = scene.fields.find(f => f.name === name);
  if (field) return name === "opening" || name === "pressure" ? [0, Math.max(field.high, 0)]
    : [field.low, field.high];
  scene.bounds = scene.bounds || {};
  if (!scene.bounds[name]) {
    const some = new Float32Array(scene.values.points.length / 3);
    let low = Infinity, high = -Infinity;
    for (let k = 0; k < scene.times.length; k++) {
      values(name, k, some);
      for (const x of some) { if (x < low) low = x; if (x > high) high = x; }
    }
    scene.bounds[name] = [name === "magnitude" ? 0 : low, high];
  }
  return scene.bounds[name];
}

function colour() {
  const name = get("scene-colour").value, onJoints = OF_JOINTS.includes(name);
  for (const body of [bodies, joints]) {
    const mine = name !== "plain" && onJoints === (body === joints);
    body.shown = mine ? name : "";
    body.mapper.setScalarVisibility(mine);
    if (mine) body.data.getPointData().setScalars(body.scalars);
  }
  get("scene-scale").hidden = name === "plain";
  if (name === "plain") return;
  const { made, range } = colours(...bounds(name)), body = onJoints ? joints : bodies;
  made.setNanColor(0.6, 0.6, 0.6, 1);
  body.mapper.setLookupTable(made);
  body.mapper.setUseLookupTableScalarRange(true);
  const pen = get("scale-colours").getContext("2d"), c = [0, 0, 0];
  for (let i = 0; i < 256; i++) {
    made.getColor(range[0] + (range[1] - range[0]) * i / 255, c);
    pen.fillStyle = `rgb(${c.map(x => Math.round(255 * x)).join(",")})`;
    pen.fillRect(i, 0, 1, 1);
  }
  get("scale-low").textContent = range[0].toPrecision(3);
  get("scale-high").textContent = range[1].toPrecision(3);
  get("scale-name").textContent = words[name];
}

/* Where things are at this instant. */
function move() {
  const v = scene.values, swing = scene.kind === "modes" ? Math.cos(phase) : 1;
  const d = scene.moves.frames[frame], s = scene.moves.scale * factor * swing, to = bodies.where;
  for (let i = 0; i < to.length; i++) to[i] = v.points[i] + s * d[i];
  edges.where.set(to);
  const at = v.joint_points, there = joints.where;
  for (let i = 0; i < at.length; i++) for (let j = 0; j < 3; j++) there[3 * i + j] = to[3 * at[i] + j];
  for (const body of [bodies, edges, joints]) {
    if (body.shown) {
      const all = body.scalars.getData();
      values(body.shown, frame, all);
      if (scene.kind === "modes") for (let i = 0; i < all.length; i++) all[i] *= swing;
      body.scalars.setData(all);
      body.scalars.modified();
    }
    body.changed();
  }
  const when = scene.times[frame];
  get("scene-now").textContent = scene.kind === "modes"
    ? `${words.mode} ${frame + 1} · ${(+scene.frequencies[frame].toPrecision(5))} Hz`
    : scene.times.length > 1 ? String(+when.toPrecision(5)) : "";
  get("scene-factor").textContent = `\u00d7 ${+factor.toPrecision(3)}`;
  render();
}

/* The slider of the factor: 0, then from a hundredth to a hundred times the first one. */
const fromSlider = x => x <= 0 ? 0 : scene.usual * 10 ** ((x - 200) / 100);
function usualFactor() {
  const b = [Infinity, -Infinity, Infinity, -Infinity, Infinity, -Infinity], p = scene.values.points;
  for (let i = 0; i < p.length; i++) {
    const j = 2 * (i % 3);
    b[j] = Math.min(b[j], p[i]);
    b[j + 1] = Math.max(b[j + 1], p[i]);
  }
  const size = Math.hypot(b[1] - b[0], b[3] - b[2], b[5] - b[4]) || 1;
  const most = Math.max(Math.abs(scene.moves.low), Math.abs(scene.moves.high));
  if (!most) return 1;
  const wanted = 0.08 * size / most, power = 10 ** Math.floor(Math.log10(wanted));
  const round = [5, 2, 1].find(k => k * power <= wanted) * power;
  return scene.kind === "modes" ? wanted : Math.max(round, wanted > 0.2 ? Math.min(1, wanted) : round);
}

/* The instant to begin with: of the largest opening, else of the largest displacement. */
function mostMoved() {
  const field = scene.fields.find(f => f.name === "opening" && f.high > 0) || scene.moves;
  let best = 0, most = -1;
  field.frames.forEach((all, k) => {
    for (const x of all) { const a = field === scene.moves ? Math.abs(x) : x;
      if (x !== NONE && a > most) { most = a; best = k; } }
  });
  return best;
}

function reset() {
  const camera = renderer.getActiveCamera();
  camera.setParallelProjection(scene.flat);
  camera.setFocalPoint(0, 0, 0);
  if (scene.flat) { camera.setPosition(0, 0, 1); camera.setViewUp(0, 1, 0); }
  else { camera.setPosition(0.6, -1.2, 0.55); camera.setViewUp(0, 0, 1); }
  renderer.resetCamera();
  if (scene.flat) {
    const b = renderer.computeVisiblePropBounds(), wide = view.clientWidth / view.clientHeight;
    camera.setParallelScale(0.54 * Math.max(b[3] - b[2], (b[1] - b[0]) / wide) || 1);
  } else camera.zoom(1.25);
  renderer.resetCameraClippingRange();
  render();
}

async function choose(number) {
  pause();
  scene = cache[number] = cache[number] || await unpacked(number);
  build();
  const list = get("scene-colour"), names = ["plain"];
  list.textContent = "";
  if (scene.moves.scale !== 1 || scene.moves.high) {
    names.push("magnitude", "ux", "uy");
    if (!scene.flat) names.push("uz");
  }
  for (const field of scene.fields) if (field !== scene.moves && field.high > field.low)
    names.push(field.name);
  for (const name of names) list.add(new Option(words[name], name));
  list.value = names.includes("magnitude") ? "magnitude" : "plain";
  const time = get("scene-time"), many = scene.times.length > 1 || scene.kind === "modes";
  time.max = scene.times.length - 1;
  time.value = frame = scene.kind === "motion" ? mostMoved() : 0;
  time.disabled = scene.times.length < 2;
  get("scene-play").closest(".bar").hidden = !many;
  get("scene-when").textContent = scene.kind === "modes" ? words.mode : words.time;
  scene.usual = usualFactor();
  factor = scene.usual;
  get("scene-warp").value = 200;
  colour();
  switches();
  move();
  reset();
}

function switches() {
  edges.actor.setVisibility(get("scene-edges").checked);
  ghost.actor.setVisibility(get("scene-ghost").checked);
  /* in space bodies hide the joints between them */
  const hidden = !scene.flat && OF_JOINTS.includes(get("scene-colour").value);
  bodies.actor.getProperty().setOpacity(hidden || get("scene-through").checked ? 0.25 : 1);
}

/* ---- playing --------------------------------------------------------------------------------- */

let last = 0;
function tick(now) {
  if (!playing) return;
  if (scene.kind === "modes") { phase += Math.min(now - last, 100) / 1000 * 2 * Math.PI * 0.7; last = now; move(); }
  else if (now - last > 60) {
    last = now;
    frame = (frame + 1) % scene.times.length;
    get("scene-time").value = frame;
    move();
  }
  requestAnimationFrame(tick);
}
function pause() {
  playing = false;
  phase = 0;
  get("scene-play").textContent = words.play;
  get("scene-play").setAttribute("aria-pressed", "false");
}
function play() {
  playing = true;
  last = performance.now();
  get("scene-play").textContent = words.pause;
  get("scene-play").setAttribute("aria-pressed", "true");
  requestAnimationFrame(tick);
}

get("scene-play").addEventListener("click", () => { if (playing) { pause(); move(); } else play(); });
get("scene-time").addEventListener("input", e => { pause(); frame = +e.target.value; move(); });
get("scene-warp").addEventListener("input", e => { factor = fromSlider(+e.target.value); move(); });
get("scene-choice").addEventListener("change", e => choose(+e.target.value));
get("scene-colour").addEventListener("change", () => { colour(); switches(); move(); });
for (const id of ["scene-edges", "scene-ghost", "scene-through"])
  get(id).addEventListener("change", () => { switches(); render(); });
get("scene-reset").addEventListener("click", reset);
view.addEventListener("keydown", e => {
  const camera = renderer.getActiveCamera();
  const act = { ArrowLeft: () => camera.azimuth(-8), ArrowRight: () => camera.azimuth(8),
    ArrowUp: () => camera.elevation(5), ArrowDown: () => camera.elevation(-5),
    "+": () => camera.zoom(1.15), "-": () => camera.zoom(1 / 1.15) }[e.key];
  if (!act) return;
  e.preventDefault();
  act();
  camera.orthogonalizeViewUp();
  renderer.resetCameraClippingRange();
  render();
});
new ResizeObserver(() => { window3d.resize(); render(); }).observe(view);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { paint(); render(); });
addEventListener("beforeprint", () => {
  render();
  const canvas = view.querySelector("canvas");
  if (canvas) get("scene-print").src = canvas.toDataURL();
});
window3d.resize();
/* The scene to begin with: that in which most opens. */
const gap = s => Math.max(0, ...s.fields.filter(f => f.name === "opening").map(f => f.high));
const first = scenes.reduce((best, s, i) => gap(s) > gap(scenes[best]) ? i : best, 0);
get("scene-choice").value = first;
await choose(first);
view.dataset.ready = "1";
})();
