// Small SVG charts and drawings. Every text goes through textContent.

const SVG = "http://www.w3.org/2000/svg";
const MARGIN = { left: 58, right: 14, top: 12, bottom: 42 };

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  fill(made, attributes, children);
  return made;
}

function shape(name, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, name);
  fill(made, attributes, children);
  return made;
}

function fill(made, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value !== null && value !== false) made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== ""));
}

// At least three significant digits, without exponent: 0.0123, 1.23, 1234.
function digits(value) {
  if (value === null || !Number.isFinite(value)) return "–";
  const decimals = value ? 2 - Math.floor(Math.log10(Math.abs(value))) : 0;
  return value.toFixed(Math.min(Math.max(decimals, 0), 12));
}

// Data is in SI; people read mm, %, mJ. The factors are those of numbers.py.
function inUnits(value, unit) {
  return data.factors[unit] * value;
}

function toSI(value, unit) {
  return value / data.factors[unit];
}

function energyUnit(joules) {
  return joules >= 1 ? "J" : "mJ";
}

function energyText(joules) {
  const unit = energyUnit(joules);
  return `${digits(inUnits(joules, unit))} ${unit}`;
}

// Round numbers from low to high, about `count` of them.
function ticks(low, high, count) {
  const rough = (high - low) / count || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((k) => k * power >= rough) * power;
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-9); k += 1)
    found.push(Number((k * step).toPrecision(12)));
  return found;
}

// Round numbers on a log axis: powers of ten times 1, 2, 5, or 1 alone if these are many.
function logTicks(low, high) {
  const powers = [];
  for (let k = Math.floor(Math.log10(low)); k <= Math.log10(high); k += 1) powers.push(k);
  const times = (factors) =>
    powers.flatMap((k) => factors.map((f) => Number((f * 10 ** k).toPrecision(3)))).filter((v) => v >= low && v <= high);
  const fine = times([1, 2, 5]);
  if (fine.length < 3) return ticks(low, high, 4);
  return fine.length > 9 ? times([1]) : fine;
}

// A function from values of an axis {range, log} to pixels.
function scaled({ range, log }, from, to) {
  const turn = log ? Math.log : (v) => v;
  const [low, high] = range.map(turn);
  return (v) => from + ((turn(v) - low) / (high > low ? high - low : 1)) * (to - from);
}

