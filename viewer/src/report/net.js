// The stereonet's geometry: lower hemisphere, unit circle, x to the east and y to the north. Directions are vectors (east,
// north, up); angles are degrees. Zones of a rock face (Markland 1972; Goodman & Bray 1976; Goodman 1989) are functions
// that are positive inside, of a line or of a pole's line, as core/key_blocks/kinematics.hpp counts them.

const radians = Math.PI / 180;
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (v) => v.map((x) => x / Math.hypot(...v));
export const downward = (v) => (v[2] > 0 ? v.map((x) => -x) : v);

// ---- directions

export const lineOf = (plunge, trend) => [Math.cos(plunge * radians) * Math.sin(trend * radians),
  Math.cos(plunge * radians) * Math.cos(trend * radians), -Math.sin(plunge * radians)];
// the lower end of a plane's normal
export const poleOf = (dip, direction) => lineOf(90 - dip, direction + 180);
// of a line that points down
export const plungeAndTrend = (v) => ({ plunge: Math.asin(Math.min(1, -v[2])) / radians, trend: (Math.atan2(v[0], v[1]) / radians + 360) % 360 });
// of the plane with this pole
export const planeOf = (pole) => {
  const { plunge, trend } = plungeAndTrend(downward(pole));
  return { dip: 90 - plunge, direction: (trend + 180) % 360 };
};
// The pole of a plane with this upward normal. A vertical plane dips to the side to which its normal points.
export const poleWith = (normal) => (normal[2] < 0 ? normal : normal.map((x) => -x));
export const between = (a, b) => downward(unit(cross(a, b)));

// ---- the net

const RADII = { area: (plunge) => Math.SQRT2 * Math.sin((45 - plunge / 2) * radians), angle: (plunge) => Math.tan((45 - plunge / 2) * radians) };
const PLUNGES = { area: (r) => 90 - (2 * Math.asin(Math.min(1, r / Math.SQRT2))) / radians, angle: (r) => 90 - (2 * Math.atan(r)) / radians };

export function onNet(v, kind = 'area') {
  const { plunge, trend } = plungeAndTrend(downward(v)), r = RADII[kind](plunge);
  return [r * Math.sin(trend * radians), r * Math.cos(trend * radians)];
}
// the line at a place of the net; nothing outside of it
export function fromNet(x, y, kind = 'area') {
  const r = Math.hypot(x, y);
  return r > 1 ? null : lineOf(PLUNGES[kind](r), Math.atan2(x, y) / radians);
}

const STEP = 2; // degrees
const sampled = (from, to, at) => Array.from({ length: Math.ceil((to - from) / STEP) + 1 }, (_, i) => at(Math.min(to, from + i * STEP)));

export function greatCircle(dip, direction, kind) {
  const down = lineOf(dip, direction), strike = lineOf(0, direction + 90);
  return sampled(-90, 90, (a) => onNet(down.map((x, k) => Math.cos(a * radians) * x + Math.sin(a * radians) * strike[k]), kind));
}
// lines at an angle to an axis; parts that come out of the other side of the net are separate pieces
export function smallCircle(axis, angle, kind) {
  const e = unit(cross(axis, Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0])), f = cross(axis, e), pieces = [[]];
  let side = 0;
  for (const v of sampled(0, 360, (a) => axis.map((x, k) => Math.cos(angle * radians) * x + Math.sin(angle * radians) * (Math.cos(a * radians) * e[k] + Math.sin(a * radians) * f[k])))) {
    const now = v[2] > 0 ? 1 : -1;
    if (side && now !== side) pieces.push([]);
    side = now;
    pieces.at(-1).push(onNet(v, kind));
  }
  return pieces.filter((piece) => piece.length > 1);
}
// poles of the steepest planes that still leave the face, by their dip direction
export function daylightEnvelope({ dip, direction }, kind) {
  return sampled(-90, 90, (difference) => {
    const steepest = Math.atan(Math.tan(dip * radians) * Math.cos(difference * radians)) / radians;
    return onNet(poleOf(steepest, direction + difference), kind);
  });
}

// ---- sets

