// The curves of variables and outputs over the driver, with a line at the position shown.

import { escaped, shown, symbol } from "./geometry.js";
import { note, word } from "./language.js";
import { show } from "./motion.js";
import { keep, on, state } from "./state.js";

const curves = document.getElementById("curves");
const WIDTH = 420;
const HEIGHT = 168;
const MARGIN = { left: 46, right: 10, top: 12, bottom: 22 };
const DASHES = ["", "6 3", "2 3", "9 3 2 3"];
let cursors = [];

function chosenCurves() {
  const there = state.look?.curves ?? [];
  if (state.curves) return there.filter(({ symbol: name }) => state.curves.includes(name));
  const outputs = there.filter(({ role }) => role === "output");
  const plain = there.filter(({ role }) => role === "variable");
  return [...plain.slice(0, 3), ...outputs.slice(0, 2)];
}

/** Draw them, unless they are hidden. */
export function drawCurves() {
  if (curves.hidden) return;
  curves.replaceChildren();
  cursors = [];
  const there = state.look?.curves ?? [];
  if (!there.length) {
    curves.append(note(word("curves.none")));
    return;
  }
  const picked = chosenCurves();
  const chips = document.createElement("div");
  chips.className = "row chips";
  for (const { symbol: name, label } of there) {
    const chip = document.createElement("button");
    chip.innerHTML = symbol(name);
    chip.title = label;
    chip.setAttribute("aria-label", `${name}: ${label}`);
    chip.setAttribute("aria-pressed", String(picked.some((each) => each.symbol === name)));
    chip.addEventListener("click", () => {
      const now = chosenCurves().map((each) => each.symbol);
      state.curves = now.includes(name) ? now.filter((each) => each !== name) : [...now, name];
      keep();
      drawCurves();
    });
    chips.append(chip);
  }
  curves.append(chips);
  const units = [...new Set(picked.map(({ unit }) => unit))];
  for (const unit of units) curves.append(...chart(picked.filter((each) => each.unit === unit), unit));
  moveCursors();
}

function chart(drawn, unit) {
  const driver = state.look.frames.driver;
  const all = drawn.flatMap(({ values }) => values.filter((each) => each !== null));
  let [low, high] = [Math.min(...all), Math.max(...all)];
  if (high - low < 1e-9 * Math.max(1, Math.abs(high))) [low, high] = [low - 1, high + 1];
  const x = (n) => MARGIN.left + ((driver[n] - driver[0]) / (driver[driver.length - 1] - driver[0] || 1)) * (WIDTH - MARGIN.left - MARGIN.right);
  const y = (value) => HEIGHT - MARGIN.bottom - ((value - low) / (high - low)) * (HEIGHT - MARGIN.top - MARGIN.bottom);
  const lines = drawn.map(({ values }, index) => {
    let d = "";
    let pen = "M";
    values.forEach((value, n) => {
      if (value === null) pen = "M";
      else {
        d += `${pen}${x(n).toFixed(1)},${y(value).toFixed(1)}`;
        pen = "L";
      }
    });
    return `<path class="curve" d="${d}" stroke-dasharray="${DASHES[index % DASHES.length]}"/>`;
  });
  const ends = `<text x="${MARGIN.left}" y="${HEIGHT - 6}">${shown(driver[0], 4)}</text><text x="${WIDTH - MARGIN.right}" y="${HEIGHT - 6}" text-anchor="end">${shown(driver[driver.length - 1], 4)}${escaped(state.look.driver?.unit ?? "")}</text>`;
  const scale = `<text x="${MARGIN.left - 4}" y="${MARGIN.top + 4}" text-anchor="end">${shown(high, 3)}</text><text x="${MARGIN.left - 4}" y="${HEIGHT - MARGIN.bottom}" text-anchor="end">${shown(low, 3)}</text>`;
  const frame = `<path class="axis" d="M${MARGIN.left},${MARGIN.top}V${HEIGHT - MARGIN.bottom}H${WIDTH - MARGIN.right}"/>`;
  const head = document.createElement("p");
  head.className = "part";
  const holder = document.createElement("div");
  holder.innerHTML = `<svg class="chart" viewBox="0 0 ${WIDTH} ${HEIGHT}" preserveAspectRatio="none" role="img">${frame}${lines.join("")}<path class="here"/>${ends}${scale}</svg>`;
  const svg = holder.firstChild;
  svg.setAttribute("aria-label", drawn.map((each) => each.symbol).join(", "));
  svg.addEventListener("pointerdown", (event) => {
    const box = svg.getBoundingClientRect();
    const part = (((event.clientX - box.left) / box.width) * WIDTH - MARGIN.left) / (WIDTH - MARGIN.left - MARGIN.right);
    show(Math.round(Math.max(0, Math.min(1, part)) * (driver.length - 1)));
  });
  cursors.push(() => {
    svg.querySelector(".here").setAttribute("d", `M${x(state.frame)},${MARGIN.top}V${HEIGHT - MARGIN.bottom}`);
    head.innerHTML = drawn
      .map(({ symbol: name, values }, index) => `<svg width="26" height="8" aria-hidden="true"><path d="M0,4H26" class="curve" stroke="currentColor" stroke-width="1.7" stroke-dasharray="${DASHES[index % DASHES.length]}"/></svg> ${symbol(name)} = ${shown(values[state.frame], 5)}${unit === "°" ? "°" : ` ${escaped(unit)}`}`)
      .join(" &nbsp; ");
  });
  return [head, svg];
}

const moveCursors = () => cursors.forEach((each) => each());

on("look language", drawCurves);
on("frame", () => {
  if (!curves.hidden) moveCursors();
});
