// Places of the mechanism at the position shown, and what lies under a pointer.

import { state } from "./state.js";

/** One of a column that has one value, or one for each position. */
export const at = (column, frame = state.frame) => column[column.length === 1 ? 0 : frame];

/** The position with the driver value nearest to this one. */
export function frameAt(value) {
  const away = state.look.frames.driver.map((each) => Math.abs(each - value));
  return away.indexOf(Math.min(...away));
}

/** Where a point is; null where it has no position. */
export function place(name, frame = state.frame) {
  const columns = state.look?.frames?.points?.[name];
  if (!columns) return null;
  const [x, y] = [at(columns[0], frame), at(columns[1], frame)];
  return x === null || y === null || x === undefined ? null : [x, y];
}

/** The corners of a shape in a position: its path stands in a frame, an origin and the vectors of its two directions. */
export function cornersOf(shape, frame = state.frame) {
  const vectors = shape.places.map(([x, y]) => [at(x, frame), at(y, frame)]);
  if (vectors.some(([x, y]) => x === null || y === null)) return [];
  if (!shape.path.length) return vectors;
  const [origin, along, across] = vectors;
  return shape.path.map(([a, b]) => [0, 1].map((axis) => origin[axis] + a * along[axis] + b * across[axis]));
}

/** Where a point was last: its place in the nearest position that has one. */
export function lastPlace(name) {
  const here = place(name);
  if (here) return { place: here, lost: false };
  const count = state.look?.frames?.driver?.length ?? 0;
  for (let away = 1; away < count; away++) {
    for (const frame of [state.frame - away, state.frame + away]) {
      const there = frame >= 0 && frame < count ? place(name, frame) : null;
      if (there) return { place: there, lost: true };
    }
  }
  return null;
}

/** All points as they are shown: what is sent along with an order. */
export function places() {
  const found = {};
  for (const name of Object.keys(state.look?.frames?.points ?? {})) {
    const there = lastPlace(name);
    if (there) found[name] = there.place;
  }
  return found;
}

export const ground = () => state.look?.links?.[0]?.name;
export const linkNamed = (name) => state.look?.links?.find((link) => link.name === name);
export const linksAt = (point) => (state.look?.links ?? []).filter((link) => link.points.includes(point));

/** Points that two links share, or that glide in a slot. */
export function isPin(point) {
  return linksAt(point).length > 1 || (state.look?.joints ?? []).some((joint) => joint.point === point);
}

/** Names with their digits lowered, as a textbook sets them: A0 -> A and 0. */
export function parts(name) {
  const found = /^(.*?[^\d_])_?(\d+)$/.exec(name);
  return found ? [found[1], found[2]] : [name, ""];
}

const GREEK = {
  alpha: "α", beta: "β", gamma: "γ", delta: "δ", epsilon: "ε", theta: "θ", lambda: "λ", mu: "μ", omega: "ω", phi: "φ",
  psi: "ψ", sigma: "σ", tau: "τ", rho: "ρ", eta: "η", kappa: "κ", nu: "ν", xi: "ξ", zeta: "ζ",
};

/** A symbol as plain text: theta13 -> θ13, phi -> φ. */
export const greek = (name) => name.replace(/^[a-z]+/, (letters) => GREEK[letters] ?? letters);

/** A symbol as HTML: theta13 -> θ with 13 lowered. */
export function symbol(name) {
  const [head, ...rest] = name.split("_");
  const found = /^([A-Za-zÇĞİÖŞÜçğıöşü]+?)(\d*)$/.exec(head);
  const [letters, digits] = found ? [found[1], found[2]] : [head, ""];
  const low = [digits, ...rest].filter(Boolean).join(" ");
  return `${escaped(GREEK[letters] ?? letters)}${low ? `<sub>${escaped(low)}</sub>` : ""}`;
}

export const escaped = (text) =>
  String(text).replace(/[&<>"']/g, (sign) => `&#${sign.charCodeAt(0)};`);

/** A number for people: few digits, the minus sign of print. */
export function shown(value, digits = 6) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

export function distance(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

/** The distance of a place from a stretch between two others. */
export function fromStretch(p, a, b) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const part = dx || dy ? Math.max(0, Math.min(1, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy))) : 0;
  return distance(p, [a[0] + part * dx, a[1] + part * dy]);
}
