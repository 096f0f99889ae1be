// Stereonets as the field draws them: poles with great circles of the sets' means, cones of their confidence and contours
// of density; with a rock face two nets, poles for plane sliding and flexural toppling, lines for wedges and direct
// toppling, each with its own friction circle: 90° - φ from the rim for poles, φ for lines.
import * as Plot from '@observablehq/plot';
import { digits, OKABE } from '../colours.js';
import { framed, LOOK } from './figures.js';
import { between, daylightEnvelope, density, fisherMean, fromNet, greatCircle, lineOf, lineZones, onNet, planeOf, poleZones, smallCircle, terzaghiWeight } from './net.js';
import { paragraph } from './parts.js';
import { element, table } from './table.js';

const MARGIN = 34, RADIUS = Math.min(200, LOOK.width / 2 - MARGIN), MOST_DOTS = 4000, MOST_CONTOURED = 1500;
const SLIDES = OKABE[1], TOPPLES = OKABE[3], FACE = '#202020';
const DENSITIES = [2, 4, 6, 8, 10, 12, 15, 20, 30, 50];
const vertical = [0, 0, -1];
export const orientation = ({ dip, direction }) => `${String(Math.round(dip)).padStart(2, '0')}/${String(Math.round(direction) % 360).padStart(3, '0')}`;

const lines = (pieces, options) => pieces.map((piece) => Plot.line(piece, options));
const rim = Array.from({ length: 181 }, (_, i) => onNet(lineOf(0, 2 * i)));
const ticks = Array.from({ length: 36 }, (_, k) => 10 * k);

// where a function of the direction is positive, filled; or its contours
function field(kind, value, options) {
  return Plot.contour({ x1: -1, y1: -1, x2: 1, y2: 1, pixelSize: 3, interpolate: 'none',
    value: (x, y) => { const v = fromNet(x, y, kind); return v ? value(v) : NaN; }, ...options });
}
const zone = (kind, value, colour) => field(kind, value, { thresholds: [0], fill: colour, fillOpacity: 0.2, stroke: 'none' });

// the grid of 10 degrees, the rim and its numbers
function grid(kind) {
  const edge = (trend, r) => onNet(lineOf(0, trend)).map((x) => r * x);
  return [
    ...[10, 20, 30, 40, 50, 60, 70, 80].flatMap((plunge) => lines(smallCircle(vertical, 90 - plunge, kind), { stroke: '#ececec' })),
    ...[0, 30, 60, 90, 120, 150].map((trend) => Plot.line([edge(trend, 1), edge(trend + 180, 1)], { stroke: '#ececec' })),
    Plot.line(rim, { stroke: '#404040' }),
    Plot.link(ticks, { x1: (t) => edge(t, 1)[0], y1: (t) => edge(t, 1)[1], x2: (t) => edge(t, t % 90 ? 1.02 : 1.04)[0], y2: (t) => edge(t, t % 90 ? 1.02 : 1.04)[1], stroke: '#404040' }),
    Plot.text(ticks.filter((t) => t % 30 === 0), { x: (t) => edge(t, 1.1)[0], y: (t) => edge(t, 1.1)[1], text: (t) => (t === 0 ? 'N' : String(t).padStart(3, '0')) }),
  ];
}

// lines through the centre, at an angle to both sides of a trend
const limits = (trend, angle, kind) => [-angle, angle].map((turn) => Plot.line([[0, 0], onNet(lineOf(0, trend + turn), kind)], { stroke: '#606060', strokeDasharray: '2 3' }));
const named = (v, text, kind) => Plot.text([onNet(v, kind)], { text: () => text, fill: '#202020', stroke: 'white', strokeWidth: 3 });

// `sets`: those that the legend names
export function round(name, caption, sets, marks) {
  return framed(Plot.plot({ ...LOOK, width: 2 * (RADIUS + MARGIN), height: 2 * (RADIUS + MARGIN), margin: MARGIN, marginLeft: MARGIN, marginBottom: MARGIN,
    x: { domain: [-1, 1], axis: null }, y: { domain: [-1, 1], axis: null },
    color: { type: 'categorical', domain: sets.map((set) => set.name), range: sets.map((set) => set.colour), legend: sets.length > 0 }, marks }), name, caption);
}

const weightsOf = (set) => set.weights ?? set.poles.map(() => 1);
const dots = (points, kind, options) => {
  const every = Math.ceil(points.length / MOST_DOTS);
  return Plot.dot(points.filter((_, k) => k % every === 0), { x: (p) => onNet(p.at, kind)[0], y: (p) => onNet(p.at, kind)[1], r: points.length > 300 ? 1.8 : 3.2, ...options });
};
const poleDots = (sets, kind) => dots(sets.flatMap((set) => set.poles.map((at) => ({ at, set: set.name }))), kind,
  { fill: 'set', stroke: 'white', strokeWidth: 0.4, title: (p) => `${p.set}: ${orientation(planeOf(p.at))} (dip/dip direction)` });

