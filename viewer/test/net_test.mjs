// node net_test.mjs SOURCE: what reports draw, without a browser: places on the stereonet against their formulas, counts of
// 200 joints in the zones that are drawn against those that `voussoir blocks --kinematics` counts, density, means, weights of
// a scanline; the line of a level through a grid; the strength of a lining's section.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { angles, envelope } from '../src/report/lining_section.js';
import { levelLine } from '../src/report/level_line.js';
import { between, daylightEnvelope, density, fisherMean, fromNet, greatCircle, lineOf, lineZones, onNet, planeOf, poleOf, poleWith, poleZones, smallCircle, terzaghiWeight } from '../src/report/net.js';
import { orientationText } from '../src/stereonet.js';

const [source] = process.argv.slice(2);
const near = (found, wanted, tolerance = 1e-8) => assert.ok(Math.abs(found - wanted) <= tolerance, `${found}, not ${wanted}`);
const nearPoint = (found, wanted, tolerance) => found.forEach((x, k) => near(x, wanted[k], tolerance));

// ---- places: A1 x B1 of the tutorial, and the rim, in both projections
nearPoint(onNet(lineOf(37.960792, 169.112921)), [0.117174647, -0.609219183]);
nearPoint(onNet(lineOf(37.960792, 169.112921), 'angle'), [0.092200012, -0.479370045]);
nearPoint(onNet(lineOf(20, 45)), [0.573576436, 0.573576436]);
nearPoint(onNet(lineOf(0, 270)), [-1, 0]);
nearPoint(onNet(lineOf(90, 123)), [0, 0], 1e-7);
for (const kind of ['area', 'angle']) {
  for (const [plunge, trend] of [[0.5, 12], [38, 169], [80, 300]]) {
    const [x, y] = onNet(lineOf(plunge, trend), kind);
    nearPoint(fromNet(x, y, kind), lineOf(plunge, trend), 1e-12);
  }
  assert.equal(fromNet(0.8, 0.7, kind), null);
}
// a pole is where its plane's own line is not: the plane 46/128 dips to 128, its pole plunges 44 to 308
nearPoint(onNet(poleOf(46, 128)), onNet(lineOf(44, 308)), 1e-12);
{ const { dip, direction } = planeOf(poleOf(46, 128)); near(dip, 46, 1e-9); near(direction, 128, 1e-9); }
// Upward normals, as the records have them: viewer and report give a plane the same dip direction, also if it is exactly
// vertical, when its normal is level and says to which side it dips.
for (const [dip, direction] of [[46, 128], [10, 300], [0, 0]]) {
  const slope = Math.sin((dip * Math.PI) / 180), a = (direction * Math.PI) / 180;
  const of = planeOf(poleWith([slope * Math.sin(a), slope * Math.cos(a), Math.cos((dip * Math.PI) / 180)]));
  near(of.dip, dip, 1e-6);
  if (dip > 0) near(of.direction, direction, 1e-9);
}
for (const [normal, direction] of [[[1, 0, 0], 90], [[-1, 0, 0], 270], [[0, 1, 0], 0], [[0, -1, -0], 180]]) {
  assert.deepEqual(planeOf(poleWith(normal)), { dip: 90, direction });
  assert.equal(orientationText({ normal }, false), `90°/${String(direction).padStart(3, '0')}°`);
  nearPoint(onNet(poleWith(normal)), onNet(poleOf(90, direction)), 1e-12);
}
assert.equal(orientationText({ normal: [-0.001, Math.SQRT1_2, Math.SQRT1_2] }, false), '45°/000°', 'not 360');

