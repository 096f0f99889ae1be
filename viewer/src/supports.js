// Bolts and linings, at their true positions whatever is magnified: bolts in the colour of their force or utilisation with a
// dot at the collar, linings with a diagram of their forces.
import { INK, OKABE, PRESSED, PULLED, rampColour, rgb } from './colours.js';
import { BROKEN, COLLAR, LINING } from './data.js';

const PLAIN = OKABE[2], RING = OKABE[7], UNSTATED = '#8a8a8a';
const WIDE = 3, DOT = 11; // pixels
const REACH = 0.4; // of half the size of the linings: the largest value of a diagram

export const BOLTS = { plain: { label: 'one colour' }, force: { label: 'axial force', unit: 'N' }, use: { label: 'utilisation' } };
// of a lining: its unit, and the side on which a positive value is drawn, 1 outside: moments on the side in tension
export const LININGS = { none: { label: 'none' }, thrust: { label: 'thrust', unit: 'N/m', side: 1 }, moment: { label: 'moment', unit: 'N m/m', side: -1 },
  pressure: { label: 'rock pressure', unit: 'Pa', side: 1 } };

export const boltColour = (share) => rampColour(0.35 + 0.65 * share); // the lightest are not seen on rock

const isBolt = (support, i) => support.mark[i] !== LINING;
const hasUse = (support, i) => isBolt(support, i) && support.use[i] >= 0;
const bolts = (support) => Array.from(support.mark.keys()).filter((i) => isBolt(support, i));

const NOISE = 1e-9; // of the largest contact force: forces of bolts that are rounding

// What a run has at any time: bolts, stated yields, linings, and the largest force of a bolt and value of a diagram.
export function supportsOf(run, largestForce) {
  const all = { bolts: false, uses: false, linings: false, force: 0, thrust: 0, moment: 0, pressure: 0, half: 0 };
  for (const { support } of run.frames) {
    for (const i of bolts(support)) {
      all.bolts = true;
      all.uses ||= hasUse(support, i);
      all.force = Math.max(all.force, Math.abs(support.force[i]));
    }
    if (!support.linings) continue;
    all.linings = true;
    for (const name of ['thrust', 'moment', 'pressure'])
      for (const end of support[name]) for (const value of end) all[name] = Math.max(all[name], Math.abs(value));
    for (let k = 0; k < 2; ++k) {
      let low = Infinity, high = -Infinity;
      for (const end of support.ends)
        end[k].forEach((x, i) => { if (support.mark[i] === LINING) [low, high] = [Math.min(low, x), Math.max(high, x)]; });
      all.half = Math.max(all.half, (high - low) / 2);
    }
  }
  if (all.force < NOISE * largestForce) all.force = 0;
  return all;
}

function tintOf(support, i, look, all) {
  if (look.bolts === 'plain') return rgb(PLAIN);
  if (support.mark[i] & BROKEN) return rgb(INK);
  if (look.bolts === 'force') return boltColour(all.force > 0 ? Math.abs(support.force[i]) / all.force : 0);
  return support.use[i] < 0 ? rgb(UNSTATED) : boltColour(support.use[i]);
}

const endsOf = (support, i) => support.ends.map((end) => end.map((column) => column[i]));

export function addSupport(pieces, run, look, all) {
  const { support } = run.frames[look.frame];
  for (let i = 0; i < support.count; ++i) {
    const ends = endsOf(support, i);
    if (support.mark[i] === LINING) pieces.add(...ends, rgb(RING), WIDE + 1);
    else pieces.add(...ends, tintOf(support, i, look, all), WIDE);
  }
  for (const i of bolts(support))
    if (support.mark[i] & COLLAR) pieces.addDot(endsOf(support, i)[0], tintOf(support, i, look, all), DOT);
  if (look.lining !== 'none' && support.linings) addDiagram(pieces, support, look, all);
}

// m of the picture for the largest value
export const diagramReach = (all, look) => REACH * all.half * look.forceSize;

// At each node an ordinate across the lining, in its plane, and a line through their ends.
function addDiagram(pieces, support, look, all) {
  const values = support[look.lining], most = all[look.lining], { side } = LININGS[look.lining];
  if (most === 0) return;
  const own = Array.from(support.mark.keys()).filter((i) => support.mark[i] === LINING), key = (p) => p.join();
  // outwards at a node: the mean of its pieces, whose opening is on their left
  const outwards = new Map();
  for (const i of own) {
    const [a, b] = endsOf(support, i), size = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    for (const end of [a, b]) {
      const sum = outwards.get(key(end)) ?? [0, 0];
      outwards.set(key(end), [sum[0] + (b[1] - a[1]) / size, sum[1] - (b[0] - a[0]) / size]);
    }
  }
  const tip = (at, value) => {
    const n = outwards.get(key(at)), size = Math.hypot(...n) || 1, d = (side * diagramReach(all, look) * value) / most;
    return [at[0] + (d * n[0]) / size, at[1] + (d * n[1]) / size, at[2]];
  };
  own.forEach((i, j) => {
    const ends = endsOf(support, i), tips = ends.map((end, e) => tip(end, values[e][j]));
    const tint = (value) => rgb(value >= 0 ? PRESSED : PULLED);
    ends.forEach((end, e) => pieces.add(end, tips[e], tint(values[e][j]), 1));
    pieces.add(...tips, tint(values[0][j] + values[1][j]), 2);
  });
}

// for the overlay: a strip of the bolts' colours, and the length of a diagram's value
export function supportLegends(run, look, all, perPixel) {
  const { support } = run.frames[look.frame], legends = [];
  if (bolts(support).length && look.bolts !== 'plain') {
    const broken = bolts(support).some((i) => support.mark[i] & BROKEN), unstated = look.bolts === 'use' && bolts(support).some((i) => !hasUse(support, i));
    legends.push({ strip: `bolts: ${BOLTS[look.bolts].label}`, high: look.bolts === 'use' ? [1, ''] : [all.force, BOLTS.force.unit],
      rows: [...(unstated ? [['no yield stated', UNSTATED]] : []), ...(broken ? [['broken', INK]] : [])] });
  }
  if (support.linings && look.lining !== 'none') {
    const { label, unit } = LININGS[look.lining], reach = diagramReach(all, look) / perPixel, scale = Math.min(1, 80 / reach), values = support[look.lining];
    const signs = [1, -1].filter((sign) => values.some((end) => end.some((value) => sign * value > 0)));
    const words = { thrust: ['compression', 'tension'], moment: ['tension inside', 'tension outside'], pressure: ['pressure', 'pull'] }[look.lining];
    legends.push({ measure: `lining: ${label}`, value: [all[look.lining] * scale, unit], pixels: reach * scale,
      rows: signs.map((sign) => [words[sign > 0 ? 0 : 1], sign > 0 ? PRESSED : PULLED]) });
  }
  return legends;
}
