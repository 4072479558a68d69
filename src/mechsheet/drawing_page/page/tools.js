// The tools, and what clicks with each of them mean.

import { icon } from "./icons.js";
import { lastPlace } from "./geometry.js";
import { hit } from "./hitting.js";
import { word } from "./language.js";
import { scalePicture } from "./picture.js";
import { band, element } from "./scene.js";
import { changed, on, state } from "./state.js";
import { canvas, snapped, toPlane, toScreen } from "./view.js";
import { confirmed, order, say } from "./work.js";

/** Name, key, and what a click may hit: points, links, sliding joints; how many clicks it takes; the first answer to its question
 * of size. */
export const TOOLS = [
  { name: "shape", key: "v" },
  { name: "turn", key: "t" },
  { name: "ground", key: "g", clicks: 1, hits: ["point"] },
  { name: "link", key: "l", clicks: 2, hits: ["point"] },
  { name: "plate", key: "p", clicks: 2, hits: ["link", "point"] },
  { name: "slider", key: "s", clicks: 2, hits: ["point", "link"] },
  { name: "slot", key: "o", clicks: 2, hits: ["point", "link"] },
  { name: "driver", key: "d", clicks: 1, hits: ["link", "joint"] },
  { name: "gear", key: "e", clicks: 2, hits: ["joint", "link"], size: "-1" },
  { name: "spring", key: "n", clicks: 2, hits: ["point"], size: "0.5" },
  { name: "damper", key: "m", clicks: 2, hits: ["point"], size: "0.1" },
  { name: "force", key: "f", clicks: 2, hits: ["point", "link"], size: "100" },
  { name: "torque", key: "q", clicks: 1, hits: ["link"], size: "1" },
  { name: "mass", key: "w", clicks: 1, hits: ["link"], size: "1" },
  { name: "delete", key: "x", clicks: 1, hits: ["point", "load", "link", "joint"] },
];
const SHAPES = ["bar", "disc", "plate", "point"];
const SCALE = { name: "scale", clicks: 2, hits: [] };

/** The present one. */
export const tool = () => (state.tool === "scale" ? SCALE : TOOLS.find((each) => each.name === state.tool));

/** What was clicked so far with the present tool, and the keyboard's place on the sheet. */
export const drawn = { ends: [], cursor: null };

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

/** Take another tool; what was clicked with the last one is forgotten. Delete takes away what is chosen. */
export function choose(name) {
  if (name === "delete" && state.chosen && state.tool === "shape") {
    remove(state.chosen);
    return;
  }
  state.tool = name;
  drawn.ends = [];
  drawn.cursor = null;
  drawBand();
  changed("tool");
}

const isEmpty = () => !(state.look?.links ?? []).some((link) => link.points.length);

/** What to do next, in one line. */
export function advise() {
  if (!state.look) {
    say(word("waiting"));
    return;
  }
  const key = tool().clicks ? `tool.${state.tool}.step${drawn.ends.length + 1}` : isEmpty() ? "empty" : `tool.${state.tool}.hint`;
  say(word(key));
}

// --- clicks -----------------------------------------------------------------------------------------------------------

/** What a click of the present tool means: what it hits, or the place. */
export function target(px, py, event = {}) {
  const kinds = tool().name === "plate" ? (drawn.ends.length ? ["point"] : ["link"]) : tool().hits;
  const first = tool().name === "gear" && !drawn.ends.length ? ["link"] : (tool().name === "slider" || tool().name === "slot") && !drawn.ends.length ? ["point"] : kinds;
  const found = hit(px, py, first, event.pointerType === "touch");
  if (found?.link && tool().name === "force") return { ...found, at: toPlane(px, py) };
  if (tool().name === "force" && drawn.ends.length) return { at: toPlane(px, py) };
  if (found) return found;
  return { at: snapped(toPlane(px, py), state.grid && !event.altKey) };
}

const placeOf = (end) => (end.at ? end.at : end.point ? lastPlace(end.point)?.place : null);

/** A click with the present tool: the last one that it needs becomes an order. */
export async function click(end) {
  const { name, clicks } = tool();
  const nothing = !end.point && !end.link && !end.joint && !end.load && !end.mass;
  if (["driver", "delete", "torque", "mass"].includes(name) && nothing) return;
  if (["spring", "damper", "force"].includes(name) && !drawn.ends.length && nothing) return;
  if (["plate", "gear"].includes(name) && !drawn.ends.length && !end.link) return;
  drawn.ends.push(end);
  if (drawn.ends.length < clicks) {
    drawBand();
    advise();
    return;
  }
  const [first, second] = drawn.ends;
  drawn.ends = [];
  drawBand();
  const orders = {
    ground: () => ({ do: "ground", end: first }),
    link: () => ({ do: "link", ends: [first, second] }),
    plate: () => ({ do: "plate", link: first.link, end: second }),
    slider: () => ({ do: "slide", kind: "prismatic", end: first, on: second }),
    slot: () => ({ do: "slide", kind: "pin-slot", end: first, on: second }),
    driver: () => ({ do: "driver", ...first }),
    gear: () => ({ do: "gear", on: first.link, end: second }),
    spring: () => ({ do: "spring", ends: [first, second] }),
    damper: () => ({ do: "damper", ends: [first, second] }),
    force: () => ({ do: "force", end: first, to: second.at }),
    torque: () => ({ do: "torque", ...first }),
    mass: () => ({ do: "mass", ...first }),
    delete: () => ({ do: "delete", ...first }),
  };
  if (name === "scale") {
    choose("shape");
    await scalePicture(first.at, second.at);
    return;
  }
  const what = orders[name]();
  if (tool().size && !(await sized(what))) advise();
  else if (await order(what)) advise();
}

/** Ask how large a load or a mass is, and of which shape; false where nobody answers. */
async function sized(what) {
  const kind = what.end?.joint ? "rack" : what.do;
  const choices = kind === "mass" ? { label: word("shape"), values: SHAPES.map((each) => [each, word(`shape.${each}`)]) } : null;
  const answer = await confirmed(word(`size.${kind}`), { yes: word("ready"), field: state.look.units[kind], value: kind === "rack" ? "20" : tool().size, choices });
  if (answer === null) return false;
  if (choices) Object.assign(what, { size: answer.value, shape: answer.choice });
  else what.size = answer;
  return true;
}

/** Delete a point, a link or a joint. */
export function remove(chosen) {
  state.chosen = null;
  order({ do: "delete", [chosen.kind]: chosen.name });
}

/** Ask for another name of a point or a link. */
export async function rename({ kind, name }) {
  const to = await confirmed(word(`rename.${kind}`, { name }), { yes: word("rename.yes"), field: word("rename.name"), value: name });
  if (!to || !(await order({ do: "rename", [kind]: name, to }))) return;
  state.chosen = { kind, name: to.trim() };
  changed("chosen");
}

/** What is being drawn, up to a place in pixels, or up to the keyboard's place. */
export function drawBand(to = null) {
  band.replaceChildren();
  const shownCursor = drawn.cursor ? toScreen(...drawn.cursor) : null;
  const first = drawn.ends.length ? placeOf(drawn.ends[0]) : null;
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

on("language", buildTools);
on("tool", mark);
let empty = null;
on("look", () => {
  const now = isEmpty();
  if (now !== empty) advise();
  empty = now;
});
on("view", () => drawBand());
