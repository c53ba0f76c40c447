"use strict";
(() => {
const data = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);
const flat = data.dimension === 2;
const N = data.points.length;
// The palette of Okabe and Ito, for classes of congruent figures.
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const LIGHTER = ["#58b4ee", "#ff8f40", "#3ecf9f", "#e79cc6", "#f3bb45", "#8fd0f7"];
const state = {
  figure: 0, at: null, // at: a place on the path; null: a figure of the list
  show: { names: N <= 40, sizes: data.bars.length <= 14, faces: !flat, ghost: true, all: false },
  turn: identity(), zoom: 1, shift: [0, 0], filter: "all", span: null, playing: false, dark: false,
};

function identity() {
  if (flat) return [1, 0, 0, 0, 1, 0, 0, 0, 1];
  // From the front, a little from the right and from above, the third axis upwards.
  return multiply(about(0, -1.22), about(2, -0.5));
}
function about(axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return axis === 0 ? [1, 0, 0, 0, c, -s, 0, s, c] : axis === 1 ? [c, 0, s, 0, 1, 0, -s, 0, c] : [c, -s, 0, s, c, 0, 0, 0, 1];
}
function multiply(a, b) {
  const out = [];
  for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++)
    out.push(a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j]);
  return out;
}
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const classColour = (k) => (state.dark ? LIGHTER : COLOURS)[k % COLOURS.length];
const short = (x) => !isFinite(x) ? "?" : x === 0 ? "0" : Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3 ? x.toExponential(3) : String(+x.toPrecision(5));

// ---- the path of the figure that is shown: figures between samples are interpolated, which the eye cannot tell
let path = null, samples = [], start = 0, last = 0;
function travel(k) {
  const next = data.paths[k] ?? null;
  if (next === path) return;
  path = next;
  samples = path ? path.samples : [];
  start = samples.length ? samples[0].at : 0;
  last = samples.length ? samples[samples.length - 1].at : 0;
  state.span = null;
  $("travel").hidden = !path;
  if (!path) return;
  $("slider").min = start; $("slider").max = last;
  $("which").hidden = !path.name; $("which").textContent = path.name;
  $("legend").textContent = path.legend;
  $("how-near").hidden = !path.accuracy;
  if (path.accuracy) $("accuracy-legend").textContent = path.accuracy.legend;
}
// The only path there is stays where a figure that is not on it is shown.
const only = data.paths.length === 1 && !data.paths[0].name ? 0 : null;
const onPath = (figure) => figure.at !== null && figure.path !== null && data.paths[figure.path] === path;
function between(at) {
  let lo = 0, hi = samples.length - 1;
  while (hi - lo > 1) { const mid = (lo + hi) >> 1; if (samples[mid].at <= at) lo = mid; else hi = mid; }
  const a = samples[lo], b = samples[hi] || a;
  const u = b.at > a.at ? Math.min(1, Math.max(0, (at - a.at) / (b.at - a.at))) : 0;
  const points = new Float64Array(3 * N);
  for (let i = 0; i < 3 * N; i++) points[i] = a.points[i] + u * (b.points[i] - a.points[i]);
  const outlines = a.outlines.map((numbers, k) => numbers.map((x, i) => x + u * ((b.outlines[k] || numbers)[i] - x)));
  return { points, outlines, t: a.t + u * (b.t - a.t) };
}
function current() {
  if (state.at !== null) return between(state.at);
  const figure = data.figures[state.figure];
  return { points: figure.points, outlines: figure.outlines, t: figure.t, kind: figure.kind };
}

// ---- faces: triangles of bars
const faces = (() => {
  if (data.bars.length > 400) return [];
  const joined = new Map(), key = (a, b) => a < b ? a * N + b : b * N + a;
  for (const bar of data.bars) joined.set(key(bar.ends[0], bar.ends[1]), true);
  const out = [];
  for (const { ends: [a, b] } of data.bars)
    for (let c = Math.max(a, b) + 1; c < N; c++)
      if (joined.has(key(a, c)) && joined.has(key(b, c))) out.push([a, b, c]);
  return out;
})();

