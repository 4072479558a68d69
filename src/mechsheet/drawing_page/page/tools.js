// The tools, and what a mouse, a finger or the keyboard does on the sheet with each of them.

import { Latest } from "./asking.js";
import { icon } from "./icons.js";
import { distance, fromStretch, ground, lastPlace, place } from "./geometry.js";
import { word } from "./language.js";
import { play, show } from "./motion.js";
import { scalePicture } from "./picture.js";
import { band, element } from "./scene.js";
import { changed, on, state } from "./state.js";
import { canvas, pointer, shift, snapped, spacing, toPlane, toScreen, zoom } from "./view.js";
import { Drag, order, say } from "./work.js";

/** Name, key, and what a click may hit: points, links, sliding joints; how many clicks it takes. */
const TOOLS = [
  { name: "shape", key: "v" },
  { name: "turn", key: "t" },
  { name: "ground", key: "g", clicks: 1, hits: ["point"] },
  { name: "link", key: "l", clicks: 2, hits: ["point"] },
  { name: "plate", key: "p", clicks: 2, hits: ["link", "point"] },
  { name: "slider", key: "s", clicks: 2, hits: ["point", "link"] },
  { name: "slot", key: "o", clicks: 2, hits: ["point", "link"] },
  { name: "driver", key: "d", clicks: 1, hits: ["link", "joint"] },
  { name: "delete", key: "x", clicks: 1, hits: ["point", "link", "joint"] },
];
const SCALE = { name: "scale", clicks: 2, hits: [] };

const tool = () => (state.tool === "scale" ? SCALE : TOOLS.find((each) => each.name === state.tool));
let ends = []; // what was clicked so far with the present tool
let cursor = null; // the keyboard's place on the sheet
let drag = null; // what a pressed pointer does

// --- the row of tools -------------------------------------------------------------------------------------------------

function buildTools() {
  const holder = document.getElementById("tools");
  holder.replaceChildren();
  for (const { name, key } of TOOLS) {
    const button = document.createElement("button");
    button.id = `tool-${name}`;
    button.title = `${word(`tool.${name}.hint`)} (${key.toUpperCase()})`;
    button.setAttribute("aria-keyshortcuts", key.toUpperCase());
    const text = document.createElement("span");
    text.className = "label";
    text.textContent = word(`tool.${name}`);
    button.setAttribute("aria-label", word(`tool.${name}`));
    button.append(icon(name), text);
    button.addEventListener("click", () => choose(name));
    holder.append(button);
  }
  mark();
}

function mark() {
  for (const { name } of TOOLS) document.getElementById(`tool-${name}`)?.setAttribute("aria-pressed", String(name === state.tool));
  canvas.dataset.tool = state.tool;
  advise();
}

function choose(name) {
  if (name === "delete" && state.chosen && state.tool === "shape") {
    remove(state.chosen);
    return;
  }
  state.tool = name;
  ends = [];
  cursor = null;
  drawBand();
  changed("tool");
}

/** What to do next, in one line. */
function advise() {
  const empty = !(state.look?.links ?? []).some((link) => link.points.length);
  const key = tool().clicks ? `tool.${state.tool}.step${ends.length + 1}` : empty ? "empty" : `tool.${state.tool}.hint`;
  say(word(key));
}

// --- what lies under a place ------------------------------------------------------------------------------------------

function hit(px, py, kinds, touch = false) {
  const p = [px, py];
  const near = touch ? 24 : 14;
  if (kinds.includes("point")) {
    let best = null;
    for (const name of Object.keys(state.look?.frames?.points ?? {})) {
      const there = lastPlace(name);
      const away = there ? distance(toScreen(...there.place), p) : Infinity;
      if (away <= near && (!best || away < best.away)) best = { point: name, away };
    }
    if (best) return { point: best.point };
  }
  if (kinds.includes("joint")) {
    for (const joint of state.look?.joints ?? []) {
      const there = lastPlace(joint.point);
      if (there && distance(toScreen(...there.place), p) <= near + 6) return { joint: joint.name };
    }
  }
  if (kinds.includes("link")) {
    for (const link of [...(state.look?.links ?? [])].reverse()) {
      if (link.name !== ground() && onLink(link, p, near)) return { link: link.name };
    }
  }
  return null;
}

