// The text beside the drawing: numbered lines, quiet colours, faults at their lines.

import { escaped } from "./geometry.js";
import { on, remember, state } from "./state.js";
import { setText } from "./work.js";

const area = document.getElementById("text");
const colours = document.getElementById("colours");
const lines = document.getElementById("lines");
const PAUSE = 250; // milliseconds after the last key
const STEP = 1200; // so long a pause begins another step to undo

let waiting = 0;
let typed = 0;

const PIECES = /(?<comment>#[^\n]*)|(?<heading>^[ \t]*\[\[?[^\]\n]*\]\]?)|(?<string>"(?:[^"\\\n]|\\.)*"|'[^'\n]*')|(?<number>(?<![\w.])[+-]?\d[\d_]*(?:\.\d+)?(?:[eE][+-]?\d+)?(?![\w.]))/gm;

/** What is to be told: of a sheet that is still empty nothing is wrong. */
export function told() {
  const look = state.look;
  return !look || (look.readable && (look.links ?? []).length < 2) ? [] : look.faults;
}

function paint() {
  const wrong = new Set(told().map((fault) => fault.line).filter(Boolean));
  let html = "";
  let end = 0;
  for (const found of area.value.matchAll(PIECES)) {
    const kind = Object.keys(found.groups).find((name) => found.groups[name] !== undefined);
    html += escaped(area.value.slice(end, found.index)) + `<span class="t-${kind}">${escaped(found[0])}</span>`;
    end = found.index + found[0].length;
  }
  html += escaped(area.value.slice(end));
  const rows = html.split("\n");
  colours.innerHTML = rows.map((row, n) => (wrong.has(n + 1) && row ? `<span class="t-wrong">${row}</span>` : row)).join("\n") + "\n";
  lines.innerHTML = rows.map((_, n) => (wrong.has(n + 1) ? `<b>${n + 1}</b>` : n + 1)).join("\n");
  follow();
}

function follow() {
  colours.scrollTop = lines.scrollTop = area.scrollTop;
  colours.scrollLeft = area.scrollLeft;
}

/** Go to a line, counted from 1. */
export function goTo(number) {
  const rows = area.value.split("\n");
  const start = rows.slice(0, number - 1).reduce((sum, row) => sum + row.length + 1, 0);
  area.focus();
  area.setSelectionRange(start, start + (rows[number - 1] ?? "").length);
  const height = parseFloat(getComputedStyle(area).lineHeight);
  area.scrollTop = Math.max(0, (number - 4) * height);
  follow();
}

area.addEventListener("input", () => {
  const now = performance.now();
  if (now - typed > STEP) remember();
  typed = now;
  paint();
  clearTimeout(waiting);
  waiting = setTimeout(() => setText(area.value), PAUSE);
  state.text = area.value;
});
area.addEventListener("scroll", follow);

on("text", () => {
  typed = 0;
  if (area.value !== state.text) {
    const { scrollTop, selectionStart, selectionEnd } = area;
    area.value = state.text;
    area.setSelectionRange(selectionStart, selectionEnd);
    area.scrollTop = scrollTop;
  }
  paint();
});
on("look", paint);