// ---- the stage
const view = $("view"), pen = view.getContext("2d");
let frame = null; // the middle and the size of what is shown
function fit() {
  const lo = [Infinity, Infinity, Infinity], hi = [-Infinity, -Infinity, -Infinity];
  const grow = (p) => { for (let i = 0; i < 3 * N; i++) { const k = i % 3; if (p[i] < lo[k]) lo[k] = p[i]; if (p[i] > hi[k]) hi[k] = p[i]; } };
  data.figures.slice(0, 60).forEach((f) => grow(f.points));
  // Circles and spheres reach further than their centres.
  const round = (f, does) => f.outlines.forEach((o, k) => { if (o.length === 4) does([o[0], o[1], o[2]], o[3]); });
  data.figures.slice(0, 60).forEach((f) => round(f, (c, r) => c.forEach((x, k) => { if (k < 2 || !flat) { lo[k] = Math.min(lo[k], x - r); hi[k] = Math.max(hi[k], x + r); } })));
  const middle = lo.map((x, k) => 0.5 * (x + hi[k]));
  let size = 0;
  const reach = (p) => { for (let i = 0; i < N; i++) size = Math.max(size, Math.hypot(p[3 * i] - middle[0], p[3 * i + 1] - middle[1], p[3 * i + 2] - middle[2])); };
  data.figures.slice(0, 60).forEach((f) => { reach(f.points); round(f, (c, r) => { size = Math.max(size, r + Math.hypot(c[0] - middle[0], c[1] - middle[1], c[2] - middle[2])); }); });
  frame = { middle, size: size || 1, half: [0, 1].map((k) => 0.5 * (hi[k] - lo[k]) || size || 1) };
}
function project(points, width, height, count = N) {
  const m = state.turn, [cx, cy, cz] = frame.middle;
  // In the plane what is wide fills the width; in space a figure may turn.
  const room = flat ? Math.min(0.44 * width / frame.half[0], 0.38 * height / frame.half[1]) : 0.47 * Math.min(width, height) / frame.size;
  const scale = room * state.zoom;
  const x0 = width / 2 + state.shift[0], y0 = height / 2 + state.shift[1] - 8;
  const x = new Float64Array(count), y = new Float64Array(count), z = new Float64Array(count);
  for (let i = 0; i < count; i++) {
    const a = points[3 * i] - cx, b = points[3 * i + 1] - cy, c = points[3 * i + 2] - cz;
    x[i] = x0 + scale * (m[0] * a + m[1] * b + m[2] * c);
    y[i] = y0 - scale * (m[3] * a + m[4] * b + m[5] * c);
    z[i] = (m[6] * a + m[7] * b + m[8] * c) / frame.size; // towards the viewer
  }
  return { x, y, z, scale };
}
function size(canvas) {
  const ratio = Math.min(window.devicePixelRatio || 1, 2.5);
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return [width, height];
}
function lines(p, colour, width, pen = view.getContext("2d"), cap = "round") {
  pen.strokeStyle = colour; pen.lineWidth = width; pen.lineCap = cap; pen.lineJoin = "round";
  pen.beginPath();
  for (const { ends: [a, b] } of data.bars) { pen.moveTo(p.x[a], p.y[a]); pen.lineTo(p.x[b], p.y[b]); }
  pen.stroke();
}
// Lines, planes, circles, spheres and arcs. A sphere is seen as its circle whichever way it is turned.
function outlines(figure, width, height, colour, wide, pen = view.getContext("2d")) {
  figure.outlines.forEach((numbers, k) => {
    if (!numbers.length) return;
    const kind = data.shapes[k].kind, p = project(numbers, width, height, Math.floor(numbers.length / 3));
    pen.save(); pen.strokeStyle = colour; pen.fillStyle = colour; pen.lineWidth = wide; pen.lineCap = "round"; pen.beginPath();
    if (kind === "line") { pen.setLineDash([7, 4]); pen.lineWidth = 1; pen.moveTo(p.x[0], p.y[0]); pen.lineTo(p.x[1], p.y[1]); }
    else if (kind === "plane") {
      pen.lineWidth = 1; for (let i = 0; i < 4; i++) pen.lineTo(p.x[i], p.y[i]);
      pen.closePath(); pen.save(); pen.globalAlpha *= 0.08; pen.fill(); pen.restore(); pen.globalAlpha *= 0.5;
    } else if (kind === "arc") {
      const at = (i) => Math.atan2(p.y[i] - p.y[0], p.x[i] - p.x[0]);
      // A negative radius: it goes clockwise.
      pen.arc(p.x[0], p.y[0], Math.hypot(p.x[1] - p.x[0], p.y[1] - p.y[0]), at(1), at(2), numbers[9] >= 0);
    } else {
      pen.arc(p.x[0], p.y[0], Math.max(0, numbers[3] * p.scale), 0, 2 * Math.PI);
      if (kind === "sphere") { pen.save(); pen.globalAlpha *= 0.08; pen.fill(); pen.restore(); }
    }
    pen.stroke(); pen.restore();
  });
}
function colourNow() {
  if (state.at === null) {
    const figure = data.figures[state.figure];
    return figure.class === null ? css("--ink") : classColour(figure.class);
  }
  return css("--accent");
}
function lengthOf(bar, points) {
  const [a, b] = bar.ends, d = (k) => points[3 * a + k] - points[3 * b + k];
  return Math.hypot(d(0), d(1), d(2));
}
// All figures at once, kept until they are seen from elsewhere: the slider moves one figure before them.
const crowd = document.createElement("canvas");
let crowdOf = "";
function drawAll(width, height, ghost) {
  const key = [view.width, view.height, state.turn, state.zoom, state.shift, state.filter, state.dark].join();
  if (key !== crowdOf) {
    crowdOf = key; crowd.width = view.width; crowd.height = view.height;
    const at = crowd.getContext("2d");
    at.setTransform(view.width / width, 0, 0, view.height / height, 0, 0);
    // Lines of one pixel of the screen, without round ends, are drawn several times as fast as others.
    const thin = width / view.width;
    at.globalAlpha = Math.max(0.05, Math.min(0.5, 6 / data.figures.length));
    for (const k of shown()) {
      const figure = data.figures[k];
      const colour = figure.class === null ? ghost : classColour(figure.class);
      outlines(figure, width, height, colour, thin, at); lines(project(figure.points, width, height), colour, thin, at, "butt");
    }
  }
  pen.drawImage(crowd, 0, 0, width, height);
}
function drawView() {
  const [width, height] = size(view);
  if (!width || !height || !data.figures.length) return;
  if (!frame) fit();
  const ink = css("--ink"), soft = css("--soft"), panel = css("--panel"), ghost = css("--ghost");
  if (state.show.all) drawAll(width, height, ghost);
  const drawn = data.figures.find((f) => f.kind === "sketch");
  // A path from another sketch than the page's begins with its own.
  const sketch = path && path.has_own_sketch && data.figures[state.figure] !== drawn ? between(0) : drawn;
  if (state.show.ghost && sketch && (state.at !== null || data.figures[state.figure] !== sketch)) {
    pen.setLineDash([5, 5]); pen.globalAlpha = 0.75;
    outlines(sketch, width, height, ghost, 1.3); lines(project(sketch.points, width, height), ghost, 1.3);
    pen.setLineDash([]); pen.globalAlpha = 1;
  }
  const now = current(), p = project(now.points, width, height), colour = colourNow();
  outlines(now, width, height, colour, 2);
  const things = [];
  if (state.show.faces) for (const f of faces) things.push([(p.z[f[0]] + p.z[f[1]] + p.z[f[2]]) / 3 - 0.02, 0, f]);
  data.bars.forEach((bar) => things.push([(p.z[bar.ends[0]] + p.z[bar.ends[1]]) / 2, 1, bar]));
  for (let i = 0; i < N; i++) things.push([p.z[i] + 0.01, 2, i]);
  things.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const near = (z) => flat ? 1 : 0.62 + 0.38 * Math.max(-1, Math.min(1, z));
  const bold = Math.max(1, Math.min(1, 160 / data.bars.length) * 3.2), dot = Math.max(1.6, Math.min(5, 120 / N + 2));
  for (const [z, kind, it] of things) {
    if (kind === 0) {
      pen.globalAlpha = +css("--face"); pen.fillStyle = colour; pen.beginPath();
      pen.moveTo(p.x[it[0]], p.y[it[0]]); pen.lineTo(p.x[it[1]], p.y[it[1]]); pen.lineTo(p.x[it[2]], p.y[it[2]]); pen.fill();
    } else if (kind === 1) {
      const [a, b] = it.ends;
      pen.globalAlpha = Math.max(0.3, near(z)); pen.lineCap = "round";
      if (!flat) { pen.strokeStyle = panel; pen.lineWidth = bold * near(z) + 2.5; stroke(p, a, b); }
      pen.strokeStyle = colour; pen.lineWidth = bold * near(z); stroke(p, a, b);
    } else {
      pen.globalAlpha = Math.max(0.45, near(z));
      pen.fillStyle = panel; pen.strokeStyle = ink; pen.lineWidth = 1.6;
      pen.beginPath(); pen.arc(p.x[it], p.y[it], dot * (0.6 + 0.4 * near(z)), 0, 2 * Math.PI); pen.fill(); pen.stroke();
    }
  }
  pen.globalAlpha = 1;
  const taken = [];
  const write = (text, x, y, colour, font, must) => {
    pen.font = font;
    const w = pen.measureText(text).width, box = [x - w / 2 - 2, y - 8, x + w / 2 + 2, y + 8];
    if (!must && taken.some((b) => b[0] < box[2] && b[2] > box[0] && b[1] < box[3] && b[3] > box[1])) return;
    taken.push(box);
    // A bar does not strike its own dimension through.
    if (!must) { pen.globalAlpha = 0.85; pen.fillStyle = panel; pen.fillRect(x - w / 2 - 2, y - 7, w + 4, 14); pen.globalAlpha = 1; }
    pen.textAlign = "center"; pen.textBaseline = "middle"; pen.lineJoin = "round";
    pen.strokeStyle = panel; pen.lineWidth = 4; pen.strokeText(text, x, y);
    pen.fillStyle = colour; pen.fillText(text, x, y);
  };
  let mx = 0, my = 0;
  for (let i = 0; i < N; i++) { mx += p.x[i] / N; my += p.y[i] / N; }
  if (state.show.names) for (let i = 0; i < N; i++) {
    const dx = p.x[i] - mx, dy = p.y[i] - my, r = Math.hypot(dx, dy) || 1;
    write(data.points[i], p.x[i] + 15 * dx / r, p.y[i] + 14 * dy / r, ink, "600 13px system-ui, 'DejaVu Sans', sans-serif", N <= 40);
  }
  if (state.show.sizes) for (const { text, was, points } of data.labels) {
    const mean = (v) => points.reduce((sum, k) => sum + v[k], 0) / points.length;
    write(now.kind === "sketch" && was ? was : text, mean(p.x), mean(p.y) + (points.length === 1 ? 16 : 0), soft, "12px system-ui, 'DejaVu Sans', sans-serif", false);
  }
  if (state.show.sizes) for (const bar of data.bars) {
    if (!bar.label) continue;
    const [a, b] = bar.ends, is = lengthOf(bar, now.points);
    const off = bar.target !== null && Math.abs(is - bar.target) > 2e-4 * bar.target;
    write(off ? short(+is.toPrecision(4)) + " → " + bar.label : bar.label, (p.x[a] + p.x[b]) / 2, (p.y[a] + p.y[b]) / 2,
      off ? css("--warn") : soft, "12px system-ui, 'DejaVu Sans', sans-serif", false);
  }
}
function stroke(p, a, b) { pen.beginPath(); pen.moveTo(p.x[a], p.y[a]); pen.lineTo(p.x[b], p.y[b]); pen.stroke(); }