function onLink(link, p, near) {
  const corners = link.points.map(lastPlace).filter(Boolean).map((there) => toScreen(...there.place));
  if (corners.length === 1) return distance(corners[0], p) <= near;
  let inside = false;
  for (let n = 0; n < corners.length; n++) {
    const [a, b] = [corners[n], corners[(n + 1) % corners.length]];
    if (fromStretch(p, a, b) <= near) return true;
    if (a[1] > p[1] !== b[1] > p[1] && p[0] < ((b[0] - a[0]) * (p[1] - a[1])) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside && corners.length > 2;
}

/** What a click of the present tool means: what it hits, or the place. */
function target(px, py, event = {}) {
  const kinds = tool().name === "plate" ? (ends.length ? ["point"] : ["link"]) : tool().hits;
  const first = (tool().name === "slider" || tool().name === "slot") && !ends.length ? ["point"] : kinds;
  const found = hit(px, py, first, event.pointerType === "touch");
  if (found) return found;
  return { at: snapped(toPlane(px, py), state.grid && !event.altKey) };
}

const placeOf = (end) => (end.at ? end.at : end.point ? lastPlace(end.point)?.place : null);

// --- clicks of a drawing tool -----------------------------------------------------------------------------------------

async function click(end) {
  const { name, clicks } = tool();
  if ((name === "driver" || name === "delete") && end.at) return;
  if (name === "plate" && !ends.length && !end.link) return;
  ends.push(end);
  if (ends.length < clicks) {
    drawBand();
    advise();
    return;
  }
  const [first, second] = ends;
  ends = [];
  drawBand();
  const orders = {
    ground: () => ({ do: "ground", end: first }),
    link: () => ({ do: "link", ends: [first, second] }),
    plate: () => ({ do: "plate", link: first.link, end: second }),
    slider: () => ({ do: "slide", kind: "prismatic", end: first, on: second }),
    slot: () => ({ do: "slide", kind: "pin-slot", end: first, on: second }),
    driver: () => ({ do: "driver", ...first }),
    delete: () => ({ do: "delete", ...first }),
  };
  if (name === "scale") {
    choose("shape");
    await scalePicture(first.at, second.at);
    return;
  }
  if (await order(orders[name]())) advise();
}

function remove(chosen) {
  state.chosen = null;
  order({ do: "delete", [chosen.kind]: chosen.name });
}

function drawBand(to = null) {
  band.replaceChildren();
  const shownCursor = cursor ? toScreen(...cursor) : null;
  const first = ends.length ? placeOf(ends[0]) : null;
  const end = to ?? shownCursor;
  if (first && end) {
    const start = toScreen(...first);
    element("path", { class: "band", d: `M${start[0]},${start[1]}L${end[0]},${end[1]}` }, band);
    element("circle", { class: "ring", cx: start[0], cy: start[1], r: 9 }, band);
  }
  if (to && tool().clicks) {
    const found = target(to[0], to[1]);
    const there = placeOf(found);
    if (there) {
      const p = toScreen(...there);
      element("circle", { class: "ring", cx: p[0], cy: p[1], r: found.point ? 11 : 4 }, band);
    }
  }
  if (shownCursor) {
    const [x, y] = shownCursor;
    element("path", { class: "cross", d: `M${x - 14},${y}h28M${x},${y - 14}v28` }, band);
  }
}

// --- pointers ---------------------------------------------------------------------------------------------------------

const fingers = new Map();

canvas.addEventListener("pointerdown", (event) => {
  if (event.button > 1) return;
  canvas.setPointerCapture(event.pointerId);
  const p = pointer(event);
  fingers.set(event.pointerId, p);
  if (fingers.size === 2) {
    drag = { kind: "pinch", span: span(), middle: middle() };
    return;
  }
  cursor = null;
  const touch = event.pointerType === "touch";
  if (event.button === 1) {
    drag = { kind: "pan", last: p };
    return;
  }
  if (tool().clicks) {
    drag = { kind: "click", start: p };
    return;
  }
  const found = hit(...p, state.tool === "turn" ? ["point", "link"] : ["point", "joint", "link"], touch);
  const kind = found && Object.keys(found)[0];
  state.chosen = found ? { kind, name: found[kind] } : null;
  changed("chosen");
  if (found && state.tool === "turn") {
    play(false);
    drag = { kind: "turn", point: found.point ?? pointOf(found.link, p) };
  } else if (kind === "point") {
    play(false);
    drag = { kind: "shape", point: found.point, start: p, work: null };
    canvas.querySelector(`[data-point="${CSS.escape(found.point)}"]`)?.focus({ preventScroll: true });
  } else drag = { kind: "pan", last: p };
  event.preventDefault();
  if (kind !== "point") canvas.focus({ preventScroll: true });
});

canvas.addEventListener("pointermove", (event) => {
  const p = pointer(event);
  if (fingers.has(event.pointerId)) fingers.set(event.pointerId, p);
  if (!drag) {
    if (tool().clicks) drawBand(p);
    return;
  }
  if (drag.kind === "pinch" && fingers.size === 2) {
    const [now, there] = [span(), middle()];
    zoom(now / drag.span, ...there);
    shift(there[0] - drag.middle[0], there[1] - drag.middle[1]);
    Object.assign(drag, { span: now, middle: there });
  } else if (drag.kind === "pan") {
    shift(p[0] - drag.last[0], p[1] - drag.last[1]);
    drag.last = p;
  } else if (drag.kind === "turn") show(nearest(drag.point, toPlane(...p)));
  else if (drag.kind === "shape" && (drag.work || distance(p, drag.start) > 3)) {
    drag.work ??= new Drag(drag.point);
    drag.work.to(snapped(toPlane(...p), state.grid && !event.altKey));
  } else if (drag.kind === "click") drawBand(p);
});

function lift(event) {
  const p = fingers.get(event.pointerId);
  fingers.delete(event.pointerId);
  if (drag?.kind === "click" && p && event.type === "pointerup") click(target(...p, event));
  if (drag?.kind !== "pinch" || !fingers.size) drag = null;
}

canvas.addEventListener("pointerup", lift);
canvas.addEventListener("pointercancel", lift);
canvas.addEventListener("pointerleave", () => {
  if (!drag) drawBand();
});
canvas.addEventListener(
  "wheel",
  (event) => {
    event.preventDefault();
    zoom(Math.exp(-event.deltaY * (event.ctrlKey ? 0.01 : 0.0015)), ...pointer(event));
  },
  { passive: false },
);

const span = () => distance(...fingers.values()) || 1;
const middle = () => [0, 1].map((axis) => [...fingers.values()].reduce((sum, p) => sum + p[axis], 0) / fingers.size);

/** The point of a link that is nearest to a place on the sheet. */
function pointOf(name, p) {
  const link = state.look.links.find((each) => each.name === name);
  const away = (point) => distance(toScreen(...lastPlace(point).place), p);
  return link.points.filter(lastPlace).sort((a, b) => away(a) - away(b))[0];
}

/** The position in which a point is nearest to a place, from the present one on: the motion goes no other way. */
function nearest(point, wanted) {
  const frames = state.look.frames.driver.length;
  let [best, least] = [state.frame, Infinity];
  const away = (frame) => {
    const there = place(point, frame);
    return there ? distance(there, wanted) : Infinity;
  };
  const window_ = Math.ceil(frames / 6);
  for (let step = -window_; step <= window_; step++) {
    let frame = state.frame + step;
    if (frame < 0 || frame >= frames) {
      if (!round()) continue;
      frame = (frame + frames - 1) % (frames - 1);
    }
    const found = away(frame) * (1 + 0.002 * Math.abs(step));
    if (found < least) [best, least] = [frame, found];
  }
  return best;
}

const round = () => {
  const { driver, why } = state.look.frames;
  const turn = state.look.driver?.unit === "°" ? 360 : 2 * Math.PI;
  return !state.look.driver?.joint && !why.some(Boolean) && Math.abs(Math.abs(driver[driver.length - 1] - driver[0]) - turn) < 1e-6;
};

// --- the keyboard -----------------------------------------------------------------------------------------------------

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

canvas.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey) return;
  const point = event.target.dataset?.point;
  const arrow = ARROWS[event.key];
  if (arrow) {
    event.preventDefault();
    const by = spacing().step * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
    if (state.tool === "turn") show(state.frame + (arrow[0] + arrow[1]) * (event.shiftKey ? 10 : 1));
    else if (tool().clicks) moveCursor(arrow, by, point);
    else if (point) nudging.run(point, arrow, by);
    else shift(-arrow[0] * 40, arrow[1] * 40);
  } else if (event.key === "Enter" || event.key === " ") {
    event.preventDefault();
    if (tool().clicks) {
      if (cursor) click(target(...toScreen(...cursor), { altKey: event.altKey }));
      else if (point) click(tool().hits.includes("point") ? { point } : target(...toScreen(...lastPlace(point).place)));
    } else if (point) {
      state.chosen = { kind: "point", name: point };
      changed("chosen");
    } else play();
  } else if (event.key === "Escape") {
    if (ends.length || cursor) {
      ends = [];
      cursor = null;
      drawBand();
      advise();
    } else choose("shape");
  } else if (event.key === "Delete" || event.key === "Backspace") {
    if (point) remove({ kind: "point", name: point });
    else if (state.chosen) remove(state.chosen);
  } else if (event.key === "+" || event.key === "-") zoom(event.key === "+" ? 1.25 : 0.8);
});

