// What a mouse or a finger does on the sheet: clicks of a tool, points and links that are dragged, the sheet moved and zoomed.

import { distance } from "./geometry.js";
import { hit, pointOf } from "./hitting.js";
import { nearest, play, show } from "./motion.js";
import { changed, state } from "./state.js";
import { click, drawBand, drawn, rename, target, tool } from "./tools.js";
import { canvas, pointer, shift, snapped, toPlane, zoom } from "./view.js";
import { Drag } from "./work.js";

let drag = null; // what a pressed pointer does

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
  drawn.cursor = null;
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

canvas.addEventListener("dblclick", (event) => {
  const found = tool().clicks ? null : hit(...pointer(event), ["point", "link"]);
  if (found) rename(found.point ? { kind: "point", name: found.point } : { kind: "link", name: found.link });
});
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