// ---- the chart: t along the path
const chart = $("chart");
let area = null;
function drawChart() {
  if (!path) return;
  const [width, height] = size(chart), pen = chart.getContext("2d");
  if (!width || !height) return;
  const left = 34, right = 10, top = 10, bottom = 18;
  let lo = Infinity, hi = -Infinity;
  for (const s of samples) { lo = Math.min(lo, s.t); hi = Math.max(hi, s.t); }
  for (const level of path.levels) { lo = Math.min(lo, level.t); hi = Math.max(hi, level.t); }
  // A path that runs off is not shown all the way: what matters is near the levels.
  if (path.levels.length > 1) {
    const levels = path.levels.map((level) => level.t), low = Math.min(...levels), high = Math.max(...levels), far = 4 * (high - low);
    if (far > 0) { lo = Math.max(lo, low - far); hi = Math.min(hi, high + far); }
  }
  const room = 0.08 * (hi - lo || 1); lo -= room; hi += room;
  const [from, to] = state.span || [start, last];
  const x = (at) => left + (width - left - right) * (at - from) / (to - from || 1);
  const y = (t) => top + (height - top - bottom) * (hi - t) / (hi - lo);
  area = { left, right, width, from, to };
  const visible = (at) => at >= from && at <= to;
  pen.font = "12px system-ui, 'DejaVu Sans', sans-serif"; pen.textBaseline = "middle";
  for (const level of path.levels) {
    pen.strokeStyle = css("--line"); pen.setLineDash([4, 4]); pen.lineWidth = 1;
    pen.beginPath(); pen.moveTo(left, y(level.t)); pen.lineTo(width - right, y(level.t)); pen.stroke(); pen.setLineDash([]);
    pen.fillStyle = css("--soft"); pen.textAlign = "right"; pen.fillText(level.label, left - 6, y(level.t));
  }
  pen.textAlign = "left"; pen.fillStyle = css("--soft"); pen.fillText(path.along, left, height - 7);
  pen.save(); pen.beginPath(); pen.rect(left - 7, 0, width - left - right + 14, height); pen.clip();
  pen.strokeStyle = css("--ink"); pen.lineWidth = data.figures.length > 60 && !state.span ? 1 : 1.6; pen.lineJoin = "round"; pen.beginPath();
  samples.forEach((s, k) => k ? pen.lineTo(x(s.at), y(s.t)) : pen.moveTo(x(s.at), y(s.t)));
  pen.stroke();
  const marks = path.marks.filter((m) => visible(m.at));
  for (const mark of marks.length > 150 ? [] : marks) {
    pen.fillStyle = css("--warn"); pen.beginPath();
    const px = x(mark.at), py = y(mark.t), s = marks.length > 60 ? 2 : 3.6;
    pen.moveTo(px, py - s); pen.lineTo(px + s, py); pen.lineTo(px, py + s); pen.lineTo(px - s, py); pen.fill();
  }
  const many = data.figures.filter((f) => onPath(f) && visible(f.at)).length > 60;
  data.figures.forEach((figure, k) => {
    if (!onPath(figure) || figure.t === null || !visible(figure.at)) return;
    const big = many ? 2.4 : 5;
    pen.beginPath(); pen.arc(x(figure.at), y(figure.t), k === state.figure && state.at === null ? big + 2 : big, 0, 2 * Math.PI);
    pen.fillStyle = figure.class === null ? css("--ghost") : classColour(figure.class); pen.fill();
    pen.strokeStyle = css("--panel"); pen.lineWidth = 1.2; pen.stroke();
  });
  const at = place();
  if (at !== null && visible(at)) {
    pen.strokeStyle = css("--accent"); pen.lineWidth = 1.5;
    pen.beginPath(); pen.moveTo(x(at), top - 4); pen.lineTo(x(at), height - bottom + 4); pen.stroke();
    pen.fillStyle = css("--accent"); pen.beginPath(); pen.arc(x(at), y(state.at === null ? data.figures[state.figure].t ?? between(at).t : between(at).t), 4.5, 0, 2 * Math.PI); pen.fill();
  }
  pen.restore();
}