function contours(sets, kind) {
  const all = sets.flatMap((set) => set.poles), every = Math.ceil(all.length / MOST_CONTOURED), kept = (list) => list.filter((_, k) => k % every === 0);
  const poles = kept(all), weights = kept(sets.flatMap(weightsOf));
  return field(kind, (v) => density(poles, v, weights), { thresholds: DENSITIES, stroke: '#808080', strokeWidth: 0.8, fill: 'none' });
}

function means(sets, kind) {
  return sets.filter((set) => set.poles.length > 1).flatMap((set) => {
    const { mean, cone } = fisherMean(set.poles, weightsOf(set)), plane = planeOf(mean);
    return [Plot.line(greatCircle(plane.dip, plane.direction, kind), { stroke: () => set.name, strokeWidth: 1.5 }),
      ...(Number.isFinite(cone) && cone > 0.05 ? lines(smallCircle(mean, cone, kind), { stroke: '#202020', strokeDasharray: '3 2' }) : [])];
  });
}

// `sets`: name, colour, poles, and weights if the reader chose them
export function polesNet(sets, kind) {
  const many = sets.some((set) => set.poles.length >= 10);
  const single = sets.filter((set) => set.poles.length === 1).map((set) => { const { dip, direction } = planeOf(set.poles[0]); return Plot.line(greatCircle(dip, direction, kind), { stroke: () => set.name, strokeWidth: 1.5 }); });
  return round('poles', `Poles of the joints by set, great circles of the sets' mean planes${many ? ', cones in which the true means lie with 95 % confidence (dashed), contours of density in multiples of the uniform one (Fisher counting): '
    + `${DENSITIES.slice(0, 5).join(', ')} and more` : ''}.`, sets, [...(many ? [contours(sets, kind)] : []), ...grid(kind), ...means(sets, kind), ...single, poleDots(sets, kind)]);
}

export function slidingPoles(sets, request, kind) {
  const { face, friction, limits: lateral } = request, zones = poleZones(request);
  return round('poles-of-the-face', `Poles: plane sliding (orange: outside the friction circle, inside the daylight envelope, between the lateral limits of ${lateral.plane}°) and flexural toppling (purple: beyond the great circle of the slip limit ${orientation({ dip: face.dip - friction, direction: face.direction })}, within ${lateral.flexural}°). The friction circle of poles is ${friction}° from the centre.`,
    sets, [zone(kind, (pole) => Math.min(zones.plane(pole), zones.planeWithin(pole)), SLIDES), zone(kind, zones.flexural, TOPPLES), ...grid(kind),
      ...lines(smallCircle(vertical, friction, kind), { stroke: SLIDES }), Plot.line(daylightEnvelope(face, kind), { stroke: SLIDES, strokeDasharray: '6 3' }),
      Plot.line(greatCircle(face.dip, face.direction, kind), { stroke: FACE, strokeWidth: 2 }),
      ...(face.dip > friction ? [Plot.line(greatCircle(face.dip - friction, face.direction, kind), { stroke: TOPPLES })] : []),
      ...limits(face.direction + 180, lateral.plane, kind), ...limits(face.direction, lateral.flexural, kind), poleDots(sets, kind),
      named(lineOf(face.dip, face.direction), 'face', kind)]);
}

export function slidingLines(sets, request, kind) {
  const { face, friction, limits: lateral } = request, zones = lineZones(request), poles = sets.flatMap((set) => set.poles), points = [];
  const every = Math.max(1, Math.ceil((poles.length * (poles.length - 1)) / 2 / MOST_DOTS));
  for (let i = 0, n = 0; i < poles.length; ++i) for (let j = i + 1; j < poles.length; ++j) if (n++ % every === 0) {
    const at = between(poles[i], poles[j]);
    if (at.every(Number.isFinite)) points.push({ at });
  }
  return round('lines-of-the-face', `Lines of intersection${every > 1 ? ` (each ${every}th of them)` : ''}: wedge sliding (orange: steeper than the friction and out of the face; light: the secondary zone, perhaps on one plane) and direct toppling (purple: into the slope, within ${lateral.direct}°; light: oblique). The friction circle of lines is ${friction}° from the rim.`,
    [], [zone(kind, zones.primary, SLIDES), field(kind, zones.secondary, { thresholds: [0], fill: SLIDES, fillOpacity: 0.08, stroke: 'none' }),
      zone(kind, zones.toppling, TOPPLES), field(kind, zones.oblique, { thresholds: [0], fill: TOPPLES, fillOpacity: 0.08, stroke: 'none' }), ...grid(kind),
      ...lines(smallCircle(vertical, 90 - friction, kind), { stroke: SLIDES }), Plot.line(greatCircle(face.dip, face.direction, kind), { stroke: FACE, strokeWidth: 2 }),
      ...lines(smallCircle(vertical, face.dip, kind), { stroke: TOPPLES, strokeDasharray: '6 3' }), ...limits(face.direction + 180, lateral.direct, kind),
      dots(points, kind, { fill: '#404040', fillOpacity: 0.5 }), named(lineOf(face.dip, face.direction), 'face', kind)]);
}

