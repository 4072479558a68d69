// Between lengths and pixels: the sheet shows a window of the plane, y upwards.

import { cornersOf } from "./geometry.js";
import { state, changed } from "./state.js";

const EDGE = 40; // pixels that the ground's hatching and a name take below a point
const BUTTONS = 48; // pixels at the right that the buttons over the sheet take

export const canvas = document.getElementById("canvas");

export function size() {
  return { width: canvas.clientWidth || 800, height: canvas.clientHeight || 600 };
}

/** A place of the plane in pixels. */
export function toScreen(x, y) {
  const { width, height } = size();
  const { x: mx, y: my, scale } = state.view;
  return [width / 2 + (x - mx) * scale, height / 2 - (y - my) * scale];
}

/** Pixels as a place of the plane. */
export function toPlane(px, py) {
  const { width, height } = size();
  const { x: mx, y: my, scale } = state.view;
  return [mx + (px - width / 2) / scale, my - (py - height / 2) / scale];
}

/** Where on the sheet a pointer is, in pixels. */
export function pointer(event) {
  const box = canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** The lines of the grid: the distance of neighbours, and how many of them make a strong one. */
export function spacing() {
  const wanted = 22 / state.view.scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const part = wanted / power;
  const [step, strong] = part <= 1 ? [1, 10] : part <= 2 ? [2, 5] : part <= 5 ? [5, 4] : [10, 10];
  return { step: step * power, strong };
}

/** The length to which a dragged point is rounded: the grid, or a fine part of it. */
export function snapped(place, toGrid) {
  const { step } = spacing();
  const by = toGrid ? step : 10 ** Math.floor(Math.log10(1.5 / state.view.scale));
  const digits = Math.max(0, 1 - Math.floor(Math.log10(by)));
  return place.map((each) => Number((Math.round(each / by) * by).toFixed(Math.min(digits, 12))));
}

export function zoom(factor, px = size().width / 2, py = size().height / 2) {
  const [x, y] = toPlane(px, py);
  state.view.scale = Math.min(1e7, Math.max(1e-7, state.view.scale * factor));
  const [nx, ny] = toPlane(px, py);
  state.view.x += x - nx;
  state.view.y += y - ny;
  changed("view");
}

export function shift(dx, dy) {
  state.view.x -= dx / state.view.scale;
  state.view.y += dy / state.view.scale;
  changed("view");
}

/** Where a shape comes over all positions. */
function reached(shape) {
  const moves = shape.places.some((vector) => vector.some((column) => column.length > 1));
  const frames = moves ? state.look.frames.driver.map((_, frame) => frame) : [0];
  return frames.flatMap((frame) => cornersOf(shape, frame));
}

/** The box around all that the mechanism reaches: left, right, low and high; left beyond right where nothing is drawn. */
function box() {
  let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [xs, ys] of Object.values(state.look?.frames?.points ?? {})) {
    for (const x of xs) if (x !== null) [left, right] = [Math.min(left, x), Math.max(right, x)];
    for (const y of ys) if (y !== null) [low, high] = [Math.min(low, y), Math.max(high, y)];
  }
  for (const shape of state.look?.shapes ?? []) {
    for (const [x, y] of reached(shape)) {
      [left, right, low, high] = [Math.min(left, x), Math.max(right, x), Math.min(low, y), Math.max(high, y)];
    }
  }
  return [left, right, low, high];
}

/** Raise what was in sight on a sheet so many pixels high and would now be below its edge, or show it smaller. */
export function keepInSight(before) {
  const [left, right, low, high] = box();
  if (!(left <= right)) return;
  const now = size().height;
  const [above, below] = [toScreen(0, high)[1], toScreen(0, low)[1]];
  if (below > before || below <= now - EDGE) return;
  const over = below - now + EDGE;
  if (above - over >= document.getElementById("advice").offsetHeight) shift(0, -over);
  else fit();
}

/** Show all that the mechanism reaches, below the advice and beside the buttons. */
export function fit() {
  let [left, right, low, high] = box();
  if (!(left <= right)) [left, right, low, high] = [-20, 120, -20, 80];
  const { width: whole, height: tall } = size();
  const above = document.getElementById("advice").offsetHeight;
  const [width, height] = [whole - BUTTONS, tall - above];
  const span = Math.max(right - left, high - low, 1e-6);
  const room = 1.28;
  const scale = Math.min(
    width / (room * Math.max(right - left, span * 0.15)),
    height / (room * Math.max(high - low, span * 0.15)),
  );
  state.view = { x: (left + right + BUTTONS / scale) / 2, y: (low + high + above / scale) / 2, scale };
  changed("view");
}