// How many joints one that a scanline meets stands for (Terzaghi 1965): 1/sin of the angle between scanline and plane, at
// most `largest`, since planes along the scanline would have weights without bound.
export const terzaghiWeight = (pole, scanline, largest) => Math.min(largest, 1 / Math.abs(dot(pole, scanline)));
const sumOf = (numbers) => numbers.reduce((sum, x) => sum + x, 0);

// Of axes without a sign, each with its weight: the mean, Fisher's constant and the half angle of the cone that holds the
// true mean with 95 %. Weighted ones count as (Σw)²/Σw² of equal weight (Kish).
export function fisherMean(poles, weights = poles.map(() => 1)) {
  const first = meanAxis(poles, weights), total = sumOf(weights), n = total ** 2 / sumOf(weights.map((w) => w * w));
  const sum = [0, 0, 0];
  poles.forEach((pole, i) => pole.forEach((x, k) => { sum[k] += weights[i] * (dot(pole, first) < 0 ? -x : x); }));
  const length = Math.hypot(...sum), size = (length * n) / total, mean = downward(sum.map((x) => x / length));
  if (poles.length < 3 || !(n - size > 1e-9)) return { mean, constant: Infinity, cone: NaN };
  const cosine = 1 - ((n - size) / size) * (20 ** (1 / (n - 1)) - 1);
  return { mean, constant: (n - 1) / (n - size), cone: cosine > 0 ? Math.acos(cosine) / radians : NaN };
}

// the eigenvector of the sum of w p pᵀ: a mean of poles across the horizon
function meanAxis(poles, weights) {
  let axis = poles[0];
  for (let i = 0; i < 200; ++i) {
    const next = [0, 0, 0];
    poles.forEach((pole, j) => pole.forEach((x, k) => { next[k] += weights[j] * dot(pole, axis) * x; }));
    const turned = unit(next);
    if (Math.hypot(...turned.map((x, k) => x - axis[k])) < 1e-14) break;
    axis = turned;
  }
  return axis;
}

// Fisher counting: multiples of the uniform density, which are per cent for each 1 % of the net's area.
const KAPPA = 100;
export function density(poles, v, weights) {
  let sum = 0;
  poles.forEach((pole, i) => { sum += (weights?.[i] ?? 1) * Math.exp(KAPPA * (Math.abs(dot(pole, v)) - 1)); });
  return (KAPPA * sum) / ((weights ? sumOf(weights) : poles.length) * (1 - Math.exp(-KAPPA)));
}

// ---- zones of a face

const least = (...numbers) => Math.min(...numbers);
const turnTo = (a, b) => Math.abs(((a - b + 540) % 360) - 180);
const normalOf = ({ dip, direction }) => [Math.sin(dip * radians) * Math.sin(direction * radians), Math.sin(dip * radians) * Math.cos(direction * radians), Math.cos(dip * radians)];
const leaves = (face, v) => dot(normalOf(face), v) / radians;

// of the pole of a plane
export const poleZones = ({ face, friction, limits }) => ({
  plane: (pole) => {
    const { dip, direction } = planeOf(pole);
    return least(dip - friction, leaves(face, lineOf(dip, direction)));
  },
  planeWithin: (pole) => limits.plane - turnTo(planeOf(pole).direction, face.direction),
  // outside the great circle of the slip limit: the pole lies above that plane
  flexural: (pole) => least(dot(normalOf({ dip: face.dip - friction, direction: face.direction }), downward(pole)) / radians,
    limits.flexural - turnTo(planeOf(pole).direction, face.direction + 180)),
});

// of a line that points down
export const lineZones = ({ face, friction, limits }) => ({
  primary: (line) => least(plungeAndTrend(line).plunge - friction, leaves(face, line)),
  secondary: (line) => {
    const { plunge, trend } = plungeAndTrend(line);
    const onPlane = Math.atan(Math.tan(friction * radians) * Math.cos((trend - face.direction) * radians)) / radians;
    return least(friction - plunge, plunge - onPlane, leaves(face, line));
  },
  toppling: (line) => {
    const { plunge, trend } = plungeAndTrend(line);
    return least(plunge - (90 - face.dip), limits.direct - turnTo(trend, face.direction + 180));
  },
  oblique: (line) => {
    const { plunge, trend } = plungeAndTrend(line);
    return least(plunge - (90 - friction), turnTo(trend, face.direction + 180) - limits.direct);
  },
});
