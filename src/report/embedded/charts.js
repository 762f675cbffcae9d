// Charts that answer: values under the pointer, zoom by dragging, the whole again by a double click. Everything is read off the drawing itself
// (svg_plot.cpp says in data attributes what its axes are), so that a page holds no number twice; without this script charts stay as drawn.
"use strict";
(() => {
const space = "http://www.w3.org/2000/svg";
const make = (parent, tag, settings, text) => {
  const made = parent.appendChild(document.createElementNS(space, tag));
  for (const [key, value] of Object.entries(settings)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
};
const number = (text) => Number(String(text).replace("−", "-"));
const unitOf = (title) => (/\(([^()]*)\)$/.exec(title) || ["", ""])[1];
const shown = (value, decimals) => value.toFixed(Math.max(0, Math.min(12, decimals))).replace(/^-(?=0\.?0*$)/, "").replace("-", "−");

// From pixels of the drawing to what the axis shows there. A time axis with static steps between has several pieces, each with its own start.
class Axis {
  constructor(plot, key, from, to, spans) {
    const [low, high, log, size] = plot.dataset[key].split(" ").map(Number);
    Object.assign(this, {from, to, log: log === 1, low: low / size, high: high / size, title: plot.dataset[key + "Title"] || ""});
    this.unit = unitOf(this.title);
    const ticks = JSON.parse(plot.dataset[key + "Ticks"] || "[]").map(([at, label]) => [at, number(label)]).filter(([, v]) => Number.isFinite(v));
    const slope = ticks.length > 1 ? null : (this.high - this.low) / (to - from);
    this.pieces = [];
    if (!plot.dataset[key + "Ticks"]) this.pieces.push({from: Math.min(from, to), to: Math.max(from, to), at: from, value: this.low, slope});
    else {
      // Between static steps; without a tick of its own nothing can be told there.
      const walls = [[from, from], ...spans, [to, to]];
      for (let i = 0; i + 1 < walls.length; ++i) {
        const piece = {from: walls[i][1], to: walls[i + 1][0]}, own = ticks.filter(([at]) => at >= piece.from - 1 && at <= piece.to + 1);
        if (piece.to > piece.from && own.length > 1) {
          const [a, b] = [own[0], own[own.length - 1]];
          this.pieces.push({...piece, at: a[0], value: a[1], slope: (b[1] - a[1]) / (b[0] - a[0])});
        }
      }
    }
  }

  // The value at a pixel, and how many decimals a tenth of a pixel is worth; null where there is none.
  read(pixel) {
    if (this.log) {
      const value = this.low * (this.high / this.low) ** ((pixel - this.from) / (this.to - this.from));
      return {value, text: String(Number(value.toPrecision(3)))};
    }
    const piece = this.pieces.find((p) => pixel >= p.from - 0.5 && pixel <= p.to + 0.5);
    if (!piece) return null;
    const value = piece.value + (pixel - piece.at) * piece.slope;
    return {value, text: shown(value, Math.round(-Math.log10(Math.abs(piece.slope) * 0.2)))};
  }

  // Ticks of the part of the axis between two pixels: pixel and label.
  ticks(a, b, count) {
    const result = [], nice = (x) => { const p = 10 ** Math.floor(Math.log10(x)); return p * [1, 2, 5, 10].find((m) => m * p >= 0.999 * x); };
    if (this.log) {
      const [low, high] = [this.read(a).value, this.read(b).value].sort((x, y) => x - y), decades = Math.log10(high / low);
      if (decades < 0.5) {
        const step = nice((high - low) / count);
        for (let v = Math.ceil(low / step) * step; v <= high; v += step) result.push(v);
      } else
        for (let p = Math.floor(Math.log10(low)); p <= Math.log10(high); ++p)
          for (const m of decades < 2.1 ? [1, 2, 5] : [1]) if (m * 10 ** p >= low && m * 10 ** p <= high) result.push(m * 10 ** p);
      return result.map((v) => [this.from + Math.log(v / this.low) / Math.log(this.high / this.low) * (this.to - this.from), String(Number(v.toPrecision(4)))]);
    }
    for (const p of this.pieces) {
      const ends = [Math.max(p.from, Math.min(a, b)), Math.min(p.to, Math.max(a, b))];
      if (ends[1] <= ends[0]) continue;
      const step = nice(Math.abs(p.slope) * Math.abs(b - a) / count), decimals = Math.ceil(-Math.log10(step) - 1e-9);
      const [low, high] = ends.map((e) => p.value + (e - p.at) * p.slope).sort((x, y) => x - y);
      for (let k = Math.ceil(low / step - 1e-6); k * step <= high * (1 + 1e-9) + 1e-6 * step; ++k)
        result.push([p.at + (k * step - p.value) / p.slope, shown(k * step, decimals)]);
    }
    return result;
  }
}

// "M1 2L3 4 5 6M...z" as pieces of points; H and V become points.
function piecesOf(d) {
  const pieces = [];
  let piece = null, x = 0, y = 0;
  for (const [, command, numbers] of d.matchAll(/([MLHVz])([^MLHVz]*)/g)) {
    const v = numbers.trim() ? numbers.trim().split(/[ ,]+/).map(Number) : [];
    if (command === "z") { if (piece) piece.isClosed = true; continue; }
    if (command === "M") pieces.push(piece = {points: [], isClosed: false});
    if (command === "H") { x = v[0]; piece.points.push([x, y]); }
    else if (command === "V") { y = v[0]; piece.points.push([x, y]); }
    else for (let i = 0; i + 1 < v.length; i += 2) { [x, y] = [v[i], v[i + 1]]; piece.points.push([x, y]); }
  }
  return pieces;
}

class Chart {
  constructor(plot) {
    this.plot = plot;
    this.svg = plot.ownerSVGElement;
    [this.left, this.top, this.width, this.height] = plot.getAttribute("viewBox").split(" ").map(Number);
    const spans = [...plot.querySelectorAll("rect.span")].map((r) => [Number(r.getAttribute("x")), Number(r.getAttribute("x")) + Number(r.getAttribute("width")), r.dataset.name]);
    this.spans = spans;
    this.x = new Axis(plot, "x", this.left, this.left + this.width, spans);
    this.y = new Axis(plot, "y", this.top + this.height, this.top, []);
    this.paths = [...plot.querySelectorAll("path:not(.grid)")].map((path) => ({path, d: path.getAttribute("d"), pieces: piecesOf(path.getAttribute("d"))}));
    this.placed = [...plot.querySelectorAll("circle, text, rect")].map((e) =>
      ({e, at: ["x", "y", "cx", "cy", "width", "height"].map((name) => [name, e.getAttribute(name)]).filter(([, v]) => v !== null)}));
    this.series = this.paths.filter(({path}) => path.classList.contains("line")).map((p) => ({name: p.path.dataset.name, color: p.path.getAttribute("stroke"), pieces: p.pieces}));
    this.isFunction = this.series.every((s) => s.pieces.every(({points}) => points.every((p, i) => i === 0 || p[0] >= points[i - 1][0] - 0.05)));
    this.areas = this.paths.filter(({path}) => path.classList.contains("area"))
      .map((p) => ({name: p.path.dataset.name, color: p.path.getAttribute("fill"), pieces: p.pieces})).reverse();
    this.over = make(this.svg, "g", {"pointer-events": "none"});
    this.reset();
    this.svg.style.touchAction = "pan-y";
    this.svg.addEventListener("pointermove", (e) => this.move(e));
    this.svg.addEventListener("pointerdown", (e) => this.press(e));
    this.svg.addEventListener("pointerup", (e) => this.release(e));
    this.svg.addEventListener("pointerleave", () => { if (!this.from) this.clear(); });
    this.svg.addEventListener("dblclick", () => this.reset());
  }

  reset() {
    this.window = [this.left, this.left + this.width, this.top, this.top + this.height];
    this.draw();
  }

  // Places of the drawing as they stand in the window, and back.
  toX(x) { return this.left + (x - this.window[0]) / (this.window[1] - this.window[0]) * this.width; }
  toY(y) { return this.top + (y - this.window[2]) / (this.window[3] - this.window[2]) * this.height; }
  fromX(x) { return this.window[0] + (x - this.left) / this.width * (this.window[1] - this.window[0]); }
  fromY(y) { return this.window[2] + (y - this.top) / this.height * (this.window[3] - this.window[2]); }

  draw() {
    const [a, b, c, d] = this.window, isWhole = b - a > this.width - 0.01 && d - c > this.height - 0.01;
    const place = (v) => Math.round(10 * Math.max(-1e5, Math.min(1e5, v))) / 10;
    for (const {path, d: whole, pieces} of this.paths)
      path.setAttribute("d", isWhole ? whole : pieces.map((p) => "M" + p.points.map(([x, y]) => place(this.toX(x)) + " " + place(this.toY(y))).join("L") + (p.isClosed ? "z" : "")).join(""));
    for (const {e, at} of this.placed)
      for (const [name, v] of at) {
        const n = Number(v);
        e.setAttribute(name, isWhole ? v : name === "width" ? n * this.width / (b - a) : name === "height" ? n * this.height / (d - c)
          : name.endsWith("x") ? place(this.toX(n)) : place(this.toY(n)));
      }
    for (const e of this.svg.querySelectorAll(".tick, .grid")) e.style.display = isWhole ? "" : "none";
    this.own && this.own.forEach((e) => e.remove());
    this.own = [];
    if (isWhole) return;
    const grid = make(this.plot, "g", {stroke: "#dcdcdc", "stroke-width": 0.7});
    this.plot.prepend(grid);
    const labels = make(this.svg, "g", {fill: "#666666"});
    this.own.push(grid, labels);
    let free = -1e9;
    for (const [at, text] of this.x.ticks(a, b, 8)) {
      const x = this.toX(at);
      make(grid, "path", {d: `M${x} ${this.top}V${this.top + this.height}`});
      if (x < free || x > this.left + this.width + 1) continue;
      make(labels, "text", {x, y: this.top + this.height + 16, "text-anchor": "middle"}, text);
      free = x + 6.4 * text.length + 8;
    }
    for (const [at, text] of this.y.ticks(d, c, 5)) {
      const y = this.toY(at);
      make(grid, "path", {d: `M${this.left} ${y}H${this.left + this.width}`});
      make(labels, "text", {x: this.left - 6, y: y + 4, "text-anchor": "end"}, text);
    }
  }

  // The pointer in units of the drawing.
  at(event) {
    const m = this.svg.getScreenCTM(), p = new DOMPoint(event.clientX, event.clientY).matrixTransform(m.inverse());
    return [p.x, p.y];
  }
  isInside([x, y]) { return x >= this.left && x <= this.left + this.width && y >= this.top && y <= this.top + this.height; }

  clear() { this.over.replaceChildren(); }

  press(event) {
    const p = this.at(event);
    if (event.button !== 0 || event.pointerType === "touch" || !this.isInside(p)) return;
    event.preventDefault();
    this.from = p;
    hold(this.svg, event);
  }

  // What a drag from the point pressed encloses; a flat one takes the whole height.
  box(p) {
    const clamp = (v, low, size) => Math.max(low, Math.min(low + size, v));
    const xs = [this.from[0], p[0]].map((x) => clamp(x, this.left, this.width)).sort((u, v) => u - v);
    const ys = [this.from[1], p[1]].map((y) => clamp(y, this.top, this.height)).sort((u, v) => u - v);
    return ys[1] - ys[0] < 12 ? [...xs, this.top, this.top + this.height] : [...xs, ...ys];
  }

  release(event) {
    if (!this.from) return;
    const [a, b, c, d] = this.box(this.at(event));
    this.from = null;
    this.clear();
    // The drawing has a tenth of a pixel: beyond thirty times nothing more would show.
    const x = [this.fromX(a), this.fromX(b)], y = [this.fromY(c), this.fromY(d)];
    if (b - a < 8 || x[1] - x[0] < this.width / 30 || y[1] - y[0] < this.height / 30) return;
    this.window = [...x, ...y];
    this.draw();
  }

  move(event) {
    const p = this.at(event);
    this.clear();
    if (this.from) {
      const [a, b, c, d] = this.box(p);
      make(this.over, "rect", {x: a, y: c, width: b - a, height: d - c, fill: "#0072b2", "fill-opacity": 0.12, stroke: "#0072b2"});
      return;
    }
    if (!this.isInside(p)) return;
    const found = this.isFunction ? this.valuesAt(p) : this.nearest(p);
    if (found) this.show(p, found);
  }

  // One value of every line at the pointer's x.
  valuesAt(p) {
    const x = this.fromX(p[0]), rows = [], span = this.spans.find(([a, b]) => x >= a && x <= b);
    let best = null;
    for (const s of this.series)
      for (const {points} of s.pieces) {
        const near = nearestIn(points, x);
        if (near && Math.abs(near[0] - x) < 0.02 * this.width && (!best || Math.abs(near[0] - x) < Math.abs(best - x))) best = near[0];
      }
    if (best === null && !this.areas.length) return null;
    const place = best === null ? x : best;
    for (const s of this.series) {
      const y = heightAt(s.pieces, place);
      if (y !== null) rows.push({name: s.name, color: s.color, y, read: this.y.read(y)});
    }
    for (const s of this.areas) {
      const [high, low] = edgesAt(s.pieces, place);
      if (high === null) continue;
      const top = this.y.read(high), bottom = this.y.read(low);
      rows.push({name: s.name, color: s.color, y: high, read: {value: 0, text: top && bottom ? shown(top.value - bottom.value, (top.text.split(".")[1] || "").length) : ""}});
    }
    const value = this.x.read(place);
    return {x: place, rows, head: value ? this.head(value) : span ? span[2] : ""};
  }

  head(value) { return this.x.title.replace(/ ?\([^()]*\)$/, "") + " " + value.text + (this.x.unit ? " " + this.x.unit : ""); }

  // The point of a curve that turns back, as a loop.
  nearest(p) {
    const x = this.fromX(p[0]), y = this.fromY(p[1]);
    let best = null;
    for (const s of this.series)
      for (const {points} of s.pieces)
        for (const q of points) {
          const far = Math.hypot(this.toX(q[0]) - p[0], this.toY(q[1]) - p[1]);
          if (far < 25 && (!best || far < best.far)) best = {far, q, s};
        }
    return best && {x: best.q[0], head: this.head(this.x.read(best.q[0]) || {text: ""}),
                    rows: [{name: best.s.name, color: best.s.color, y: best.q[1], read: this.y.read(best.q[1])}]};
  }

  show(p, {x, rows, head}) {
    const at = this.toX(x), unit = this.y.unit ? " " + this.y.unit : "";
    make(this.over, "path", {d: `M${at} ${this.top}V${this.top + this.height}`, stroke: "#222222", "stroke-width": 0.8, "stroke-dasharray": "3 3"});
    const lines = [[head, "#222222"]];
    for (const r of rows) {
      const y = this.toY(r.y);
      if (y >= this.top - 1 && y <= this.top + this.height + 1) make(this.over, "circle", {cx: at, cy: y, r: 3.5, fill: r.color, stroke: "#ffffff"});
      if (r.read) lines.push([(r.name ? r.name + "  " : "") + r.read.text + unit, r.color]);
    }
    const wide = 26 + 6.6 * Math.max(...lines.map(([text]) => text.length)), high = 8 + 15 * lines.length;
    const left = at + wide + 12 < this.left + this.width ? at + 10 : at - wide - 10, top = Math.max(this.top, Math.min(p[1] - 0.5 * high, this.top + this.height - high));
    const box = make(this.over, "g", {class: "values"});
    make(box, "rect", {x: left, y: top, width: wide, height: high, rx: 3, fill: "#ffffff", "fill-opacity": 0.94, stroke: "#999999"});
    lines.forEach(([text, color], i) => {
      if (i > 0) make(box, "rect", {x: left + 7, y: top + 7 + 15 * i, width: 9, height: 9, fill: color});
      make(box, "text", {x: left + (i > 0 ? 20 : 7), y: top + 16 + 15 * i, fill: "#222222"}, text);
    });
  }
}

// A drag goes on beyond the edge. A pointer that is gone already cannot be held.
function hold(element, event) {
  try { element.setPointerCapture(event.pointerId); } catch { /* then it ends at the edge */ }
}

// Of points whose x rises the one nearest to x.
function nearestIn(points, x) {
  let a = 0, b = points.length - 1;
  if (b < 0) return null;
  while (b - a > 1) {
    const m = (a + b) >> 1;
    if (points[m][0] < x) a = m; else b = m;
  }
  return Math.abs(points[a][0] - x) < Math.abs(points[b][0] - x) ? points[a] : points[b];
}

function heightAt(pieces, x) {
  for (const {points} of pieces) {
    if (!points.length || x < points[0][0] - 0.05 || x > points[points.length - 1][0] + 0.05) continue;
    for (let i = 1; i < points.length; ++i) {
      const [p, q] = [points[i - 1], points[i]];
      if (Math.abs(p[0] - x) < 0.05) return p[1];
      if (q[0] >= x && q[0] > p[0]) return p[1] + (x - p[0]) / (q[0] - p[0]) * (q[1] - p[1]);
    }
    return points[points.length - 1][1];
  }
  return null;
}

// Upper and lower edge of an area, drawn to the right above and back below.
function edgesAt(pieces, x) {
  for (const {points} of pieces) {
    let turn = 1;
    while (turn < points.length && points[turn][0] >= points[turn - 1][0]) ++turn;
    const high = heightAt([{points: points.slice(0, turn)}], x), low = heightAt([{points: points.slice(turn).reverse()}], x);
    if (high !== null && low !== null) return [high, low];
  }
  return [null, null];
}

const charts = [...document.querySelectorAll("svg.plot")].map((plot) => new Chart(plot));
if (charts.length) {
  const hint = document.createElement("p");
  hint.className = "hint";
  hint.textContent = "Charts: point at a curve to read it, drag to zoom, double-click for the whole.";
  const first = charts[0].svg.closest("figure");
  (first.closest(".row") || first).before(hint);
}
addEventListener("beforeprint", () => charts.forEach((chart) => { chart.clear(); chart.reset(); }));
})();