// ---- the accuracy along the path: powers of ten of proved bounds
function drawAccuracy() {
  const nearness = path && path.accuracy;
  if (!nearness || !area || !$("how-near").open) return;
  const canvas = $("accuracy"), [width, height] = size(canvas), pen = canvas.getContext("2d");
  if (!width || !height) return;
  const power = (x) => Math.log10(Math.max(x, 1e-18));
  const drawn = nearness.figures.filter((x, k) => x !== null && onPath(data.figures[k]));
  const all = nearness.samples.concat(drawn).map(power);
  let lo = Math.floor(all.reduce((a, b) => Math.min(a, b), 0)) - 0.5, hi = Math.ceil(all.reduce((a, b) => Math.max(a, b), -18)) + 0.5;
  const { left, right, from, to } = area, top = 6, bottom = 6;
  const x = (at) => left + (width - left - right) * (at - from) / (to - from || 1);
  const y = (bound) => top + (height - top - bottom) * (hi - power(bound)) / (hi - lo);
  const visible = (at) => at >= from && at <= to;
  pen.font = "11px system-ui, 'DejaVu Sans', sans-serif"; pen.textBaseline = "middle"; pen.textAlign = "right";
  for (let k = Math.ceil(lo / 4) * 4; k <= hi; k += 4) {
    const level = 10 ** k;
    pen.strokeStyle = css("--line"); pen.lineWidth = 1; pen.setLineDash([4, 4]);
    pen.beginPath(); pen.moveTo(left, y(level)); pen.lineTo(width - right, y(level)); pen.stroke(); pen.setLineDash([]);
    pen.fillStyle = css("--soft"); pen.fillText("1e" + k, left - 4, y(level));
  }
  pen.save(); pen.beginPath(); pen.rect(left - 7, 0, width - left - right + 14, height); pen.clip();
  pen.strokeStyle = css("--ink"); pen.lineWidth = 1.3; pen.beginPath();
  samples.forEach((s, k) => k ? pen.lineTo(x(s.at), y(nearness.samples[k])) : pen.moveTo(x(s.at), y(nearness.samples[k])));
  pen.stroke();
  data.figures.forEach((figure, k) => {
    const bound = nearness.figures[k];
    if (!onPath(figure) || bound === null || bound === undefined || !visible(figure.at)) return;
    pen.beginPath(); pen.arc(x(figure.at), y(bound), k === state.figure && state.at === null ? 5.5 : 3.5, 0, 2 * Math.PI);
    pen.fillStyle = figure.class === null ? css("--ghost") : classColour(figure.class); pen.fill();
  });
  const at = place();
  if (at !== null && visible(at)) {
    pen.strokeStyle = css("--accent"); pen.lineWidth = 1.5;
    pen.beginPath(); pen.moveTo(x(at), 0); pen.lineTo(x(at), height); pen.stroke();
  }
  pen.restore();
}
function place() {
  if (state.at !== null) return state.at;
  const figure = data.figures[state.figure];
  return figure && onPath(figure) ? figure.at : null;
}

