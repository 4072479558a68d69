"use strict";
// Shows the positions that stand in the page: every number is the workbook's, nothing is computed here.
const data = JSON.parse(document.getElementById("positions").textContent);
const slider = document.getElementById("slider");
const button = document.getElementById("play");
const shown = document.getElementById("shown");
const last = data.captions.length - 1;
const FINE = 100; // places are hundredths of a pixel
const INTERVAL = 40; // milliseconds from one step of the animation to the next
const STEP = Math.max(1, Math.round(data.captions.length / 150)); // a run takes about six seconds at most
const moves = data.moves.map(([id, kind, frames]) => ({ element: document.getElementById(id), kind, frames }));

function pathData(places) {
  let path = "", pen = "M";
  for (let i = 0; i < places.length; i += 2) {
    if (places[i] === null) { pen = "M"; continue; }
    path += pen + places[i] / FINE + " " + places[i + 1] / FINE;
    pen = "L";
  }
  return path;
}

function place(element, names, x, y) {
  element.setAttribute("visibility", x === null ? "hidden" : "visible");
  if (x === null) return;
  element.setAttribute(names[0], x / FINE);
  element.setAttribute(names[1], y / FINE);
}

const change = {
  path: (element, places) => element.setAttribute("d", pathData(places)),
  dots: (element, places) => [...element.children].forEach(
    (circle, i) => place(circle, ["cx", "cy"], places[2 * i], places[2 * i + 1])),
  label: (element, places) => place(element, ["x", "y"], places[0], places[1]),
  words: (element, words) => { element.textContent = words; },
};

function show(position) {
  slider.value = position;
  slider.setAttribute("aria-valuetext", data.captions[position]);
  shown.textContent = data.captions[position];
  for (const { element, kind, frames } of moves) change[kind](element, frames[position]);
}

let timer = null, direction = 1;

function step() {
  let next = Number(slider.value) + direction * STEP;
  if (data.round) {
    next %= last; // the last position looks like the first
  } else if (next > last || next < 0) {
    direction = -direction;
    next = Math.min(Math.max(next, 0), last);
  }
  show(next);
}

function play(on) {
  if (timer !== null) clearInterval(timer);
  timer = on ? setInterval(step, INTERVAL) : null;
  button.textContent = on ? data.pause : data.play;
}

function showAddressed() { // page.html#at=60: the position nearest to that value of the driver
  const match = /^#at=(.+)$/.exec(decodeURIComponent(location.hash));
  const wanted = match ? Number(match[1]) : NaN;
  if (!Number.isFinite(wanted)) return;
  let best = 0;
  data.driver.forEach((value, i) => {
    if (Math.abs(value - wanted) < Math.abs(data.driver[best] - wanted)) best = i;
  });
  play(false);
  show(best);
}

slider.addEventListener("input", () => { play(false); show(Number(slider.value)); });
slider.addEventListener("change", () => history.replaceState(null, "", "#at=" + data.driver[slider.value]));
button.addEventListener("click", () => play(timer === null));
window.addEventListener("hashchange", showAddressed);
show(Number(slider.value)); // a browser may have kept the slider's place from the last visit
showAddressed();
