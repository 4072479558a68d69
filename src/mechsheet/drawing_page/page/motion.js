// The position shown: a slider over the driver's values, and the motion as time goes by.

import { icon } from "./icons.js";
import { word } from "./language.js";
import { changed, keep, on, state } from "./state.js";
import { shown } from "./geometry.js";

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
  const value = state.look?.solved && driver ? `${driver.symbol.replace("theta", "θ")} = ${shown(state.look.frames.driver[state.frame], 5)}${space(driver.unit)}` : "";
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

/** A sweep that comes round begins anew, another one goes back. */
function comesRound() {
  const { driver, why, points } = state.look.frames;
  if (why.some(Boolean)) return false;
  const last = driver.length - 1;
  const spans = Object.values(points).flatMap((columns) => columns.map((column) => (column.length > 1 ? Math.abs(column[0] - column[last]) : 0)));
  const size = Math.max(...Object.values(points).flatMap(([xs]) => xs.map((x) => Math.abs(x ?? 0))), 1e-9);
  return Math.max(...spans) < 1e-3 * size;
}

function tick(now) {
  if (!state.playing) return;
  const last = count() - 1;
  const passed = ((now - began) / (SECONDS * 1000)) * last;
  let next = from + way * passed;
  if (comesRound()) next = ((next % last) + last) % last;
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
on("look", drawGaps);
on("look frame language", update);
