// The colours to choose from: of each the source of its values, their unit, and their range over all times or their list.
import { HELD, KINDS, kindOf, LISTED_COLOURS, withUnit } from './colours.js';
import { colourByNeighbours } from './neighbours.js';

// source of the value in the shader: none, of the point, of the body, of the face, its properties, of the body a place
// in the choice's list of colours
export const FLAT = 0, POINT = 1, BODY = 2, FACE = 3, PROPERTIES = 4, LISTED = 5;

export function choices(run, bodies) {
  const plane = run.head.dimension === 2;
  return {
    set: { label: 'joint set', mode: FLAT },
    block: byBlock(run),
    displacement: { label: 'displacement', unit: 'm', mode: POINT, range: () => ({ low: 0, high: farthest(run, bodies) }) },
    most: byShare(run, bodies),
    velocity: {
      label: 'velocity', unit: 'm/s', mode: BODY, value: (shape, f) => run.frames[f].speed[shape.body],
      range: () => ({ low: 0, high: largest(run.frames, (frame) => frame.speed) }),
    },
    friction: {
      label: 'share of friction mobilised', unit: '', mode: FACE,
      range: () => ({ low: 0, high: Math.max(1, largest(run.frames, (frame) => frame.contacts.friction)) }),
    },
    properties: { label: 'joint properties', mode: PROPERTIES },
    size: {
      label: plane ? 'block area' : 'block volume', unit: plane ? 'm²' : 'm³', mode: BODY, value: (shape) => shape.volume,
      range: () => sizes(run),
    },
    ...(run.verdicts && { factor: byFactor(run) }),
  };
}

// the kinds that occur, with numbers of blocks
function byFactor(run) {
  const value = (shape) => kindOf(run.verdicts.bodies[shape.body]), counts = KINDS.map(() => 0);
  for (const shape of run.shapes) ++counts[value(shape)];
  const rows = KINDS.map(([name, colour], i) => [`${name} (${counts[i]})`, colour]).filter((_, i) => counts[i]);
  return { label: 'factor of safety', mode: LISTED, list: KINDS.map(([, colour]) => colour), value,
    legend: () => ({ note: 'least, alone or in a cluster', rows }) };
}

// The same colour of a block at all times, another one than those of its neighbours.
function byBlock(run) {
  let found = null;
  return { label: 'block', mode: LISTED, list: LISTED_COLOURS, legend: () => ({ note: 'neighbours differ', rows: [] }),
    value: (shape) => (found ??= colourByNeighbours(run, LISTED_COLOURS.length)).get(shape.body) };
}

// Of the largest displacement of a free block at this time, from these shares on: darker is more, also in grey.
const SHARES = [[0.75, '#8f3500', '75 to 100 %'], [0.5, '#c85a08', '50 to 75 %'], [0.25, '#e8935a', '25 to 50 %'], [0.1, '#f5c9a8', '10 to 25 %'],
  [0, '#f7f4ec', 'below 10 %']];

function byShare(run, bodies) {
  let of = new Map(), most = 0;
  return {
    label: 'moved most', mode: LISTED, list: [...SHARES.map(([, colour]) => colour), HELD],
    prepare(f) {
      of = new Map(run.shapes.filter((shape) => bodies.isShown(shape, f) && !bodies.isFixed(shape, f)).map((shape) => [shape, farthestOf(bodies, shape, f)]));
      most = largest([[...of.values()]], (list) => list);
    },
    value: (shape) => (of.has(shape) ? SHARES.findIndex(([from]) => of.get(shape) >= from * most && (most > 0 || from === 0)) : SHARES.length),
    legend: () => ({ note: most > 0 ? `share of the largest, ${withUnit(most, 'm')}` : 'no block has moved',
      rows: [...SHARES.map(([, colour, name]) => [name, colour]), ['fixed', HELD]] }),
  };
}

function largest(frames, list) {
  let most = 0;
  for (const frame of frames) for (const value of list(frame)) if (value > most) most = value;
  return most;
}

function sizes(run) {
  let low = Infinity, high = 0;
  for (const { volume } of run.shapes) {
    if (volume > 0) low = Math.min(low, volume);
    high = Math.max(high, volume);
  }
  return high > 1.001 * low ? { low, high, logarithmic: true } : { low: 0, high };
}

// the largest displacement of any corner of a block, and at any time
function farthestOf(bodies, shape, f) {
  const d = [0, 0, 0];
  let most = 0;
  for (const { points } of shape.parts)
    for (let i = 0; i < points.length; i += 3) {
      bodies.away(f, shape, points[i], points[i + 1], points[i + 2], d);
      most = Math.max(most, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    }
  return Math.sqrt(most);
}

function farthest(run, bodies) {
  let most = 0;
  run.frames.forEach((_, f) => {
    for (const shape of run.shapes) if (bodies.isShown(shape, f)) most = Math.max(most, farthestOf(bodies, shape, f));
  });
  return most;
}
