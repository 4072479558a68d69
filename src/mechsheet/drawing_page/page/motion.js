// The position shown: a slider over the driver's values, and the motion as time goes by.

import { icon } from "./icons.js";
import { distance, greek, place, shown } from "./geometry.js";
import { word } from "./language.js";
import { changed, keep, on, state } from "./state.js";

const slider = document.getElementById("position");
const button = document.getElementById("play");
const reading = document.getElementById("reading");
const gaps = document.getElementById("gaps");
const SECONDS = 5; // for the whole sweep

const count = () => state.look?.frames?.driver?.length ?? 1;

/** Show a position by its number. */
export function show(frame) {
  state.frame = Math.max(0, Math.min(count() - 1, frame));
  if (state.look?.solved) state.at = state.look.frames.driver[state.frame];
  changed("frame");
}

function update() {
  const driver = state.look?.driver;
  slider.max = count() - 1;
  slider.value = state.frame;
  slider.disabled = button.disabled = count() < 2;
  const value = state.look?.solved && driver ? `${greek(driver.symbol)} = ${shown(state.look.frames.driver[state.frame], 5)}${space(driver.unit)}` : "";
  reading.textContent = value;
  slider.setAttribute("aria-valuetext", value);
}

const space = (unit) => (unit === "°" || !unit ? unit : ` ${unit}`);

/** Where the driver cannot be, as stretches below the slider. */
function drawGaps() {
  gaps.replaceChildren();
  const why = state.look?.frames?.why ?? [];
  for (let n = 0; n < why.length; n++) {
    if (!why[n]) continue;
    let end = n;
    while (end + 1 < why.length && why[end + 1]) end++;
    const made = document.createElement("i");
    made.style.left = `${(100 * Math.max(0, n - 0.5)) / Math.max(1, why.length - 1)}%`;
    made.style.width = `${(100 * (end - n + 1)) / Math.max(1, why.length - 1)}%`;
    gaps.append(made);
    n = end;
  }
}

// --- playing ----------------------------------------------------------------------------------------------------------

let began = 0;
let from = 0;
let way = 1;

export function play(on_ = !state.playing) {
  state.playing = on_ && count() > 1;
  button.replaceChildren(icon(state.playing ? "pause" : "play"));
  button.setAttribute("aria-label", word(state.playing ? "pause" : "play"));
  button.title = word(state.playing ? "pause" : "play");
  if (!state.playing) {
    keep();
    return;
  }
  began = performance.now();
  from = state.frame;
  way = 1;
  requestAnimationFrame(tick);
}

let round = false;

/** Whether the last position is the first one again: such a sweep begins anew, another one goes back. */
function lastIsFirst() {
  const { driver = [], why = [], points = {} } = state.look?.frames ?? {};
  const last = driver.length - 1;
  if (last < 1 || why.some(Boolean)) return false;
  const columns = Object.values(points).flat();
  const size = Math.max(...columns.flat().map(Math.abs), 1e-9);
  return columns.every((column) => column.length < 2 || Math.abs(column[0] - column[last]) < 1e-3 * size);
}

/** The position in which a point is nearest to a place, from the present one on: the motion goes no other way. */
export function nearest(point, wanted) {
  const frames = count();
  const away = (frame) => {
    const there = place(point, frame);
    return there ? distance(there, wanted) : Infinity;
  };
  let [best, least] = [state.frame, Infinity];
  const most = Math.ceil(frames / 6);
  for (let step = -most; step <= most; step++) {
    let frame = state.frame + step;
    if (frame < 0 || frame >= frames) {
      if (!round) continue;
      frame = (frame + frames - 1) % (frames - 1);
    }
    const found = away(frame) * (1 + 0.002 * Math.abs(step));
    if (found < least) [best, least] = [frame, found];
  }
  return best;
}

function tick(now) {
  if (!state.playing) return;
  const last = count() - 1;
  const passed = ((now - began) / (SECONDS * 1000)) * last;
  let next = from + way * passed;
  if (round) next = ((next % last) + last) % last;
  else {
    const wave = ((next % (2 * last)) + 2 * last) % (2 * last);
    next = wave > last ? 2 * last - wave : wave;
  }
  const frame = Math.round(next);
  if (frame !== state.frame) show(frame);
  requestAnimationFrame(tick);
}

slider.addEventListener("input", () => {
  play(false);
  show(Number(slider.value));
});
slider.addEventListener("change", keep);
button.addEventListener("click", () => play());
on("look", () => {
  round = lastIsFirst();
  drawGaps();
});
on("look frame language", update);