// ---- friction circles: poles of planes that dip as the friction are nearer to the centre than lines that plunge as it does
for (const [friction, pole, line] of [[29, 0.354090797, 0.717767636], [30, 0.366025404, 0.707106781], [41, 0.495268028, 0.586464808]]) {
  for (const [piece, radius] of [[smallCircle([0, 0, -1], friction)[0], pole], [smallCircle([0, 0, -1], 90 - friction)[0], line]])
    for (const [x, y] of piece) near(Math.hypot(x, y), radius);
}
// equal angle: great circles are circles
for (const [x, y] of greatCircle(46, 128, 'angle')) near(Math.hypot(x + 0.816009023, y - 0.637536121), 1.43955654);
// the steepest dips that leave the face 70/180
for (const [direction, dip] of [[180, 70], [150, 67.204122741], [120, 53.947611268], [100, 25.505550261]]) {
  const nearest = Math.min(...daylightEnvelope({ dip: 70, direction: 180 }).map(([x, y]) => { const p = onNet(poleOf(dip, direction)); return Math.hypot(x - p[0], y - p[1]); }));
  assert.ok(nearest < 0.012, `${direction}: ${nearest}`);
}

// ---- zones against the counts of core/key_blocks (kinematics_test.cpp), by another method
const joints = readFileSync(join(source, 'core/testing/kinematic_joints.csv'), 'utf8').trim().split('\n').slice(1).map((row) => row.split(','));
const poles = joints.map((row) => poleOf(Number(row[5]), Number(row[6])));
const COUNTS = [[70, 180, 30, [73, 46, 42, 7028, 1947, 214, 1782]], [65, 185, 35, [69, 50, 37, 5640, 2225, 250, 3025]], [80, 190, 25, [81, 68, 41, 8254, 2206, 616, 889]]];
for (const [dip, direction, friction, wanted] of COUNTS) {
  const request = { face: { dip, direction }, friction, limits: { plane: 20, flexural: 30, direct: 20 } }, of = poleZones(request), lines = lineZones(request);
  const slides = poles.filter((pole) => of.plane(pole) > 0), pairs = [];
  for (let i = 0; i < poles.length; ++i) for (let j = i + 1; j < poles.length; ++j) pairs.push(between(poles[i], poles[j]));
  const count = (list, zone) => list.filter((v) => zone(v) >= 0).length;
  assert.deepEqual([slides.length, count(slides, of.planeWithin), count(poles, of.flexural), count(pairs, lines.primary), count(pairs, lines.secondary),
    count(pairs, lines.toppling), count(pairs, lines.oblique)], wanted, `face ${dip}/${direction}`);
}

// ---- density (per cent for each 1 % of the net), and means
near(density(poles, poleOf(48, 195)), 8.693580618, 1e-8);
near(density(poles, poleOf(62, 95)), 9.978721562, 1e-8);
near(density(poles, poleOf(76, 10)), 5.29652023, 1e-8);
near(density([[0, 0, -1]], [0, 0, -1]), 100, 1e-9);
{
  // poles on both sides of the horizon have their mean at it
  const { mean } = fisherMean([poleOf(88, 10), poleOf(88, 190)]);
  near(Math.abs(planeOf(mean).dip - 90), 0, 1e-9);
  const { mean: third, constant } = fisherMean(poles.filter((_, k) => joints[k][1] === 'J3'));
  near(planeOf(third).dip, 75.41, 0.01);
  near(constant, 23.926, 1e-3);
}
// ---- weights of a scanline: 1/sin of its angle to the plane, by the angle itself; the largest; counts and densities
for (const [dip, direction, plunge, trend, angle] of [[0, 0, 90, 0, 90], [90, 90, 0, 90, 90], [90, 90, 0, 120, 60], [60, 180, 30, 0, 90], [45, 90, 0, 90, 45], [30, 270, 0, 270, 30]])
  near(terzaghiWeight(poleOf(dip, direction), lineOf(plunge, trend), 1000), 1 / Math.sin((angle * Math.PI) / 180), 1e-12);
