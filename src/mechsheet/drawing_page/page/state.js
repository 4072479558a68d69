// What the page knows. Everything else follows from it; whoever changes it says so with `changed`.

export const state = {
  text: "", // the description: the mechanism itself
  at: null, // the driver value shown, in its unit; null: the one that the description's sketch shows
  look: null, // the last answer to the text: links, positions, faults
  frame: 0, // which of its positions is shown
  tool: "shape",
  chosen: null, // { kind: "point" | "link" | "joint", name }
  file: "",
  mark: "", // what the file was when it was read or saved
  saved: "", // the text as it was then
  language: "en",
  theme: "light",
  grid: true,
  paths: true,
  velocities: false, // whether those of points are drawn
  playing: false,
  picture: null, // { url, x, y, width, height, strength }: behind the drawing, in lengths
  view: null, // { x, y, scale }: the middle of the sheet, and pixels in a length
  curves: null, // symbols of the curves that are shown; null: those that suit any mechanism
};

const listeners = new Map();

/** Call `then` whenever one of these parts has changed. */
export function on(parts, then) {
  for (const part of parts.split(" ")) {
    if (!listeners.has(part)) listeners.set(part, []);
    listeners.get(part).push(then);
  }
}

/** Say that parts of the state have changed: each listener is called once. */
export function changed(...parts) {
  const called = new Set(parts.flatMap((part) => listeners.get(part) ?? []));
  for (const then of called) then();
}

// --- undo ------------------------------------------------------------------------------------------------------------

const MOST = 300;
const past = [];
const future = [];

/** Keep the text as it is now, before it is changed. */
export function remember() {
  const last = past[past.length - 1];
  if (last && last.text === state.text) return;
  past.push({ text: state.text, at: state.at });
  if (past.length > MOST) past.shift();
  future.length = 0;
}

/** The text before the last change, or null where there is none. */
export function before() {
  while (past.length && past[past.length - 1].text === state.text) past.pop();
  if (!past.length) return null;
  future.push({ text: state.text, at: state.at });
  return past.pop();
}

/** The text that was undone last, or null. */
export function after() {
  if (!future.length) return null;
  past.push({ text: state.text, at: state.at });
  return future.pop();
}

export const undoable = () => past.some((each) => each.text !== state.text);
export const redoable = () => future.length > 0;

// --- a reload keeps the work ------------------------------------------------------------------------------------------

const KEPT = ["text", "at", "file", "mark", "saved", "grid", "paths", "velocities", "picture", "view", "curves", "language", "theme"];
const place = `mechsheet ${location.pathname}`;

/** Keep the work in this tab. What is too large to be kept is the picture. */
export function keep() {
  const work = Object.fromEntries(KEPT.map((key) => [key, state[key]]));
  try {
    sessionStorage.setItem(place, JSON.stringify(work));
  } catch {
    try {
      sessionStorage.setItem(place, JSON.stringify({ ...work, picture: null }));
    } catch {
      // a browser that keeps nothing: a reload begins anew
    }
  }
}

/** What this tab has kept, or null. */
export function kept() {
  try {
    return JSON.parse(sessionStorage.getItem(place));
  } catch {
    return null;
  }
}