function moveCursor(arrow, by, point) {
  const { step } = spacing();
  const start = cursor ?? (point ? lastPlace(point).place : [state.view.x, state.view.y].map((each) => Math.round(each / step) * step));
  cursor = snapped([start[0] + arrow[0] * by, start[1] + arrow[1] * by], false);
  drawBand();
}

const nudging = new Latest(async (point, arrow, by) => {
  const there = lastPlace(point)?.place;
  if (there) await order({ do: "move", point, to: snapped([there[0] + arrow[0] * by, there[1] + arrow[1] * by], false) });
});

canvas.addEventListener("focusin", (event) => {
  const point = event.target.dataset?.point;
  if (point && state.chosen?.name !== point) {
    state.chosen = { kind: "point", name: point };
    changed("chosen");
  }
});

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (/^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName) || document.querySelector("dialog[open]")) return;
  const found = TOOLS.find(({ key }) => key === event.key.toLowerCase());
  if (!found) return;
  event.preventDefault();
  choose(found.name);
  if (!canvas.contains(document.activeElement)) canvas.focus({ preventScroll: true });
});

on("language", buildTools);
on("tool", mark);
let empty = null;
on("look", () => {
  const now = !(state.look?.links ?? []).some((link) => link.points.length);
  if (now !== empty) advise();
  empty = now;
});
on("view", () => drawBand());
