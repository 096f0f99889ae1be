// Directions of traces in the plane, as the section is seen: x to the right, y up. Each class of ten degrees is a pair of
// opposite sectors, whose area is its number of joints, by set.
import * as Plot from '@observablehq/plot';
import { round } from './stereonets.js';
import { table } from './table.js';

const CLASS = 10, STEP = 2, degrees = 180 / Math.PI;
const at = (angle, r) => [r * Math.cos(angle / degrees), r * Math.sin(angle / degrees)];
// of a trace with this normal: anticlockwise from the right, 0 to 180
const directionOf = ([x, y]) => ((Math.atan2(x, -y) * degrees) % 180 + 180) % 180;

function sector(from, inner, outer) {
  const angles = Array.from({ length: CLASS / STEP + 1 }, (_, i) => from + i * STEP);
  return [...angles.map((a) => at(a, outer)), ...angles.reverse().map((a) => at(a, inner))];
}

// `sets`: name, colour, normals
export function rose(sets) {
  const classes = Array.from({ length: 180 / CLASS }, () => sets.map(() => 0));
  sets.forEach((set, s) => { for (const normal of set.normals) classes[Math.floor(directionOf(normal) / CLASS) % classes.length][s] += 1; });
  const sums = classes.map((counts) => counts.reduce((a, b) => a + b, 0)), most = Math.max(...sums), points = [];
  classes.forEach((counts, c) => {
    let below = 0;
    counts.forEach((count, s) => {
      const [inner, outer] = [below, below + count].map((n) => Math.sqrt(n / most));
      below += count;
      if (count) for (const turn of [0, 180])
        for (const [x, y] of sector(c * CLASS + turn, inner, outer)) points.push({ x, y, piece: `${c} ${s} ${turn}`, set: sets[s].name });
    });
  });
  const circle = (r) => Plot.line(Array.from({ length: 121 }, (_, i) => at(3 * i, r)), { stroke: r === 1 ? '#404040' : '#e0e0e0' });
  const dips = [0, 30, 60, 90, 120, 150, 180];
  return round('traces', `Directions of the traces, as the section is seen, in classes of ${CLASS}°: the area of a pair of sectors is the number of joints, ${most} in the largest. Numbers are dips.`, sets,
    [...[0.25, 0.5, 0.75].map((share) => circle(Math.sqrt(share))), circle(1),
      Plot.line(points, { x: 'x', y: 'y', z: 'piece', fill: 'set', stroke: 'white', strokeWidth: 0.5, curve: 'linear-closed' }),
      Plot.text(dips, { x: (d) => at(-d, 1.1)[0], y: (d) => at(-d, 1.1)[1], text: (d) => `${d > 90 ? 180 - d : d}°` })]);
}

// name, number of joints, mean dip and its side: the mean of directions without a sign, by twice their angle
export const traceTable = (sets) => table(['set', 'joints', 'mean dip (°)', 'dips to the'], sets.map((set) => {
  const twice = set.normals.map((normal) => (2 * directionOf(normal)) / degrees);
  const sum = (of) => twice.reduce((total, a) => total + of(a), 0);
  const mean = ((Math.atan2(sum(Math.sin), sum(Math.cos)) * degrees) / 2 + 180) % 180;
  return [set.name, set.normals.length, Math.min(mean, 180 - mean).toFixed(1), mean > 90 ? 'right' : 'left'];
}), { numbers: [1, 2] });
