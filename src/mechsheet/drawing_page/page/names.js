// Where the names of points stand: on the side of their point where nothing lies, and where they stood before as long as
// nothing comes there.

import { distance, fromStretch } from "./geometry.js";

/** Pixels from a point to the middle of its name, at first and where that is not free: the last is beyond a block. */
const AWAY = [19, 24, 29];
/** Around that middle what a name takes: beside another, and beside a line, where its letters alone count. */
const [HALF, LETTERS] = [11, 9];

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
  for (const { corners, half } of lines) {
    const nearest = Math.min(...corners.map((corner, n) => (n ? fromStretch(middle, corners[n - 1], corner) : Infinity)));
    const over = 1 - nearest / (LETTERS + half);
    if (over > 0) found += ON_LINE * (1 + over); // where no side is free: rather at its edge than on its middle
  }
  if (own.fixed && middle[1] > own.place[1] + 5) found += ON_SUPPORT;
  return found;
}

/**
 * The side of each point on which its name stands, [dx, dy] from the point.
 * points: [{ place, fixed, side }], side as it was; lines: what is drawn, [{ corners, half }], places on the screen and
 * half of its width.
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