assert.equal(terzaghiWeight(poleOf(5, 90), lineOf(0, 90), 10), 10);
assert.equal(terzaghiWeight(poleOf(0, 0), lineOf(0, 33), 10), 10);
{
  // a weight of 2 is a joint twice, and equal weights are none
  const few = poles.slice(0, 40), at = poleOf(48, 195), weights = few.map((_, k) => 1 + (k % 2)), twice = [...few, ...few.filter((_, k) => k % 2)];
  near(density(few, at, weights), density(twice, at), 1e-12);
  nearPoint(fisherMean(few, weights).mean, fisherMean(twice).mean, 1e-12);
  const same = fisherMean(few, few.map(() => 3)), plain = fisherMean(few);
  near(same.constant, plain.constant, 1e-9);
  near(same.cone, plain.cone, 1e-9);
  // unequal weights know less of the mean than their number
  assert.ok(fisherMean(few, few.map((_, k) => (k ? 1 : 10))).cone > plain.cone);
  // joints that a vertical borehole meets at random: those it would meet less often count for as many as it missed
  let counts = [0, 0], sums = [0, 0];
  for (let k = 0; k < 100000; ++k) {
    const steep = k % 2, pole = poleOf(steep ? 75 : 15, 40), met = ((k * 0.6180339887498949) % 1) < Math.abs(pole[2]);
    if (met) { counts[steep] += 1; sums[steep] += terzaghiWeight(pole, lineOf(90, 0), 10); }
  }
  assert.ok(counts[1] < 0.3 * counts[0] && Math.abs(sums[1] / sums[0] - 1) < 0.01, `${counts} ${sums}`);
}

// ---- the line of a level through a grid: on a plane it is straight, wherever the cells are crossed
{
  const nx = 6, ny = 5, values = Array.from({ length: nx * ny }, (_, k) => 0.3 * (k % nx) + 0.7 * Math.floor(k / nx) - 1), line = levelLine(values, nx, 0.55);
  assert.ok(line.length >= 5);
  for (const [x, y] of line.flat()) near(0.3 * x + 0.7 * y - 1, 0.55, 1e-12);
  const ends = line.flat(), length = line.reduce((sum, [a, b]) => sum + Math.hypot(a[0] - b[0], a[1] - b[1]), 0);
  const [left, right] = [Math.min(...ends.map((p) => p[0])), Math.max(...ends.map((p) => p[0]))];
  near(length, (right - left) * Math.hypot(1, 0.3 / 0.7), 1e-9);
  assert.deepEqual(levelLine(values, nx, 99), []);
  assert.ok(levelLine(values.map((v, k) => (k === 14 ? NaN : v)), nx, 0.55).length < line.length);
}
// ---- the strength of a lining's section: each point of the curve has a utilisation of 1, as core/support counts it
{
  const section = { thickness_m: 0.3, compressive_strength_Pa: 20e6, tensile_strength_Pa: 2e6 }, curve = envelope(section);
  const use = ([moment, thrust]) => { const bending = (6 * Math.abs(moment)) / 0.3 ** 2, n = thrust / 0.3; return Math.max((bending + n) / 20e6, (bending - n) / 2e6); };
  assert.equal(curve.length, 5);
  curve.slice(1).forEach((point, k) => { for (const t of [0, 0.3, 1]) near(use(point.map((x, i) => x + t * (curve[k][i] - x))), 1, 1e-12); });
  assert.deepEqual(envelope({ thickness_m: 0.3 }), []);
  // once around from the right, over the crown; an arc from below the right to below the left
  const ring = angles([359.99, 90, 180, 270].map((a) => ({ x: 5 + 3 * Math.cos((a * Math.PI) / 180), y: 3 * Math.sin((a * Math.PI) / 180) })));
  ring.forEach((a, k) => near(a, 90 * k, 0.02));
  const arc = angles([-30, 30, 90, 150, 210].map((a) => ({ x: Math.cos((a * Math.PI) / 180), y: Math.sin((a * Math.PI) / 180) })));
  assert.ok(arc[0] < 0 && arc.at(-1) > 180 && arc.every((a, k) => !k || a > arc[k - 1]), arc.join());
}
console.log('the figures are right');
