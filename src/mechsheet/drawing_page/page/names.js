// Where the names of points stand: on the side of their point where nothing lies, and where they stood before as long as
// nothing comes there.

import { distance, fromStretch } from "./geometry.js";

/** Pixels from a point to the middle of its name, at first and where that is not free; and around that middle what a name takes. */
const AWAY = [19, 29];
const HALF = 11;

/** Upwards and to the right first, as one writes; straight down last, where supports are. */
const SIDES = AWAY.flatMap((away) =>
  [45, 135, 90, 0, 180, -45, -135, -90].map((degrees) => {
    const angle = (degrees * Math.PI) / 180;
    return [away * Math.cos(angle), -away * Math.sin(angle)];
  }),
);

const [ON_LINE, ON_POINT, ON_SUPPORT, FURTHER_SIDE] = [10, 20, 12, 0.1];

/** What lies under a name whose middle is at a place. */
function cost(middle, own, others, lines) {
  let found = 0;
  for (const other of others) if (distance(middle, other) < 2 * HALF) found += ON_POINT;
  for (const corners of lines) {
    const near = corners.some((corner, n) => n && fromStretch(middle, corners[n - 1], corner) < HALF);
    if (near) found += ON_LINE;
  }
  if (own.fixed && middle[1] > own.place[1] + 5) found += ON_SUPPORT;
  return found;
}

/**
 * The side of each point on which its name stands, [dx, dy] from the point.
 * points: [{ place, fixed, side }], side as it was; lines: what is drawn, as corners on the screen.
 */
export function sides(points, lines) {
  const taken = [];
  return points.map((own) => {
    const others = [...points.filter((each) => each !== own).map((each) => each.place), ...taken];
    const at = ([dx, dy]) => [own.place[0] + dx, own.place[1] + dy];
    let best = own.side;
    if (!best || cost(at(best), own, others, lines) > 0) {
      const costs = SIDES.map((side, n) => cost(at(side), own, others, lines) + n * FURTHER_SIDE);
      best = SIDES[costs.indexOf(Math.min(...costs))];
    }
    taken.push(at(best));
    return best;
  });
}