// ---- words
function el(tag, text, parent) { const e = document.createElement(tag); if (text !== null) e.textContent = text; if (parent) parent.append(e); return e; }
function says() {
  const figure = data.figures[state.figure], caption = $("caption");
  caption.textContent = "";
  if (state.at !== null) {
    const now = between(state.at);
    el("span", "On the path, " + path.parameter + " = " + now.t.toFixed(4), caption);
    const passed = path.marks.filter((m) => m.at < state.at).length;
    el("small", passed === 0 ? "no fold since the sketch" : passed === 1 ? "1 fold since the sketch" : passed + " folds since the sketch", caption);
  } else if (figure) {
    el("span", figure.name, caption); el("small", figure.note, caption);
  }
  view.setAttribute("aria-label", caption.textContent);
  const at = place();
  if (path && at !== null) {
    $("slider").value = String(at);
    const t = state.at === null && figure && figure.t !== null ? figure.t : between(at).t;
    $("where").textContent = path.parameter + " = " + t.toFixed(4);
  } else if (path) $("where").textContent = "";
  const table = $("digits"); table.textContent = "";
  if (state.at === null && figure && figure.digits) {
    const body = el("table", null, table);
    figure.digits.forEach((row, k) => {
      const tr = el("tr", null, body); el("th", data.points[k], tr);
      row.forEach((x) => el("td", x, tr));
    });
    el("p", data.digits, table);
  } else el("p", "Choose a figure of the list.", table);
}
function shown() {
  const seen = new Set();
  return data.figures.map((f, k) => k).filter((k) => {
    const f = data.figures[k];
    if (state.filter === "all" || f.kind === "sketch") return true;
    if (state.filter === "straight") return f.folds === 0;
    if (seen.has(f.class)) return false;
    seen.add(f.class);
    return true;
  });
}
function fillList() {
  const list = $("list"); list.textContent = "";
  for (const k of shown()) {
    const f = data.figures[k], li = el("li", null, list);
    li.setAttribute("role", "option"); li.setAttribute("aria-selected", false); li.dataset.k = k; li.id = "figure-" + k;
    el("i", "", li).style.background = f.class === null ? css("--ghost") : classColour(f.class);
    el("span", f.name, li); el("small", f.note, li);
  }
  mark();
}
let marked = null;
function mark() {
  const li = state.at === null ? $("figure-" + state.figure) : null;
  if (marked && marked !== li) marked.setAttribute("aria-selected", false);
  if (li) { li.setAttribute("aria-selected", true); $("list").setAttribute("aria-activedescendant", li.id); }
  marked = li;
}
function reveal() {
  const li = $("figure-" + state.figure), list = $("list");
  if (!li) return;
  const top = li.offsetTop - list.offsetTop;
  if (top < list.scrollTop) list.scrollTop = top - 4;
  else if (top + li.offsetHeight > list.scrollTop + list.clientHeight) list.scrollTop = top + li.offsetHeight - list.clientHeight + 4;
}

