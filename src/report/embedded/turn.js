// A picture that turns: triangles of an assembly with depth, on a plain canvas (no graphics card is asked for), by step and frame, coloured
// by a field, cut and pulled apart. Its data is JSON in the page (drawing/turning_file.hpp); without this script the figure stays hidden.
"use strict";
(() => {
const viridis = [[68,1,84],[71,44,122],[59,81,139],[44,113,142],[33,144,141],[39,173,129],[92,200,99],[170,220,50],[253,231,37]];
const ramp = new Uint8Array(3 * 256);
for (let i = 0; i < 256; ++i) {
  const place = i / 255 * 8, k = Math.min(7, Math.floor(place));
  for (let c = 0; c < 3; ++c) ramp[3 * i + c] = viridis[k][c] + (place - k) * (viridis[k + 1][c] - viridis[k][c]);
}

const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;

// "12.3 µm": an SI value with a prefix.
function withUnit(value, unit) {
  if (!Number.isFinite(value)) return "not finite";
  if (value === 0) return "0 " + unit;
  const power = Math.max(-4, Math.min(3, Math.floor(Math.log10(Math.abs(value)) / 3 + 1e-9)));
  return Number((value / 10 ** (3 * power)).toPrecision(3)) + " " + ["p", "n", "µ", "m", "", "k", "M", "G"][power + 4] + unit;
}

const rgb = (color) => [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16));  // "#rrggbb"

class Model {
  constructor(json) {
    Object.assign(this, json);
    const x = new Int16Array(bytes(json.x));
    this.x = Float32Array.from(x, (v) => v * json.unit);  // m, about the centre
    this.triangles = new Uint16Array(bytes(json.triangles));
    this.edges = new Uint16Array(bytes(json.edges));
    this.label = json.label ? new Uint16Array(bytes(json.label)) : null;
    this.n = this.x.length / 3;
    this.partOfNode = new Uint16Array(this.n);
    this.partOfTriangle = new Uint16Array(this.triangles.length / 3);
    let node = 0, triangle = 0;
    this.middle = json.parts.map((part, p) => {
      const first = node, sum = [0, 0, 0];
      for (; node < first + part.nodes; ++node) {
        this.partOfNode[node] = p;
        for (let d = 0; d < 3; ++d) sum[d] += this.x[3 * node + d] / part.nodes;
      }
      this.partOfTriangle.fill(p, triangle, triangle += part.triangles);
      return sum;
    });
    this.colors = json.parts.map((part) => rgb(part.color));
    this.labelColors = (json.labels || []).map((label) => label.color ? rgb(label.color) : [228, 228, 228]);
    this.isModes = json.modes === true;
    this.frames = json.frames.map((f) => ({...f, u: new Int16Array(bytes(f.u)), s: new Uint8Array(bytes(f.s))}));
    this.radius = 0;
    for (let i = 0; i < this.n; ++i) this.radius = Math.max(this.radius, Math.hypot(this.x[3 * i], this.x[3 * i + 1], this.x[3 * i + 2]));
  }

  // A field at the nodes of a frame, SI.
  field(name, frame) {
    const f = this.frames[frame], v = new Float32Array(this.n);
    for (let i = 0; i < this.n; ++i) {
      const u = f.unit, d = f.u;
      if (name === "von_mises") v[i] = f.top * (f.s[i] / 255) ** (this.stress_power || 1);
      else if (name === "displacement") v[i] = u * Math.hypot(d[3 * i], d[3 * i + 1], d[3 * i + 2]);
      else v[i] = u * d[3 * i + "xyz".indexOf(name)];
    }
    return v;
  }

  // Values at the ends of equal steps of a colour scale over all frames, from low to high. Of stress high is what one node in two hundred
  // exceeds; where a peak would leave half of the assembly the lowest fifth of the scale, each colour takes as many nodes.
  scale(name) {
    const isStress = name === "von_mises", all = [];
    let low = Infinity, high = -Infinity;
    for (let k = 0; k < this.frames.length; ++k) {
      const v = this.field(name, k).sort(), place = (share) => v[Math.floor(share * (this.n - 1))];
      low = Math.min(low, v[0]);
      high = Math.max(high, place(isStress ? 0.995 : 1));
      for (let j = 0; j <= 400; ++j) all.push(place(j / 400));
    }
    if (isStress || name === "displacement") low = 0;
    if (!(high > low)) high = low + 1e-30;
    all.sort((a, b) => a - b);
    const steps = 64, at = (share) => all[Math.round(share * (all.length - 1))];
    const isSkewed = isStress && at(0.5) < 0.2 * high;
    const ends = Array.from({length: steps + 1}, (_, i) => isSkewed ? Math.min(high, at(i / steps)) : low + (high - low) * i / steps);
    ends[0] = low; ends[steps] = high;
    return {ends, isSkewed};
  }

  // Places on a scale, 0 to 255.
  tones(values, {ends}) {
    const tones = new Float32Array(values.length), last = ends.length - 1;
    for (let i = 0; i < values.length; ++i) {
      let a = 0, b = last;
      while (b - a > 1) { const m = (a + b) >> 1; if (ends[m] <= values[i]) a = m; else b = m; }
      const share = ends[b] > ends[a] ? (values[i] - ends[a]) / (ends[b] - ends[a]) : 0;
      tones[i] = 255 * Math.max(0, Math.min(1, (a + Math.max(0, Math.min(1, share))) / last));
    }
    return tones;
  }

  // Middle of the part that has the largest stress of a frame.
  mostStressed(frame) {
    const v = this.field("von_mises", frame);
    let best = 0;
    for (let i = 1; i < this.n; ++i) if (v[i] > v[best]) best = i;
    return this.middle[this.partOfNode[best]];
  }
}

class Picture {
  constructor(canvas, model) {
    this.canvas = canvas;
    this.model = model;
    this.px = new Float32Array(model.n); this.py = new Float32Array(model.n); this.pz = new Float32Array(model.n);
    this.side = new Float32Array(model.n);
    this.reset();
  }

  reset() {
    this.axes = this.model.axes.slice();
    this.zoom = 1; this.shift = [0, 0];
  }

  // Turns about the screen's own axes, radians.
  turn(right, up) {
    const a = this.axes, ca = Math.cos(right), sa = Math.sin(right), ce = Math.cos(up), se = Math.sin(up);
    for (let j = 0; j < 3; ++j) {
      const x = a[j], y = a[3 + j], z = a[6 + j], x2 = ca * x + sa * z, z2 = ca * z - sa * x;
      a[j] = x2; a[3 + j] = ce * y - se * z2; a[6 + j] = se * y + ce * z2;
    }
  }

  project(state) {
    const m = this.model, a = this.axes, w = this.canvas.width, h = this.canvas.height, f = m.frames[state.frame];
    const scale = 0.55 * Math.min(w / 1.25, h) / m.radius * this.zoom / (1 + 0.5 * state.apart), warp = f ? state.swing * state.warp * f.unit : 0;
    this.scale = scale;
    for (let i = 0; i < m.n; ++i) {
      const c = m.middle[m.partOfNode[i]];
      let x = m.x[3 * i], y = m.x[3 * i + 1], z = m.x[3 * i + 2];
      if (state.cut) this.side[i] = state.cut.sign * ([x, y, z][state.cut.axis] - state.cut.at);
      x += state.apart * c[0]; y += state.apart * c[1]; z += state.apart * c[2];
      if (f) { x += warp * f.u[3 * i]; y += warp * f.u[3 * i + 1]; z += warp * f.u[3 * i + 2]; }
      this.px[i] = 0.5 * w + scale * (a[0] * x + a[1] * y + a[2] * z) + this.shift[0] * w;
      this.py[i] = 0.5 * h - scale * (a[3] * x + a[4] * y + a[5] * z) + this.shift[1] * w;
      this.pz[i] = scale * (a[6] * x + a[7] * y + a[8] * z);
    }
  }

  draw(state) {
    const {width: w, height: h} = this.canvas, m = this.model, n = w * h;
    if (!this.depth || this.depth.length !== n) {
      this.depth = new Float32Array(n); this.item = new Int32Array(n);
      this.image = new ImageData(w, h);
    }
    this.depth.fill(-Infinity); this.item.fill(-1);
    const pixels = new Uint32Array(this.image.data.buffer).fill(0xffffffff);
    this.project(state);
    this.values = state.field ? m.field(state.field, state.frame) : null;
    this.tones = state.field ? m.tones(this.values, state.scale) : null;
    const colors = m.colors;
    for (let t = 0; t < m.partOfTriangle.length; ++t) {
      const p = m.partOfTriangle[t];
      if (!state.hidden.has(p)) this.triangle(t, state, state.colorOf ? state.colorOf(t) : colors[p], pixels);
    }
    // What lies open behind a cut is the part's inside: its section. A part ends where its neighbour begins.
    for (let i = 0; i < n; ++i) {
      const k = this.item[i];
      if (k < 0) continue;
      const t = k >> 1;
      if (k & 1) {
        this.depth[i] = Infinity;
        const c = colors[m.partOfTriangle[t]], shade = (i % w + Math.floor(i / w)) % 6 < 1 ? 0.8 : 0.97;
        pixels[i] = 0xff000000 | (c[2] * shade) << 16 | (c[1] * shade) << 8 | c[0] * shade;
      }
    }
    const kind = (k) => k < 0 ? -1 : 2 * m.partOfTriangle[k >> 1] + (k & 1);
    for (let y = 1; y < h; ++y)
      for (let x = 1; x < w; ++x) {
        const i = y * w + x, k = kind(this.item[i]);
        if (k !== kind(this.item[i - 1]) || k !== kind(this.item[i - w])) pixels[i] = 0xff555555;
      }
    for (let e = 0; e < m.edges.length; e += 2)
      if (!state.hidden.has(m.partOfNode[m.edges[e]])) this.edge(m.edges[e], m.edges[e + 1], state, pixels);
    this.canvas.getContext("2d").putImageData(this.image, 0, 0);
  }

  triangle(t, state, color, pixels) {
    const {triangles} = this.model, {px, py, pz, side, depth, item, tones} = this, w = this.canvas.width, h = this.canvas.height;
    const a = triangles[3 * t], b = triangles[3 * t + 1], c = triangles[3 * t + 2];
    const area = (px[b] - px[a]) * (py[c] - py[a]) - (px[c] - px[a]) * (py[b] - py[a]);
    const isBack = area > 0;  // y runs down
    if (isBack && !state.cut || !(Math.abs(area) > 1e-6)) return;
    const cutting = state.cut && (side[a] > 0 || side[b] > 0 || side[c] > 0);
    if (cutting && side[a] > 0 && side[b] > 0 && side[c] > 0) return;
    // Light comes from above the reader's left shoulder.
    const ux = px[b] - px[a], uy = py[a] - py[b], uz = pz[b] - pz[a], vx = px[c] - px[a], vy = py[a] - py[c], vz = pz[c] - pz[a];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const light = 0.62 + 0.38 * Math.max(0, (-0.35 * nx + 0.6 * ny + 0.72 * nz) / (Math.hypot(nx, ny, nz) || 1));
    const flat = 0xff000000 | (color[2] * light) << 16 | (color[1] * light) << 8 | color[0] * light;
    const x0 = Math.max(0, Math.ceil(Math.min(px[a], px[b], px[c]) - 0.5)), x1 = Math.min(w - 1, Math.floor(Math.max(px[a], px[b], px[c]) - 0.5));
    const y0 = Math.max(0, Math.ceil(Math.min(py[a], py[b], py[c]) - 0.5)), y1 = Math.min(h - 1, Math.floor(Math.max(py[a], py[b], py[c]) - 0.5));
    const s = 1 / area, tint = 0.8 + 0.2 * light;
    const stepA = (py[b] - py[c]) * s, stepB = (py[c] - py[a]) * s;
    for (let y = y0; y <= y1; ++y) {
      const dy = y + 0.5;
      let wa = ((px[b] - x0 - 0.5) * (py[c] - dy) - (px[c] - x0 - 0.5) * (py[b] - dy)) * s;
      let wb = ((px[c] - x0 - 0.5) * (py[a] - dy) - (px[a] - x0 - 0.5) * (py[c] - dy)) * s;
      for (let x = x0, i = y * w + x0; x <= x1; ++x, ++i, wa += stepA, wb += stepB) {
        const wc = 1 - wa - wb;
        if (wa < -1e-4 || wb < -1e-4 || wc < -1e-4) continue;
        const z = wa * pz[a] + wb * pz[b] + wc * pz[c];
        if (z <= depth[i] || cutting && wa * side[a] + wb * side[b] + wc * side[c] > 0) continue;
        depth[i] = z;
        item[i] = 2 * t + (isBack ? 1 : 0);
        if (tones) {
          const v = Math.max(0, Math.min(255, Math.round(wa * tones[a] + wb * tones[b] + wc * tones[c])));
          pixels[i] = 0xff000000 | (ramp[3 * v + 2] * tint) << 16 | (ramp[3 * v + 1] * tint) << 8 | ramp[3 * v] * tint;
        } else pixels[i] = flat;
      }
    }
  }

  edge(a, b, state, pixels) {
    const {px, py, pz, side, depth} = this, w = this.canvas.width, h = this.canvas.height;
    const n = Math.ceil(Math.max(Math.abs(px[b] - px[a]), Math.abs(py[b] - py[a]), 1)), bias = 0.004 * w;
    if (!(n < 1e5)) return;
    for (let k = 0; k <= n; ++k) {
      const s = k / n, x = Math.floor(px[a] + s * (px[b] - px[a])), y = Math.floor(py[a] + s * (py[b] - py[a]));
      if (x < 0 || y < 0 || x >= w || y >= h || state.cut && side[a] + s * (side[b] - side[a]) > 0) continue;
      const i = y * w + x;
      if (pz[a] + s * (pz[b] - pz[a]) > depth[i] - bias) pixels[i] = (pixels[i] >>> 1 & 0x7f7f7f) + 0x202020 | 0xff000000;
    }
  }

  // What is drawn at a pixel: part, label, value; nothing: null.
  at(x, y) {
    const m = this.model, w = this.canvas.width, k = x >= 0 && y >= 0 && x < w && y < this.canvas.height ? this.item[y * w + x] : -1;
    if (k < 0) return null;
    const t = k >> 1, {px, py, values} = this;
    const found = {part: m.parts[m.partOfTriangle[t]].name, label: m.label ? m.labels[m.label[t]].name : "", isSection: (k & 1) === 1};
    if (values && !found.isSection) {
      const [a, b, c] = m.triangles.subarray(3 * t, 3 * t + 3);
      const area = (px[b] - px[a]) * (py[c] - py[a]) - (px[c] - px[a]) * (py[b] - py[a]);
      const wa = ((px[b] - x - 0.5) * (py[c] - y - 0.5) - (px[c] - x - 0.5) * (py[b] - y - 0.5)) / area;
      const wb = ((px[c] - x - 0.5) * (py[a] - y - 0.5) - (px[a] - x - 0.5) * (py[c] - y - 0.5)) / area;
      found.value = wa * values[a] + wb * values[b] + (1 - wa - wb) * values[c];
    }
    return found;
  }
}

const fields = {von_mises: ["von Mises stress", "Pa"], displacement: ["displacement", "m"], x: ["displacement x", "m"], y: ["displacement y", "m"],
                z: ["displacement z", "m"]};

function element(parent, tag, settings = {}, text = "") {
  const made = parent.appendChild(document.createElement(tag));
  for (const [key, value] of Object.entries(settings)) made.setAttribute(key, value);
  made.textContent = text;
  return made;
}

function control(parent, name, tag, settings) {
  const label = element(parent, "label", {}, name + " ");
  return element(label, tag, settings);
}

// The figure's controls write into `state` and draw again.
function setUp(figure) {
  const model = new Model(JSON.parse(figure.querySelector("script").textContent));
  const bar = element(figure, "div", {class: "controls"}), stage = element(figure, "div", {class: "stage"});
  const canvas = element(stage, "canvas", {tabindex: "0", role: "img", "aria-label": figure.dataset.title});
  const tip = element(stage, "div", {class: "tip"}), legend = element(figure, "div", {class: "legend"});
  const second = element(figure, "div", {class: "controls"});
  const picture = new Picture(canvas, model);
  const state = {frame: Math.max(0, model.shown || 0), warp: model.warp || 0, apart: model.label ? 0.6 : 0, swing: 1, field: model.isModes ? "displacement" : model.frames.length ? "von_mises" : "", cut: null,
                 hidden: new Set(), scale: null, colorOf: null};
  let waiting = false, playing = 0;
  const scales = {};
  const labelColor = (t) => model.labelColors[model.label[t]];

  function sharpness(isMoving) {
    const width = Math.max(200, Math.min(900, stage.clientWidth)), quality = isMoving ? 1 : Math.min(2, window.devicePixelRatio || 1);
    canvas.style.width = width + "px";
    const w = Math.round(width * quality), h = Math.round(0.66 * width * quality);
    if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  }
  function draw(isMoving = false) {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      sharpness(isMoving);
      if (state.field) state.scale = scales[state.field] = scales[state.field] || model.scale(state.field);
      picture.draw(state);
      tell();
    });
  }
  function tell() {
    legend.textContent = "";
    if (state.field) {
      const [name, unit] = model.isModes ? [fields[state.field][0] + ", of the largest", ""] : fields[state.field];
      const {ends, isSkewed} = state.scale, last = ends.length - 1, bar = element(legend, "span", {class: "scale"});
      element(bar, "span", {class: "ramp"});
      const ticks = element(bar, "span", {class: "ticks"});
      for (const share of isSkewed ? [0, 0.25, 0.5, 0.75, 1] : [0, 1]) element(ticks, "span", {}, withUnit(ends[Math.round(share * last)], unit));
      element(legend, "span", {}, name + (isSkewed ? ", by quantile: each colour covers as much" : ""));
    }
    const f = model.frames[state.frame];
    if (f) instant.textContent = f.step + (model.isModes ? "" : f.static ? " (static)" : ", " + withUnit(f.time, "s"));
    if (f && f.missed) instant.textContent += " – NOT CONVERGED: " + f.missed + (f.missed === 1 ? " increment" : " increments") + " so far";
  }

  // By what it is coloured; when.
  const choice = control(bar, "colour", "select");
  if (model.frames.length) for (const [key, [name]] of Object.entries(fields)) if (!model.isModes || key !== "von_mises") element(choice, "option", {value: key}, name);
  element(choice, "option", {value: "part"}, "part");
  if (model.label) element(choice, "option", {value: "label"}, model.coloring);
  choice.onchange = () => {
    state.field = choice.value in fields ? choice.value : "";
    state.colorOf = choice.value === "label" ? labelColor : null;
    draw();
  };
  const instant = document.createElement("output");
  if (model.frames.length) {
    const time = control(bar, model.isModes ? "mode" : "frame", "input", {type: "range", min: 0, max: model.frames.length - 1, step: 1, value: state.frame});
    const show = (k) => { time.value = state.frame = k; draw(); };
    time.oninput = () => show(Number(time.value));
    const play = element(bar, "button", {type: "button"}, "play");
    play.onclick = () => {
      clearInterval(playing);
      let phase = 0;
      const swing = () => { state.swing = Math.cos(phase += Math.PI / 16); draw(true); };
      if (playing) { state.swing = 1; draw(); }
      playing = playing ? 0 : model.isModes ? setInterval(swing, 40) : setInterval(() => show((state.frame + 1) % model.frames.length), 350);
      play.textContent = playing ? "stop" : "play";
    };
    bar.append(instant);
    const warp = control(second, "displacements ×", "input", {type: "number", min: 0, step: "any", value: state.warp});
    warp.oninput = () => { state.warp = Math.max(0, Number(warp.value) || 0); draw(); };
  }
  const apart = control(second, "apart", "input", {type: "range", min: 0, max: 2, step: 0.01, value: state.apart});
  apart.oninput = () => { state.apart = Number(apart.value); draw(true); };
  apart.onchange = () => draw();
  const cut = control(second, "cut", "select");
  for (const name of ["none", "x", "−x", "y", "−y", "z", "−z"]) element(cut, "option", {value: name}, name);
  const place = element(second, "input", {type: "range", min: -1, max: 1, step: "any", value: 0, "aria-label": "place of the cut"});
  const hot = model.frames.length ? model.mostStressed(state.frame) : null;
  const setCut = (isMoving) => {
    const axis = "xyz".indexOf(cut.value.slice(-1));
    state.cut = cut.value === "none" ? null : {axis, sign: cut.value.length > 1 ? -1 : 1, at: Number(place.value) * model.extent[axis]};
    draw(isMoving);
  };
  // Begins in the middle of the most stressed part.
  cut.onchange = () => {
    const axis = "xyz".indexOf(cut.value.slice(-1));
    if (hot && axis >= 0) place.value = hot[axis] / (model.extent[axis] || 1);
    setCut();
  };
  place.oninput = () => setCut(true); place.onchange = () => setCut();
  const back = element(second, "button", {type: "button"}, "reset view");
  back.onclick = () => { picture.reset(); draw(); };
  const list = element(figure, "details");
  element(list, "summary", {}, "parts");
  model.parts.forEach((part, p) => {
    const label = element(list, "label"), box = element(label, "input", {type: "checkbox"});
    box.checked = true;
    element(label, "i", {style: `background: ${part.color}`});
    label.append(part.name);
    box.onchange = () => { state.hidden[box.checked ? "delete" : "add"](p); draw(); };
  });

  figure.append(figure.querySelector("figcaption"));

  // Dragging turns, with Shift it moves; Ctrl and the wheel, or + and -, zoom.
  let held = null;
  const hold = (id) => { try { canvas.setPointerCapture(id); } catch { /* a pointer that is gone already */ } };
  canvas.onpointerdown = (e) => { held = [e.clientX, e.clientY]; hold(e.pointerId); };
  canvas.onpointerup = () => { held = null; draw(); };
  canvas.onpointermove = (e) => {
    const box = canvas.getBoundingClientRect();
    if (held) {
      const dx = e.clientX - held[0], dy = e.clientY - held[1];
      held = [e.clientX, e.clientY];
      if (e.shiftKey) { picture.shift[0] += dx / box.width; picture.shift[1] += dy / box.width; } else picture.turn(0.008 * dx, 0.008 * dy);
      draw(true);
      return;
    }
    const factor = canvas.width / box.width;
    const found = picture.item ? picture.at(Math.floor((e.clientX - box.left) * factor), Math.floor((e.clientY - box.top) * factor)) : null;
    tip.style.display = found ? "block" : "none";
    if (!found) return;
    tip.textContent = [found.part, found.isSection ? "section" : found.label, found.value === undefined ? "" : withUnit(found.value, fields[state.field][1])]
      .filter((text) => text).join(", ");
    tip.style.left = Math.min(e.clientX - box.left + 14, box.width - 120) + "px";
    tip.style.top = e.clientY - box.top + 14 + "px";
  };
  canvas.onpointerleave = () => { tip.style.display = "none"; };
  const zoomBy = (factor) => { picture.zoom = Math.max(0.3, Math.min(40, picture.zoom * factor)); draw(true); };
  canvas.addEventListener("wheel", (e) => {
    if (!e.ctrlKey && document.activeElement !== canvas) return;  // the page scrolls on
    e.preventDefault();
    zoomBy(Math.exp(-0.0015 * e.deltaY));
  }, {passive: false});
  canvas.onkeydown = (e) => {
    const turns = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[e.key];
    if (turns) picture.turn(0.1 * turns[0], 0.1 * turns[1]);
    else if (e.key === "+" || e.key === "-") picture.zoom *= e.key === "+" ? 1.2 : 1 / 1.2;
    else return;
    e.preventDefault();
    draw();
  };
  if (model.label) { choice.value = "label"; choice.onchange(); }
  if (model.hides && hot) {  // along the horizontal axis that looks most towards the reader
    const axis = Math.abs(model.axes[6]) >= Math.abs(model.axes[7]) ? 0 : 1;
    cut.value = (model.axes[6 + axis] < 0 ? "−" : "") + "xyz"[axis];
    cut.onchange();
    if (model.parts.length > 12) { place.value = 0; setCut(); }  // of many parts the most stressed is a bolt at an edge
  }
  window.addEventListener("resize", () => draw());
  figure.hidden = false;
  draw();
}

for (const figure of document.querySelectorAll("figure.turn")) {
  try { setUp(figure); } catch (error) { figure.hidden = true; throw error; }
}
})();
