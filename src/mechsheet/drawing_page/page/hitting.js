// What lies under a place of the sheet.

import { distance, fromStretch, ground, lastPlace } from "./geometry.js";
import { actingAt } from "./scene.js";
import { state } from "./state.js";
import { toScreen } from "./view.js";

/** What of these kinds (point, joint, link) is there: { point: name } or its like, or null. A finger is broader. */
export function hit(px, py, kinds, touch = false) {
  const p = [px, py];
  const near = touch ? 24 : 14;
  if (kinds.includes("point")) {
    let best = null;
    for (const name of Object.keys(state.look?.frames?.points ?? {})) {
      const there = lastPlace(name);
      const away = there ? distance(toScreen(...there.place), p) : Infinity;
      if (away <= near && (!best || away < best.away)) best = { point: name, away };
    }
    if (best) return { point: best.point };
  }
  if (kinds.includes("load")) {
    const found = actingAt(p, near);
    if (found) return found;
  }
  if (kinds.includes("joint")) {
    for (const joint of state.look?.joints ?? []) {
      const there = lastPlace(joint.point);
      if (there && distance(toScreen(...there.place), p) <= near + 6) return { joint: joint.name };
    }
  }
  if (kinds.includes("link")) {
    for (const link of [...(state.look?.links ?? [])].reverse()) {
      if (link.name !== ground() && onLink(link, p, near)) return { link: link.name };
    }
  }
  return null;
}

function onLink(link, p, near) {
  const corners = link.points.map(lastPlace).filter(Boolean).map((there) => toScreen(...there.place));
  if (corners.length === 1) return distance(corners[0], p) <= near;
  let inside = false;
  for (let n = 0; n < corners.length; n++) {
    const [a, b] = [corners[n], corners[(n + 1) % corners.length]];
    if (fromStretch(p, a, b) <= near) return true;
    if (a[1] > p[1] !== b[1] > p[1] && p[0] < ((b[0] - a[0]) * (p[1] - a[1])) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside && corners.length > 2;
}

/** The point of a link that is nearest to a place on the sheet. */
export function pointOf(name, p) {
  const link = state.look.links.find((each) => each.name === name);
  const away = (point) => distance(toScreen(...lastPlace(point).place), p);
  return link.points.filter(lastPlace).sort((a, b) => away(a) - away(b))[0];
}
