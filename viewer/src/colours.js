// The figures' colours (reports/style.gp), scales and lists of colours, and numbers with their units.

// Okabe and Ito (2008), which stay apart for colour-blind readers
export const OKABE = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#f0e442', '#404040'];
export const ROCK = '#efe6d2', HELD = '#d9d9d9', EDGE = '#4a4a4a', INK = '#202020';
export const PRESSED = '#0072b2', PULLED = '#d55e00';
// from small to large, increasingly dark, so that it can be read in grey
const RAMP = ['#f2f6fa', '#cfe2f0', '#a3cdea', '#6ab8e8', '#8ca0ac', '#c07f52', '#c85a08', '#8f3500'];

// Of factors of safety, 0, below the first bound, and from each bound: darker is worse, also in grey.
const BOUNDS = [1, 1.3, 1.5, 2];
const FACTORS = [['0: nothing holds it', '#4d1a00'], ['below 1', '#a63a00'], ['1 to 1.3', '#de6a3a'], ['1.3 to 1.5', '#ef9c78'],
  ['1.5 to 2', '#f7c9b4'], ['2 and more', '#fdefe8']];
// then those without one, in the order of ViewVerdict::Kind
export const KINDS = [...FACTORS, ['stable without friction', '#7fc4ab'], ['cannot move', '#c3d7ea'], ['fixed', HELD], ['undecided', '#000000']];
// place of a verdict in this list
export function kindOf({ kind, factor }) {
  if (kind > 0) return FACTORS.length - 1 + kind;
  return factor > 0 ? 1 + BOUNDS.filter((bound) => factor >= bound).length : 0;
}

export const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);

// the eight, then darker, then lighter ones
export function listColour(i) {
  const colour = OKABE[i % OKABE.length], round = Math.floor(i / OKABE.length) % 3;
  if (round === 0) return colour;
  const mixed = rgb(colour).map((c) => (round === 1 ? 0.6 * c : 0.5 + 0.5 * c));
  return `#${mixed.map((c) => Math.round(255 * c).toString(16).padStart(2, '0')).join('')}`;
}
// of blocks: light, medium and dark, without grey
export const LISTED_COLOURS = [16, 0, 8].flatMap((from) => Array.from({ length: OKABE.length - 1 }, (_, i) => listColour(from + i)));
export const groupColour = (run, group) => (group === run.noJoint ? ROCK : listColour(group));
export const ramp = RAMP.map(rgb);

export function rampColour(t) {
  const at = Math.min(Math.max(t, 0), 1) * (ramp.length - 1), i = Math.min(Math.floor(at), ramp.length - 2);
  return ramp[i].map((c, k) => c + (at - i) * (ramp[i + 1][k] - c));
}

// place of a value between the ends of the legend, 0 to 1
export function share(value, { low, high, logarithmic }) {
  const scale = logarithmic ? Math.log : (x) => x;
  return high > low ? (scale(value) - scale(low)) / (scale(high) - scale(low)) : 0;
}

// The fraction of friction that is mobilised at each face: the largest over its contacts; -1 without contacts.
export function frictionByFace(run, faces, f, out) {
  out.fill(-1);
  const { contacts } = run.frames[f], { pairs } = run;
  const latest = latestShapes(run, f);
  for (let i = 0; i < contacts.count; ++i) {
    const p = contacts.pair[i];
    for (const side of ['A', 'B']) {
      const part = latest.get(pairs['body' + side][p])?.parts[pairs['part' + side][p]];
      const face = pairs['face' + side][p];
      if (!part || face < 0 || face >= part.faces.length) continue;
      const at = part.firstFace + face;
      out[at] = Math.max(out[at], contacts.friction[i]);
    }
  }
  return out;
}

export function latestShapes(run, f) {
  const latest = new Map();
  for (const shape of run.shapes) if (f >= shape.from && f < shape.to) latest.set(shape.body, shape);
  return latest;
}

const PREFIXES = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ']];

// three digits with a prefix that people read; of m no kilometres, of areas and volumes none
export function withUnit(value, unit, count = 3) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (unit === '' || /[²³]/.test(unit)) return `${digits(value)}${unit && ' ' + unit}`;
  const list = PREFIXES.filter(([factor]) => !(unit.startsWith('m') && factor > 1));
  const [factor, prefix] = list.find(([at]) => size >= 0.9995 * at) ?? (size === 0 ? [1, ''] : list.at(-1));
  return `${digits(value / factor, count)} ${prefix}${unit}`;
}

export function digits(value, count = 3) {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return value.toExponential(2).replace('e', '·10^').replace('^+', '^');
  return String(Number(value.toPrecision(count)));
}
// the same as other programs read it: 3.1·10^-4 is 3.1e-4
export const asTyped = (text) => text.replace(/^(-?[\d.]+)·10\^(-?\d+)$/, '$1e$2');