// ---- the reader's choices

const angle = (v, places) => String(Math.round(v)).padStart(places, '0');

// A scanline's direction, which the reader may state: `of` gives sets their weights, `text` says so, and `redraws` are
// called when it changes.
export function scanlineChoice() {
  const choice = { redraws: [], of: (sets) => sets, text: '' };
  const field = (name, words, value, most) => {
    const input = element('input', { type: 'number', name, min: name === 'largest' ? 1 : 0, max: most, step: 'any', value });
    input.oninput = read;
    return [input, element('label', {}, words, ' ', input)];
  };
  const [trend, trendField] = field('trend', 'trend', '', 360), [plunge, plungeField] = field('plunge', 'plunge', '', 90);
  const [largest, largestField] = field('largest', 'largest weight', 10, 1000);
  function read() {
    const fields = [trend, plunge, largest], valid = fields.every((input) => input.value !== '' && input.checkValidity());
    const line = lineOf(Number(plunge.value), Number(trend.value)), most = Number(largest.value);
    choice.of = (sets) => (valid ? sets.map((set) => ({ ...set, largest: most, weights: set.poles.map((pole) => terzaghiWeight(pole, line, most)) })) : sets);
    choice.text = valid ? `A choice of this page's reader: joints are weighted for a scanline or borehole of plunge/trend ${angle(Number(plunge.value), 2)}/${angle(Number(trend.value), 3)} `
      + `by 1/sin of the angle between it and the joint, ${most} at most (Terzaghi 1965). Counts, densities and means follow.` : '';
    for (const redraw of choice.redraws) redraw();
  }
  choice.element = element('p', { class: 'choice' }, 'If the joints were mapped along one scanline or borehole, state its direction (°) to weight them: ', trendField, ' ', plungeField, ' ', largestField);
  return choice;
}

// nets with the choice of their projection; `draw` gets it and the sets, with weights if the reader chose them
export function withProjection(sets, scanline, draw) {
  const select = element('select', {}, element('option', { value: 'area' }, 'equal area'), element('option', { value: 'angle' }, 'equal angle'));
  const shown = element('div', { class: 'nets' });
  const redraw = () => shown.replaceChildren(...[paragraph(scanline.text, { class: 'chosen' }), ...draw(select.value, scanline.of(sets))].filter(Boolean));
  select.onchange = redraw;
  scanline.redraws.push(redraw);
  redraw();
  return [element('label', { class: 'choice' }, 'Projection, lower hemisphere: ', select), shown];
}

// name, number of joints, mean dip and dip direction, Fisher's constant, cone of 95 %
function setTable(sets) {
  const weighted = sets.some((set) => set.weights);
  return table(['set', 'joints', ...(weighted ? ['of the largest weight', 'weighted joints', 'weighted share (%)'] : []), 'mean dip/dip direction', 'Fisher\'s constant', 'cone of 95 % (°)'], sets.map((set) => {
    const { mean, constant, cone } = fisherMean(set.poles, weightsOf(set)), sum = total(set);
    return [set.name, set.poles.length, ...(weighted ? [set.weights.filter((w) => w === set.largest).length, sum.toFixed(1), ((100 * sum) / sets.reduce((all, other) => all + total(other), 0)).toFixed(1)] : []),
      orientation(planeOf(mean)), Number.isFinite(constant) ? digits(constant) : '', Number.isFinite(cone) ? cone.toFixed(1) : ''];
  }), { numbers: weighted ? [1, 2, 3, 4, 6, 7] : [1, 3, 4] });
}
const total = (set) => weightsOf(set).reduce((sum, w) => sum + w, 0);

// the net of joints by set, and its table, with the reader's choices
export const jointNets = (sets, scanline = scanlineChoice()) => [scanline.element, ...withProjection(sets, scanline, (kind, chosen) => [polesNet(chosen, kind), setTable(chosen)])];

// of the poles of all sets, the weighted share in each zone of a face; nothing without weights
export function weightedZones(sets, request) {
  if (!sets.some((set) => set.weights)) return null;
  const zones = poleZones(request), all = sets.reduce((sum, set) => sum + total(set), 0);
  const inside = (zone) => sets.reduce((sum, set) => sum + set.poles.reduce((part, pole, k) => part + (zone(pole) >= 0 ? set.weights[k] : 0), 0), 0);
  return table(['zone of poles', 'weighted joints', 'weighted share (%)'], [['plane sliding', (pole) => zones.plane(pole)],
    ['plane sliding, within the lateral limits', (pole) => Math.min(zones.plane(pole), zones.planeWithin(pole))], ['flexural toppling, by the great circle of the slip limit', zones.flexural]].map(([name, zone]) => {
    const sum = inside(zone);
    return [name, sum.toFixed(1), ((100 * sum) / all).toFixed(1)];
  }), { numbers: [1, 2] });
}
