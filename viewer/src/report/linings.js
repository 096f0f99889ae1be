// What a lining carries after the last stage: thrust against moment of each node with the strength of its section, and both
// along the outline.
import { digits } from '../colours.js';
import { alongLining, interaction } from './figures.js';
import { angles, envelope } from './lining_section.js';
import { readCsv } from './table.js';

export function liningFigures({ files, results, linings }) {
  if (!files.lining) return [];
  const { head, rows } = readCsv(files.lining), number = (row, name) => (row[head.indexOf(name)] === '' ? NaN : Number(row[head.indexOf(name)]));
  const all = rows.map((row) => ({ stage: number(row, 'stage'), lining: row[head.indexOf('lining')], node: number(row, 'node'), x: number(row, 'x_m'), y: number(row, 'y_m'), thrust: number(row, 'thrust_N') / 1000,
    moment: number(row, 'moment_Nm') / 1000, smoothed: number(row, 'smoothed_moment_Nm') / 1000, use: number(row, 'use') }));
  return [...new Set(all.map((row) => row.lining))].flatMap((name, k) => {
    const of = all.filter((row) => row.lining === name), last = Math.max(...of.map((row) => row.stage)), nodes = of.filter((row) => row.stage === last);
    const turns = angles(nodes), strength = linings.find((lining) => lining.name === name) ?? {}, curve = envelope(strength).map(([moment, thrust]) => [moment / 1000, thrust / 1000]);
    const worst = nodes.reduce((a, b) => (b.use > a.use ? b : a), nodes[0]), where = `Lining ${name} after stage ${results.stages[last - 1]?.name ?? last}`;
    nodes.forEach((node, i) => { node.angle = turns[i]; });
    return [interaction(nodes, curve, worst, `${where}: thrust (compression positive) against moment (tension on the side of the opening positive) of each node${curve.length
      ? `; line: strength of the elastic section, ${digits(strength.thickness_m)} m thick, ${digits(strength.compressive_strength_Pa / 1e6)} MPa in compression and ${digits(strength.tensile_strength_Pa / 1e6)} MPa in tension; `
        + `node ${worst.node} uses most of it, ${digits(100 * worst.use)} %` : '; the input states no strength'}.`, `lining-${k + 1}-interaction`),
    alongLining(nodes, [{ key: 'thrust', name: 'thrust' }], 'thrust (kN/m)', `${where}: thrust along the outline, compression positive.`, `lining-${k + 1}-thrust`),
    alongLining(nodes, [{ key: 'moment', name: 'moment' }, { key: 'smoothed', name: 'without the ripple of straight sides' }], 'moment (kN m/m)',
      `${where}: moment along the outline, tension on the side of the opening positive${nodes.some((node) => Number.isFinite(node.smoothed)) ? '. The curve without the ripple leaves out the shear of the rock along the lining: under uneven pressure, which that shear helps to support, it may be far larger than the moments' : ''}.`, `lining-${k + 1}-moment`)];
  });
}