// ---- what people do
let asked = false;
function redraw() { if (!asked) { asked = true; requestAnimationFrame(() => { asked = false; drawView(); drawChart(); drawAccuracy(); }); } }
function pick(k) { stop(); state.figure = k; travel(data.figures[k].path ?? only); state.at = null; says(); mark(); reveal(); redraw(); }
function go(at) { state.at = Math.min(last, Math.max(start, at)); says(); mark(); redraw(); }
function stop() { state.playing = false; $("play").textContent = "▶"; $("play").setAttribute("aria-label", "Play"); }
function play() {
  if (!path) return;
  if (state.playing) return stop();
  state.playing = true; $("play").textContent = "❚❚"; $("play").setAttribute("aria-label", "Pause");
  let at = place() ?? start, before = null;
  if (at >= last) at = start;
  // All of it in 20 seconds, or about a second for each solution.
  const speed = (last - start) / Math.max(14, Math.min(240, data.figures.length * 1.5));
  const step = (clock) => {
    if (!state.playing) return;
    if (before !== null) at += speed * Math.min(0.1, (clock - before) / 1000);
    before = clock;
    if (at >= last) { go(last); return stop(); }
    go(at); requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}
function toggle(what) { state.show[what] = !state.show[what]; buttons(); redraw(); }
function buttons() { document.querySelectorAll("[data-show]").forEach((b) => b.setAttribute("aria-pressed", state.show[b.dataset.show])); }
function reset() { state.turn = identity(); state.zoom = 1; state.shift = [0, 0]; redraw(); }
function theme(dark) { state.dark = dark; document.documentElement.dataset.theme = dark ? "dark" : "light"; fillList(); redraw(); }
function neighbour(step) {
  const all = shown(), k = all.indexOf(state.figure);
  pick(all[Math.min(all.length - 1, Math.max(0, (k < 0 ? 0 : k) + step))]);
}

const pointers = new Map();
view.addEventListener("pointerdown", (e) => { view.setPointerCapture(e.pointerId); pointers.set(e.pointerId, [e.clientX, e.clientY]); view.focus({ preventScroll: true }); });
view.addEventListener("pointermove", (e) => {
  const before = pointers.get(e.pointerId);
  if (!before) return;
  const dx = e.clientX - before[0], dy = e.clientY - before[1];
  if (pointers.size === 2) {
    const other = [...pointers.entries()].find(([id]) => id !== e.pointerId)[1];
    const from = Math.hypot(before[0] - other[0], before[1] - other[1]), to = Math.hypot(e.clientX - other[0], e.clientY - other[1]);
    if (from > 0) zoomBy(to / from);
    state.shift[0] += dx / 2; state.shift[1] += dy / 2;
  } else if (flat || e.shiftKey || e.buttons === 4) { state.shift[0] += dx; state.shift[1] += dy; }
  else state.turn = multiply(multiply(about(0, dy * 0.008), about(1, dx * 0.008)), state.turn);
  pointers.set(e.pointerId, [e.clientX, e.clientY]);
  redraw();
});
for (const end of ["pointerup", "pointercancel"]) view.addEventListener(end, (e) => pointers.delete(e.pointerId));
function zoomBy(f) { state.zoom = Math.min(200, Math.max(0.05, state.zoom * f)); redraw(); }
view.addEventListener("wheel", (e) => { e.preventDefault(); zoomBy(Math.exp(-e.deltaY * (e.deltaMode ? 0.05 : 0.0015))); }, { passive: false });
view.addEventListener("dblclick", reset);
$("slider").addEventListener("input", (e) => { stop(); go(+e.target.value); });
$("play").addEventListener("click", play);
$("reset").addEventListener("click", reset);
$("theme").addEventListener("click", () => theme(!state.dark));
document.querySelectorAll("[data-show]").forEach((b) => b.addEventListener("click", () => toggle(b.dataset.show)));
$("list").addEventListener("click", (e) => { const li = e.target.closest("li"); if (li) pick(+li.dataset.k); });
function chartAt(e) {
  const box = chart.getBoundingClientRect(), u = (e.clientX - box.left - area.left) / (area.width - area.left - area.right);
  const at = area.from + (area.to - area.from) * u, reach = 7 * (area.to - area.from) / (area.width - area.left - area.right);
  let best = -1;
  data.figures.forEach((f, k) => { if (onPath(f) && Math.abs(f.at - at) < reach && (best < 0 || Math.abs(f.at - at) < Math.abs(data.figures[best].at - at))) best = k; });
  if (best >= 0 && e.type === "pointerdown") pick(best); else { stop(); go(at); }
}
chart.addEventListener("pointerdown", (e) => { chart.setPointerCapture(e.pointerId); if (area) chartAt(e); });
chart.addEventListener("pointermove", (e) => { if (e.buttons && area) chartAt(e); });
chart.addEventListener("wheel", (e) => {
  if (!area) return;
  e.preventDefault();
  const box = chart.getBoundingClientRect(), u = (e.clientX - box.left - area.left) / (area.width - area.left - area.right);
  const middle = area.from + (area.to - area.from) * u, f = Math.exp(e.deltaY * (e.deltaMode ? 0.05 : 0.0015));
  const width = Math.max((last - start) / 2000, (area.to - area.from) * f);
  const from = Math.min(Math.max(start, middle - u * width), Math.max(start, last - width));
  state.span = width >= last - start ? null : [from, from + width];
  redraw();
}, { passive: false });
chart.addEventListener("dblclick", () => { state.span = null; redraw(); });
document.addEventListener("keydown", (e) => {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  const tag = e.target.tagName, key = e.key;
  if (key === " " && (tag === "BUTTON" || tag === "SUMMARY")) return;
  if (tag === "INPUT" && key.startsWith("Arrow")) return;
  const step = (last - start) / 200 * (e.shiftKey ? 5 : 1);
  const does = {
    ArrowRight: () => path && go((place() ?? start) + step), ArrowLeft: () => path && go((place() ?? start) - step),
    ArrowDown: () => neighbour(1), ArrowUp: () => neighbour(-1), " ": play, "+": () => zoomBy(1.2), "=": () => zoomBy(1.2), "-": () => zoomBy(1 / 1.2),
    r: reset, n: () => toggle("names"), d: () => toggle("sizes"), f: () => toggle("faces"), g: () => toggle("ghost"), a: () => toggle("all"), t: () => theme(!state.dark),
  }[key.length === 1 ? key.toLowerCase() : key];
  if (does && (!key.startsWith("Arrow") || tag !== "SUMMARY")) { stop0(key); does(); e.preventDefault(); }
});
function stop0(key) { if (key !== " " && key.startsWith("Arrow")) stop(); }

// ---- begin
$("title").textContent = data.title;
$("badge").textContent = data.badge; $("badge").classList.add(data.tone);
$("verdict").textContent = data.verdict;
for (const paragraph of data.text) {
  if (Array.isArray(paragraph)) { const ol = el("ol", null, $("text")); paragraph.forEach((x) => el("li", x, ol)); }
  else el("p", paragraph, $("text"));
}
for (const [label, value] of data.rows) { const tr = el("tr", null, $("rows")); el("th", label, tr); el("td", value, tr); }
const classes = new Set(data.figures.filter((f) => f.class !== null).map((f) => f.class));
const solutions = data.figures.filter((f) => f.class !== null).length;
const filters = [["all", "All " + solutions]];
if (classes.size && classes.size < solutions) filters.push(["classes", classes.size + " up to congruence"]);
if (data.figures.some((f) => f.folds === 0)) filters.push(["straight", "No fold"]);
for (const [name, text] of filters.length > 1 ? filters : []) {
  const b = el("button", text, $("filters")); b.type = "button"; b.setAttribute("aria-pressed", name === "all");
  b.addEventListener("click", () => {
    state.filter = name;
    for (const other of $("filters").children) other.setAttribute("aria-pressed", other === b);
    fillList(); redraw();
  });
}
$("filters").hidden = filters.length < 2;
$("travel").hidden = true;
if (!faces.length) document.querySelector('[data-show="faces"]').hidden = true;
if (!data.figures.some((f) => f.kind === "sketch")) document.querySelector('[data-show="ghost"]').hidden = true;
if (data.figures.length < 2) document.querySelector('[data-show="all"]').hidden = true;
buttons();
theme(window.matchMedia && window.matchMedia("(prefers-color-scheme: dark)").matches);
const first = data.figures.findIndex((f) => f.folds === 0), any = data.figures.findIndex((f) => f.class !== null);
if (data.figures.length) pick(first >= 0 ? first : any >= 0 ? any : 0);
new ResizeObserver(redraw).observe(view);
new ResizeObserver(redraw).observe(chart);
$("how-near").addEventListener("toggle", redraw);
})();
