// The mechanism on the sheet: SVG elements, built when the mechanism changes, moved when its position does.

import { state, on } from "./state.js";
import { canvas, size, spacing, toPlane, toScreen, keepInSight } from "./view.js";
import { at, cornersOf, fromStretch, ground, isPin, lastPlace, linkNamed, linksAt, parts, shown } from "./geometry.js";
import { word } from "./language.js";
import { sides } from "./names.js";

const NAMESPACE = "http://www.w3.org/2000/svg";
const TRIANGLE = "M0,0 L-9,15 L9,15 Z";
const MIDDLE = 5; // how far the line under letters is below their middle
const [BAR, THIN] = [11, 2]; // widths of links and of lines, as style.css has them
const [SLOT, HATCHED] = [8, 6]; // half of a slot's width; how far the hatching of a guide on the ground reaches beyond it
const BLOCKS = { "pin-slot": [18, 16], prismatic: [34, 22] }; // length along its guide, and height
const HATCH = "M-13,15 L13,15 M-10,15 l-4,5 M-4,15 l-4,5 M2,15 l-4,5 M8,15 l-4,5";

export function element(name, attributes = {}, parent = null) {
  const made = document.createElementNS(NAMESPACE, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  parent?.append(made);
  return made;
}

const layers = {};
for (const name of ["grid", "picture", "paths", "guides", "grounds", "links", "acting", "drive", "pins", "band"]) {
  layers[name] = element("g", { class: `layer-${name}` }, canvas);
}
layers.grid.setAttribute("aria-hidden", "true");
layers.band.setAttribute("aria-hidden", "true");

export const band = layers.band;

// --- grid and picture -------------------------------------------------------------------------------------------------

function drawGrid() {
  layers.grid.replaceChildren();
  const { width, height } = size();
  canvas.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const [left, top] = toPlane(0, 0);
  const [right, low] = toPlane(width, height);
  const { step, strong } = spacing();
  const lines = { "g-minor": "", "g-major": "", "g-axis": "" };
  const kind = (n) => (n === 0 ? "g-axis" : n % strong === 0 ? "g-major" : "g-minor");
  const texts = [];
  for (let n = Math.ceil(left / step); n * step <= right; n++) {
    const [x] = toScreen(n * step, 0);
    lines[kind(n)] += `M${x.toFixed(1)},0V${height}`;
    if (n % strong === 0) texts.push([x + 3, height - 5, n * step]);
  }
  for (let n = Math.ceil(low / step); n * step <= top; n++) {
    const [, y] = toScreen(0, n * step);
    lines[kind(n)] += `M0,${y.toFixed(1)}H${width}`;
    if (n % strong === 0 && y < height - 20) texts.push([4, y - 4, n * step]);
  }
  if (!state.grid) return;
  for (const [name, path] of Object.entries(lines)) element("path", { class: name, d: path, fill: "none" }, layers.grid);
  for (const [x, y, value] of texts) {
    element("text", { class: "g-text", x, y }, layers.grid).textContent = shown(value);
  }
}

function drawPicture() {
  layers.picture.replaceChildren();
  if (!state.picture) return;
  const { url, x, y, width, height, strength } = state.picture;
  const [left, top] = toScreen(x, y);
  const { scale } = state.view;
  element(
    "image",
    { href: url, x: left, y: top, width: width * scale, height: height * scale, opacity: strength / 100, preserveAspectRatio: "none" },
    layers.picture,
  );
}

// --- what is built once for a mechanism -------------------------------------------------------------------------------

let built = { links: [], pins: [], guides: [], grounds: [], paths: [] };
let shape = "";

function build() {
  const look = state.look;
  const links = look?.links ?? [];
  const joints = look?.joints ?? [];
  const now = JSON.stringify([links, joints, look?.driver?.link, look?.driver?.joint, state.language, Object.keys(look?.frames?.points ?? {})]);
  if (now === shape) return;
  shape = now;
  const focused = document.activeElement?.dataset?.point;
  for (const name of ["paths", "guides", "grounds", "links", "pins"]) layers[name].replaceChildren();
  built = { links: [], pins: [], guides: [], grounds: [], paths: [] };
  for (const [index, link] of links.entries()) if (index) built.links.push(buildLink(link, index));
  for (const joint of joints) built.guides.push(buildGuide(joint));
  for (const point of Object.keys(look?.frames?.points ?? {})) {
    if (links[0]?.points.includes(point)) built.grounds.push(buildGround(point));
    else built.paths.push({ point, line: element("path", { class: "path" }, layers.paths) });
    built.pins.push(buildPin(point));
  }
  if (focused) layers.pins.querySelector(`[data-point="${CSS.escape(focused)}"]`)?.focus();
}

function buildLink(link, index) {
  const group = element("g", { class: `link${index % 2 ? "" : " other"}`, "data-link": link.name }, layers.links);
  const made = { link, group };
  if (link.points.length > 1) {
    const kind = link.points.length > 2 ? "plate" : "bar";
    made.back = element("path", { class: `${kind}-back` }, group);
    made.front = element("path", { class: `${kind}-front` }, group);
  }
  made.grab = element("path", { class: "grab" }, group);
  made.number = element("text", {}, group);
  made.number.textContent = link.number;
  element("title", {}, group).textContent = `${link.number} ${link.label}`;
  return made;
}

function buildGuide(joint) {
  const group = element("g", { class: "guide-group", "data-joint": joint.name }, layers.guides);
  const made = { joint, group, line: element("path", { class: "guide" }, group), hatch: element("path", { class: "hatch" }, group) };
  const block = element("g", { class: "link", "data-joint": joint.name }, layers.links);
  made.block = element("rect", { class: joint.cylinder ? "block inside" : "block", width: 34, height: 20, x: -17, y: -10, rx: 2 }, block);
  made.holder = block;
  return made;
}

function buildGround(point) {
  const group = element("g", { class: "ground" }, layers.grounds);
  element("path", { d: TRIANGLE }, group);
  element("path", { d: HATCH, class: "hatch" }, group);
  return { point, group };
}

function buildPin(point) {
  const group = element("g", { class: `pin${isPin(point) ? "" : " free"}`, "data-point": point, tabindex: "0", role: "button" }, layers.pins);
  element("circle", { class: "reach", r: 17 }, group);
  element("circle", { class: "halo", r: 12 }, group);
  element("circle", { class: "dot", r: isPin(point) ? 5.5 : 3.5 }, group);
  return { point, group, text: nameOf(point, { "text-anchor": "middle" }, group) };
}

// --- what acts on it: springs, loads, weights; wheels and racks --------------------------------------------------------

let acting = [];

/** As many elements as there are shapes; they are only looked at. */
function buildActing() {
  layers.acting.replaceChildren();
  const named = new Set();
  acting = (state.look?.shapes ?? []).map((shape) => {
    const made = element("path", { class: `acting ${shape.kind} ${shape.filled} ${shape.line}` }, layers.acting);
    element("title", {}, made).textContent = shape.name;
    const own = NAMED.includes(shape.kind) ? shape.name.split(" ").pop() : "";
    const name = named.has(own) ? "" : own; // a spring and its damper have one
    named.add(own);
    return { shape, made, text: name ? nameOf(name, { class: "acting-name" }, layers.acting) : null };
  });
}

/** What acts on a link at a place of the sheet: { load: name }, { mass: link }, or null. */
export function actingAt(p, near) {
  for (const { shape, shown } of [...acting].reverse()) {
    const close = (shown ?? []).some((corner, n) => n && fromStretch(p, shown[n - 1], corner) <= near / 2);
    if (close && NAMED.includes(shape.kind)) return { load: shape.name.split(" ").pop() };
    if (close && shape.kind === "mass") return { mass: shape.of };
  }
  return null;
}

const NAMED = ["spring", "damper", "load", "torque"];

/** A name as a textbook sets it, its digits lowered. */
function nameOf(name, attributes, parent) {
  const text = element("text", attributes, parent);
  const [head, low] = parts(name);
  text.textContent = head;
  if (low) element("tspan", { dy: 4 }, text).textContent = low;
  return text;
}

function moveActing() {
  for (const each of acting) {
    const { shape, made, text } = each;
    const places = cornersOf(shape).map(([x, y]) => toScreen(x, y));
    made.setAttribute("d", line(places));
    each.shown = places;
    if (text) placeName(text, places);
  }
}

/** Beside the middle of what it names, on the side that lies higher or farther right. */
function placeName(text, places) {
  text.style.display = places.length ? "" : "none";
  if (!places.length) return;
  const [start, end] = [places[0], places[places.length - 1]];
  const along = Math.hypot(end[0] - start[0], end[1] - start[1]) || 1;
  const [across, up] = [(end[1] - start[1]) / along, (end[0] - start[0]) / along];
  const side = Math.abs(up) > 0.3 ? Math.sign(up) : Math.sign(across) || 1;
  text.setAttribute("x", (start[0] + end[0]) / 2 + 26 * across * side - 4);
  text.setAttribute("y", (start[1] + end[1]) / 2 - 26 * up * side + 4);
}

// --- what moves -------------------------------------------------------------------------------------------------------

const line = (places) => places.map(([x, y], n) => `${n ? "L" : "M"}${x.toFixed(2)},${y.toFixed(2)}`).join("");

function move() {
  if (!state.view) return;
  const there = new Map(built.pins.map(({ point }) => [point, lastPlace(point)]));
  const screen = (point) => {
    const found = there.get(point);
    return found ? toScreen(...found.place) : null;
  };
  const faulty = new Set((state.look?.faults ?? []).flatMap((fault) => fault.links));
  const frames = state.look?.frames;
  const reason = frames?.reasons?.[frames.why?.[state.frame] ?? 0];
  for (const name of reason?.links ?? []) faulty.add(name);
  for (const made of built.links) moveLink(made, there, screen, faulty);
  for (const made of built.guides) moveGuide(made, screen);
  for (const { point, group } of built.grounds) {
    const p = screen(point);
    group.setAttribute("transform", p ? `translate(${p[0]},${p[1]})` : "translate(-999,-999)");
  }
  for (const { point, group } of built.pins) {
    const p = screen(point);
    group.setAttribute("transform", p ? `translate(${p[0].toFixed(2)},${p[1].toFixed(2)})` : "translate(-999,-999)");
    group.classList.toggle("chosen", state.chosen?.kind === "point" && state.chosen.name === point);
    const found = there.get(point);
    const joined = linksAt(point).map((link) => link.label).join(", ");
    group.setAttribute("aria-label", found ? `${word("point")} ${point}: ${shown(found.place[0], 5)}, ${shown(found.place[1], 5)} (${joined})` : point);
  }
  moveActing();
  moveDriver(screen);
  moveNames(screen);
}

/** Names of points, after all that they must not cover has its place. */
function moveNames(screen) {
  const there = built.pins.filter(({ point }) => screen(point));
  const points = there.map((pin) => ({ place: screen(pin.point), fixed: linkNamed(ground())?.points.includes(pin.point), side: pin.side }));
  const outlines = built.links.map(({ link }) => {
    const corners = link.points.map(screen).filter(Boolean);
    return { corners: corners.length > 2 ? [...corners, corners[0]] : corners, half: BAR / 2 };
  });
  const thin = [...acting.map((each) => each.shown ?? []), driveLine].map((corners) => ({ corners, half: THIN / 2 }));
  const found = sides(points, [...outlines, ...built.guides.flatMap((each) => each.taken), ...thin]);
  for (const [n, pin] of there.entries()) {
    pin.side = found[n];
    pin.text.setAttribute("x", pin.side[0].toFixed(1));
    pin.text.setAttribute("y", (pin.side[1] + MIDDLE).toFixed(1));
  }
}

function moveLink(made, there, screen, faulty) {
  const { link, group } = made;
  const places = link.points.map(screen).filter(Boolean);
  const lost = link.points.some((point) => there.get(point)?.lost);
  group.classList.toggle("lost", lost);
  group.classList.toggle("wrong", faulty.has(link.name));
  group.classList.toggle("driven", state.look?.driver?.link === link.name);
  group.classList.toggle("chosen", state.chosen?.kind === "link" && state.chosen.name === link.name);
  if (!places.length) return;
  const path = line(places) + (places.length > 2 ? "Z" : "");
  made.back?.setAttribute("d", path);
  made.front?.setAttribute("d", path);
  made.grab.setAttribute("d", path);
  const middle = [0, 1].map((axis) => places.reduce((sum, p) => sum + p[axis], 0) / places.length);
  made.number.setAttribute("x", middle[0]);
  made.number.setAttribute("y", middle[1]);
  made.number.style.display = places.length > 1 ? "" : "none";
}

/** Moves a guide and its block, and keeps in `taken` what they cover, for the names. */
function moveGuide(made, screen) {
  const { joint, group, line: guide, hatch, block, holder } = made;
  made.taken = [];
  const columns = state.look?.frames?.lines?.[joint.name];
  const point = screen(joint.point);
  const direction = columns ? at(columns[2]) : null;
  const hidden = !columns || !point || direction === null || at(columns[0]) === null;
  group.style.display = holder.style.display = hidden ? "none" : "";
  if (hidden) return;
  const start = toScreen(at(columns[0]), at(columns[1]));
  const along = [Math.cos(direction), -Math.sin(direction)];
  const far = (p) => (p[0] - start[0]) * along[0] + (p[1] - start[1]) * along[1];
  const s = far(point);
  const onGround = joint.on === ground();
  const owned = onGround ? [] : (linkNamed(joint.on)?.points ?? []).map(screen).filter(Boolean);
  const reached = [...owned.map(far), ...reach(joint, far)];
  const from = Math.min(onGround ? -20 : s, s - 30, ...reached);
  const to = Math.max(onGround ? 60 : s, s + 30, ...reached);
  const spot = (distance, across = 0) => [start[0] + along[0] * distance - along[1] * across, start[1] + along[1] * distance + along[0] * across];
  if (joint.cylinder) return placeBlock(holder, block, joint, point, direction);
  const width = onGround ? 11 : SLOT;
  const both = [spot(from, width), spot(to, width), spot(from, -width), spot(to, -width)];
  const oneSided = onGround && joint.kind === "prismatic";
  guide.setAttribute("d", oneSided ? line(both.slice(0, 2)) : line(both.slice(0, 2)) + line(both.slice(2)));
  let marks = "";
  if (onGround) for (let d = from + 4; d < to; d += 9) marks += line([spot(d, width), spot(d - 5, width + HATCHED)]);
  hatch.setAttribute("d", marks);
  const [least, most] = [oneSided ? width : -width, onGround ? width + HATCHED : width];
  const [length, height] = BLOCKS[joint.kind];
  made.taken.push({ corners: [from, to].map((end) => spot(end, (least + most) / 2)), half: (most - least) / 2 });
  made.taken.push({ corners: [spot(s - length / 2), spot(s + length / 2)], half: height / 2 });
  placeBlock(holder, block, joint, point, direction);
}

/** The block of a sliding joint; of a cylinder it is what is taken hold of, seen only where it is chosen. */
function placeBlock(holder, block, joint, point, direction) {
  const degrees = (-direction * 180) / Math.PI;
  holder.setAttribute("transform", `translate(${point[0].toFixed(2)},${point[1].toFixed(2)}) rotate(${degrees.toFixed(2)})`);
  const [width, height] = BLOCKS[joint.kind];
  for (const [key, value] of Object.entries({ width, x: -width / 2, height, y: -height / 2 })) {
    block.setAttribute(key, value);
  }
  block.classList.toggle("chosen", state.chosen?.kind === "joint" && state.chosen.name === joint.name);
}

/** How far along a line that stays where it is its joint comes over all positions, in pixels from where it is measured. */
function reach(joint, far) {
  const columns = state.look.frames.lines[joint.name];
  const point = state.look.frames.points[joint.point];
  if (!point || columns[0].length > 1) return [];
  let [least, most] = [Infinity, -Infinity];
  const [xs, ys] = point;
  for (let n = 0; n < xs.length; n++) {
    if (xs[n] === null || ys[n] === null) continue;
    const s = far(toScreen(xs[n], ys[n]));
    least = Math.min(least, s - 30);
    most = Math.max(most, s + 30);
  }
  return most >= least ? [least, most] : [];
}

let driveLine = []; // where the driver's arrow is on the screen: no name stands on it

function moveDriver(screen) {
  layers.drive.replaceChildren();
  driveLine = [];
  const driver = state.look?.driver;
  if (!driver) return;
  const joint = state.look.joints.find((each) => each.name === driver.joint);
  if (joint) {
    const p = screen(joint.point);
    const columns = state.look.frames?.lines?.[joint.name];
    if (!p || !columns || at(columns[2]) === null) return;
    const degrees = (-at(columns[2]) * 180) / Math.PI;
    const [cos, sin] = [Math.cos(at(columns[2])), Math.sin(at(columns[2]))];
    driveLine = [-27, 27].map((along) => [p[0] + along * cos - 22 * sin, p[1] - along * sin - 22 * cos]);
    const holder = element("g", { transform: `translate(${p[0]},${p[1]}) rotate(${degrees}) translate(0,-22)` }, layers.drive);
    element("path", { class: "drive", d: "M-20,0H20" }, holder);
    element("path", { class: "drive-head", d: "M27,0L17,-5V5ZM-27,0L-17,-5V5Z" }, holder);
    return;
  }
  const pivot = driver.pivot ? screen(driver.pivot) : null;
  const link = state.look.links.find((each) => each.name === driver.link);
  const other = link?.points.find((point) => point !== driver.pivot);
  const end = other ? screen(other) : null;
  if (!pivot || !end) return;
  const angle = (Math.atan2(-(end[1] - pivot[1]), end[0] - pivot[0]) * 180) / Math.PI;
  const holder = element("g", { transform: `translate(${pivot[0]},${pivot[1]}) rotate(${-angle})` }, layers.drive);
  const [from, to] = [25, 115].map((degrees) => around([0, 0], degrees));
  driveLine = [25, 47, 70, 92, 115].map((degrees) => around(pivot, angle + degrees));
  element("path", { class: "drive", d: `M${from[0]},${from[1]}A26,26 0 0 0 ${to[0]},${to[1]}` }, holder);
  element("path", { class: "drive-head", d: "M0,-10L5,0H-5Z", transform: `translate(${to[0]},${to[1]}) rotate(-112)` }, holder);
}

/** A place of the driver's arc, seen from its pivot. */
const around = ([x, y], degrees) => [x + 26 * Math.cos((degrees * Math.PI) / 180), y - 26 * Math.sin((degrees * Math.PI) / 180)];

// --- paths ------------------------------------------------------------------------------------------------------------

function drawPaths() {
  for (const { point, line: path } of built.paths) {
    const [xs, ys] = state.look.frames.points[point] ?? [[], []];
    const chosen = state.chosen?.kind === "point" && state.chosen.name === point;
    path.classList.toggle("chosen", chosen);
    let d = "";
    if ((state.paths || chosen) && xs.length > 1) {
      let pen = "M";
      for (let n = 0; n < xs.length; n++) {
        if (xs[n] === null || ys[n] === null) {
          pen = "M";
          continue;
        }
        const [x, y] = toScreen(xs[n], ys[ys.length === 1 ? 0 : n]);
        d += `${pen}${x.toFixed(1)},${y.toFixed(1)}`;
        pen = "L";
      }
    }
    path.setAttribute("d", d);
  }
}

function all() {
  if (!state.view) return;
  drawGrid();
  drawPicture();
  build();
  buildActing();
  drawPaths();
  move();
}

on("look", () => {
  if (!state.view) return;
  build();
  buildActing();
  drawPaths();
  move();
});
on("view grid picture language", all);
on("frame", move);
on("chosen paths", () => {
  drawPaths();
  move();
});

// A sheet that becomes larger or smaller shows more or less at its right and below: what is there stays where it is, unless
// it would be hidden, as by the faults of a new drawing.
let extent = null;
new ResizeObserver(() => {
  const now = size();
  if (extent && state.view) {
    state.view.x += (now.width - extent.width) / 2 / state.view.scale;
    state.view.y -= (now.height - extent.height) / 2 / state.view.scale;
  }
  const before = extent?.height ?? now.height;
  extent = now;
  if (now.height < before && state.view) keepInSight(before);
  all();
}).observe(canvas);
