// Colours of blocks by their neighbours: blocks whose boxes touch get different ones as long as there are enough.
import { boxOf } from './geometry.js';

// of each body the place of its colour in a list of `colours`
export function colourByNeighbours(run, colours) {
  const first = new Map();
  for (const shape of run.shapes) if (!first.has(shape.body)) first.set(shape.body, shape);
  const boxes = [...first.values()].map((shape) => ({ body: shape.body, ...boxOf([shape]) })).sort((a, b) => a.low[0] - b.low[0] || a.body - b.body);
  const found = new Map(), used = new Array(colours).fill(0);
  let open = [];
  const near = new Map(boxes.map(({ body }) => [body, []]));
  for (const box of boxes) {
    const slack = 1e-4 * box.radius;
    open = open.filter((other) => other.high[0] >= box.low[0] - slack);
    for (const other of open)
      if ([1, 2].every((k) => other.low[k] <= box.high[k] + slack && other.high[k] >= box.low[k] - slack)) {
        near.get(box.body).push(other.body);
        near.get(other.body).push(box.body);
      }
    open.push(box);
  }
  for (const body of [...near.keys()].sort((a, b) => a - b)) {
    const taken = new Array(colours).fill(0);
    for (const other of near.get(body)) if (found.has(other)) ++taken[found.get(other)];
    // fewest neighbours have it; then the one that is used least
    let best = 0;
    for (let c = 1; c < colours; ++c) if (taken[c] < taken[best] || (taken[c] === taken[best] && used[c] < used[best])) best = c;
    found.set(body, best);
    ++used[best];
  }
  return found;
}