// An empty chart that fills `box`: axes with ticks and labels, and functions x and y to pixels.
function chart(box, { x, y, height = 300, label }) {
  const width = Math.max(box.clientWidth, 260);
  const svg = shape("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label });
  const right = width - MARGIN.right;
  const bottom = height - MARGIN.bottom;
  const [toX, toY] = [scaled(x, MARGIN.left, right), scaled(y, bottom, MARGIN.top)];
  for (const v of x.log ? logTicks(...x.range) : ticks(...x.range, width / 90)) {
    svg.append(shape("line", { class: "grid", x1: toX(v), x2: toX(v), y1: MARGIN.top, y2: bottom }));
    svg.append(shape("text", { class: "tick", x: toX(v), y: bottom + 16, "text-anchor": "middle" }, String(v)));
  }
  for (const v of y.log ? logTicks(...y.range) : ticks(...y.range, height / 50)) {
    svg.append(shape("line", { class: "grid", x1: MARGIN.left, x2: right, y1: toY(v), y2: toY(v) }));
    svg.append(shape("text", { class: "tick", x: MARGIN.left - 6, y: toY(v) + 4, "text-anchor": "end" }, String(v)));
  }
  const middle = (MARGIN.top + bottom) / 2;
  svg.append(
    shape("text", { class: "axis", x: (MARGIN.left + right) / 2, y: height - 6, "text-anchor": "middle" }, x.label),
    shape("text", { class: "axis", transform: `translate(13 ${middle}) rotate(-90)`, "text-anchor": "middle" }, y.label),
  );
  box.replaceChildren(svg);
  return { svg, toX, toY, width, height, right, bottom };
}

function line(plot, xs, ys, attributes) {
  const points = xs.map((v, i) => `${plot.toX(v).toFixed(1)},${plot.toY(ys[i]).toFixed(1)}`);
  const made = shape("polyline", { fill: "none", ...attributes, points: points.join(" ") });
  plot.svg.append(made);
  return made;
}

// Lowest and highest of many numbers, with zero among them if `zero`.
function extent(lists, zero = true) {
  const values = lists.flat().filter((v) => v !== null);
  const low = Math.min(...(zero ? [0] : []), ...values);
  const high = Math.max(...(zero ? [0] : []), ...values);
  return [low, high > low ? high + 0.04 * (high - low) : low + 1];
}

// The same for a log axis, with some room at both ends.
function logExtent(values) {
  const room = Math.max((Math.max(...values) / Math.min(...values)) ** 0.06, 1.05);
  return [Math.min(...values) / room, Math.max(...values) * room];
}

// The walls of a design at rest, y upwards, with their true thickness.
function drawingOf(drawing, attributes = {}) {
  const [left, low, width, height] = drawing.box;
  const svg = shape("svg", { class: "drawing", viewBox: `0 0 ${width} ${height}`, ...attributes });
  const place = `matrix(.01 0 0 -.01 ${-left} ${low + height})`;
  const group = shape("g", { transform: place, fill: "none", stroke: "currentColor" });
  for (const [wide, path] of drawing.walls)
    group.append(shape("path", { d: path, "stroke-width": 100 * wide, "stroke-linecap": "square", "stroke-linejoin": "miter" }));
  svg.append(group);
  return svg;
}

// Text of an SVG file in mm, for slicers and drawing programs.
function drawingFile(drawing) {
  const [, , width, height] = drawing.box;
  const svg = drawingOf(drawing, { xmlns: SVG, width: `${width}mm`, height: `${height}mm`, color: "black" });
  svg.removeAttribute("class");
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(svg)}\n`;
}

// A function of a frame, a node and an axis to the coordinate of a moving shape.
function coordinates({ position, low, step, nodes }) {
  const counts = new DataView(bytesOf(position).buffer);
  return (k, node, axis) => low[axis] + step * counts.getUint16(2 * (low.length * (k * nodes + node) + axis), true);
}

// Left, right, low and high end of points.
function bounds(points) {
  let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, y] of points) {
    [left, right] = [Math.min(left, x), Math.max(right, x)];
    [low, high] = [Math.min(low, y), Math.max(high, y)];
  }
  return [left, right, low, high];
}

const inner = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => a.map((value, i) => value - b[i]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// A point on the screen, as `seen` of shaded.py.
function seen({ camera }, point) {
  return [inner(point, camera[0]), inner(point, camera[1])];
}

// Quads from back to front, as `faces` of shaded.py; at: position of a node.
function faces(moving, at) {
  const { quads, laid, camera, light, ambient } = moving;
  const found = [];
  for (const nodes of quads) {
    const corner = nodes.map(at);
    const normal = cross(minus(corner[2], corner[0]), minus(corner[3], corner[1]));
    const shade = ambient + ((1 - ambient) * Math.abs(inner(normal, light))) / (Math.hypot(...normal) || 1);
    for (const [x, y] of laid) {
      const moved = corner.map((point) => [point[0] + x, point[1] + y, point[2]]);
      const near = moved.reduce((sum, point) => sum + inner(point, camera[2]), 0);
      found.push({ corners: moved.map((point) => seen(moving, point)), near, shade });
    }
  }
  return found.sort((a, b) => a.near - b.near);
}

// The colour of a shade from 0 to 1, between red, green and blue of a list.
function shadeColour(colours, shade) {
  const place = Math.min(shade, 1) * (colours.length - 1);
  const first = Math.min(Math.floor(place), colours.length - 2);
  const mixed = colours[first].map((low, i) => low + (place - first) * (colours[first + 1][i] - low));
  return `rgb(${mixed.map(Math.round)})`;
}

// A player of moving plates in `box`: show(k) draws frame k, with the outline of the upper platen.
function solidStage(box, moving) {
  const coordinate = coordinates(moving);
  const frames = moving.strain.length;
  const at = (k) => (node) => [0, 1, 2].map((axis) => coordinate(k, node, axis));
  const platen = (height) => moving.ring.map(([x, y]) => seen(moving, [x, y, height]));
  const all = moving.plates.flatMap((ends, k) => [...ends.flatMap(platen), ...faces(moving, at(k)).flatMap((face) => face.corners)]);
  const [left, right, low, high] = bounds(all);
  const viewBox = `${left} ${-high} ${right - left} ${high - low}`;
  const svg = shape("svg", { class: "stage", viewBox, role: "img", "aria-label": "shape of the lattice" });
  const lower = shape("polygon", { class: "platen" });
  const upper = shape("polygon", { class: "outline" });
  const drawn = moving.quads.flatMap(() => moving.laid).map(() => shape("polygon", { class: "face" }));
  svg.append(lower, ...drawn, upper);
  box.replaceChildren(svg);
  const place = (polygon, points) => polygon.setAttribute("points", points.map(([x, y]) => `${x.toFixed(3)},${(-y).toFixed(3)}`).join(" "));
  const show = (k) => {
    faces(moving, at(k)).forEach(({ corners, shade }, i) => {
      place(drawn[i], corners);
      drawn[i].setAttribute("fill", shadeColour(moving.colours, shade));
    });
    place(lower, platen(moving.plates[k][0]));
    place(upper, platen(moving.plates[k][1]));
  };
  return { show, frames };
}

// A player of moving walls in `box`: show(k) draws frame k.
function stage(box, moving) {
  const at = coordinates(moving);
  const frames = moving.strain.length;
  const every = moving.strain.flatMap((_, k) => Array.from({ length: moving.nodes }, (_, node) => [at(k, node, 0), at(k, node, 1)]));
  const [left, right, low, top] = bounds(every);
  const wide = Math.max(...moving.trails.map(([thickness]) => thickness));
  const standing = moving.plates.map((ends) => ends[1]).filter((y) => y !== null);
  const high = Math.min(Math.max(top + wide, ...standing), low + 3 * (right - left) + wide);
  const plate = 0.05 * Math.max(right - left, high - low);
  const edge = wide + plate;
  const [width, height] = [right - left + 2 * edge, high - low + wide + 2 * plate];
  const svg = shape("svg", { class: "stage", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "shape of the lattice" });
  const toX = (x) => x - left + edge;
  const toY = (y) => high + plate - y;
  const platens = [0, 1].map(() => shape("rect", { class: "platen", x: 0, width, height: plate }));
  const walls = moving.trails.map(([thickness]) =>
    shape("polyline", { class: "wall", "stroke-width": thickness, "stroke-linejoin": "round", "stroke-linecap": "square" }));
  const profiles = moving.profiles.map((outlines) => outlines.map((outline) =>
    shape("polygon", { class: "platen", points: outline.map(([x, y]) => `${toX(x)},${toY(y)}`).join(" ") })));
  svg.append(...platens, ...profiles.flat(), ...walls);
  box.replaceChildren(svg);
  const show = (k) => {
    moving.trails.forEach(([, nodes], i) => {
      const points = nodes.map((n) => `${toX(at(k, n, 0)).toFixed(3)},${toY(at(k, n, 1)).toFixed(3)}`);
      walls[i].setAttribute("points", points.join(" "));
    });
    platens.forEach((rect, upper) => {
      const y = moving.plates[k][upper];
      rect.style.display = y === null || profiles[upper].length ? "none" : "";
      if (y !== null) rect.setAttribute("y", toY(y) - (upper ? plate : 0));
      for (const outline of profiles[upper]) outline.setAttribute("transform", `translate(0 ${-y})`);
    });
  };
  return { show, frames };
}
