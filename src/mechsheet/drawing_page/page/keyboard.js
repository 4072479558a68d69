// The drawing by the keyboard: arrows, Enter, Escape, Delete; the keys of the tools.

import { Latest } from "./asking.js";
import { lastPlace } from "./geometry.js";
import { play, show } from "./motion.js";
import { changed, state } from "./state.js";
import { advise, choose, click, drawBand, drawn, remove, rename, target, tool, TOOLS } from "./tools.js";
import { canvas, shift, snapped, spacing, toScreen, zoom } from "./view.js";
import { order } from "./work.js";

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
      if (drawn.cursor) click(target(...toScreen(...drawn.cursor), { altKey: event.altKey }));
      else if (point) click(tool().hits.includes("point") ? { point } : target(...toScreen(...lastPlace(point).place)));
    } else if (point) {
      state.chosen = { kind: "point", name: point };
      changed("chosen");
    } else play();
  } else if (event.key === "Escape") {
    if (drawn.ends.length || drawn.cursor) {
      drawn.ends = [];
      drawn.cursor = null;
      drawBand();
      advise();
    } else choose("shape");
  } else if (event.key === "F2") {
    if (point) rename({ kind: "point", name: point });
    else if (["point", "link"].includes(state.chosen?.kind)) rename(state.chosen);
  } else if (event.key === "Delete" || event.key === "Backspace") {
    if (point) remove({ kind: "point", name: point });
    else if (state.chosen) remove(state.chosen);
  } else if (event.key === "+" || event.key === "-") zoom(event.key === "+" ? 1.25 : 0.8);
});

function moveCursor(arrow, by, point) {
  const { step } = spacing();
  const start = drawn.cursor ?? (point ? lastPlace(point).place : [state.view.x, state.view.y].map((each) => Math.round(each / step) * step));
  drawn.cursor = snapped([start[0] + arrow[0] * by, start[1] + arrow[1] * by], false);
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
