// The page's figures, all by Observable Plot, in one look.
import * as Plot from '@observablehq/plot';
import { digits, OKABE } from '../colours.js';
import { element, save } from './table.js';
import { capital } from './words.js';

// as wide as a phone at most, so that its letters keep their size
const WIDTH = Math.min(640, document.documentElement.clientWidth - 40);
export const LOOK = { width: WIDTH, height: 300, marginLeft: 62, marginBottom: 44, style: { background: 'white', color: '#202020', overflow: 'visible', fontSize: '12px', fontFamily: 'DejaVu Sans, Helvetica, Arial, sans-serif' } };
export const STABLE = OKABE[0], FAILED = OKABE[1];

const svgElement = (name, attributes, ...children) => {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
};

// The plot, with its legend above it, which Plot makes of elements of the page.
function standAlone(figure, plot) {
  const width = Number(plot.getAttribute('width')), rows = [], row = 20, [ramp] = [...figure.querySelectorAll('svg')].filter((svg) => svg !== plot && svg.querySelector('image'));
  let x = 0;
  for (const swatch of figure.querySelectorAll('[class$="-swatch"]')) {
    const length = 30 + 8 * swatch.textContent.length;
    if (x + length > width || !rows.length) { rows.push([]); x = 0; }
    rows.at(-1).push(svgElement('rect', { x, y: row * rows.length - 17, width: 13, height: 13, fill: swatch.querySelector('svg').getAttribute('fill') }),
      svgElement('text', { x: x + 18, y: row * rows.length - 6 }, swatch.textContent));
    x += length;
  }
  const top = ramp ? Number(ramp.getAttribute('height')) : row * rows.length, height = Number(plot.getAttribute('height'));
  const copy = plot.cloneNode(true);
  copy.setAttribute('y', top);
  // to a twentieth of a point, which halves a file
  for (const path of copy.querySelectorAll('path[d]')) path.setAttribute('d', path.getAttribute('d').replace(/\d+\.\d{2,}/g, (x) => String(Number(Number(x).toFixed(1)))));
  return svgElement('svg', { xmlns: 'http://www.w3.org/2000/svg', width, height: top + height, viewBox: `0 0 ${width} ${top + height}`, style: plot.getAttribute('style') },
    svgElement('rect', { width: '100%', height: '100%', fill: 'white' }), ...(ramp ? [ramp.cloneNode(true)] : rows.flat()), copy);
}
const textOf = (svg) => new XMLSerializer().serializeToString(svg);

function savePng(svg, name) {
  const image = new Image(), scale = 2, [width, height] = ['width', 'height'].map((key) => Number(svg.getAttribute(key)));
  image.onload = () => {
    const canvas = element('canvas', { width: scale * width, height: scale * height });
    canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => save(`${name}.png`, blob));
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(textOf(svg))}`;
}

// the figure with its caption, and buttons that save it
export function framed(drawn, name, caption) {
  const svg = drawn.tagName === 'svg' ? drawn : [...drawn.children].findLast((child) => child.tagName === 'svg');
  const button = (words, act) => {
    const made = element('button', { type: 'button', class: 'small' }, words);
    made.onclick = act;
    return made;
  };
  svg.setAttribute('role', 'img');
  svg.setAttribute('aria-label', caption);
  return element('figure', { 'data-name': name }, drawn, element('figcaption', {}, caption, ' ',
    button('SVG', () => save(`${name}.svg`, new Blob([textOf(standAlone(drawn, svg))], { type: 'image/svg+xml' }))),
    button('PNG', () => savePng(standAlone(drawn, svg), name))));
}

// the SVG of a figure of the page, as the page's address asks for it: docs/make_pictures.sh
export function svgOf(name) {
  const figure = document.querySelector(`figure[data-name="${CSS.escape(name)}"]`);
  return figure ? textOf(standAlone(figure, figure.querySelector('svg[role=img]'))) : '';
}

const outcomes = { domain: ['stable', 'failed', 'undecided'], range: [STABLE, FAILED, '#808080'], legend: true };

// the levels of a search in the order of its trials
export function convergence(trials, critical, levelName) {
  return framed(Plot.plot({ ...LOOK, color: outcomes, symbol: { domain: outcomes.domain },
    x: { label: 'trial', ticks: Math.min(trials.length, 12), tickFormat: 'd' }, y: { label: levelName, grid: true, nice: true },
    marks: [Number.isFinite(critical) ? Plot.ruleY([critical], { stroke: '#404040', strokeDasharray: '5 3' }) : null,
      Plot.line(trials, { x: 'trial', y: 'level', stroke: '#c0c0c0' }),
      Plot.dot(trials, { x: 'trial', y: 'level', fill: 'outcome', symbol: 'outcome', stroke: 'outcome', r: 4.5, tip: true })] }),
  'convergence', `The search: level of each trial${Number.isFinite(critical) ? '; dashed: the result' : ''}.`);
}

// the level against the displacement at the end of its trial, as users look for the knee
export function knee(trials, critical, levelName) {
  const moved = trials.filter((trial) => trial.moved > 1e-12);
  if (moved.length < 2) return null;
  return framed(Plot.plot({ ...LOOK, color: outcomes, symbol: { domain: outcomes.domain },
    x: { type: 'log', label: 'displacement of the body that moved most (m)', ticks: 4, tickFormat: '~g' }, y: { label: levelName, grid: true, nice: true },
    marks: [Number.isFinite(critical) ? Plot.ruleY([critical], { stroke: '#404040', strokeDasharray: '5 3' }) : null,
      Plot.dot(moved, { x: 'moved', y: 'level', fill: 'outcome', symbol: 'outcome', stroke: 'outcome', r: 4.5, tip: true })] }),
  'displacement', 'Level against displacement at the end of each trial.');
}

// `columns`: name and values of each; they have one unit
export function history(time, columns, unit, name) {
  const points = columns.flatMap((column) => time.map((t, i) => ({ t, value: column.values[i], column: column.name })))
    .filter((point) => Number.isFinite(point.value));
  return framed(Plot.plot({ ...LOOK, color: { range: OKABE, legend: columns.length > 1 },
    x: { label: 'time (s)' }, y: { label: unit ? `${columns.length > 1 ? 'value' : columns[0].name} (${unit})` : columns[0].name, grid: true, nice: true },
    marks: [Plot.line(points, { x: 't', y: 'value', stroke: 'column' }), points.length < 60 ? Plot.dot(points, { x: 't', y: 'value', fill: 'column', r: 2 }) : null] }),
  name, columns.map((column) => column.name).join(', ') + ' over time.');
}

// ---- studies

// on a light rim, so that it is seen on bars too
const limit = (threshold) => (Number.isFinite(threshold) ? [Plot.ruleX([threshold], { stroke: 'white', strokeWidth: 4 }), Plot.ruleX([threshold], { stroke: FAILED, strokeDasharray: '5 3', strokeWidth: 1.5 })] : null);

export function histogram(values, bins, threshold, quantity, name) {
  return framed(Plot.plot({ ...LOOK, x: { label: quantity, nice: true }, y: { label: 'rows', grid: true },
    marks: [Plot.rectY(bins, { x1: 'from', x2: 'to', y: 'count', fill: STABLE, fillOpacity: 0.75, insetLeft: 0.5, insetRight: 0.5 }), Plot.ruleY([0]), limit(threshold)] }),
  name, `Histogram of ${values.length} results${Number.isFinite(threshold) ? '; dashed: the limit of failure' : ''}.`);
}

export function cumulative(values, threshold, quantity, name) {
  const ascending = [...values].sort((a, b) => a - b).map((value, i) => ({ value, share: (100 * (i + 1)) / values.length }));
  return framed(Plot.plot({ ...LOOK, x: { label: quantity, nice: true }, y: { label: 'rows up to this (%)', grid: true, domain: [0, 100] },
    marks: [limit(threshold), Plot.line(ascending, { x: 'value', y: 'share', curve: 'step-after', stroke: STABLE })] }),
  name, `Cumulative curve of the results${Number.isFinite(threshold) ? '; it meets the dashed limit at the share below it' : ''}.`);
}

// `effects`: name and rank correlation, the strongest first
export function tornado(effects, quantity, name) {
  return framed(Plot.plot({ ...LOOK, height: 60 + 26 * effects.length, marginLeft: 170, x: { label: `rank correlation with ${quantity}`, domain: [-1, 1], grid: true },
    y: { label: null, domain: effects.map((effect) => effect.name) },
    marks: [Plot.barX(effects, { y: 'name', x: 'effect', fill: (effect) => (effect.effect > 0 ? STABLE : FAILED) }), Plot.ruleX([0])] }),
  name, 'On what the result depends: Spearman\'s rank correlation, +1 if it rises with the quantity, −1 if it falls.');
}

// `estimates`: probability and interval after so many rows
export function probabilityConvergence(estimates, name) {
  return framed(Plot.plot({ ...LOOK, x: { label: 'rows of importance sampling' }, y: { label: 'probability of failure', grid: true, nice: true, tickFormat: '~g' }, marginLeft: 76,
    marks: [Plot.areaY(estimates, { x: 'rows', y1: 'low', y2: 'high', fill: STABLE, fillOpacity: 0.2 }), Plot.line(estimates, { x: 'rows', y: 'p', stroke: STABLE })] }),
  name, 'The probability as rows are added, with its interval of 95 %.');
}

// `counts`: name and share in percent, the largest first
export function importances(counts, name) {
  return framed(Plot.plot({ ...LOOK, height: 60 + 26 * counts.length, marginLeft: 170, x: { label: 'share of the design point (%)', domain: [0, 100], grid: true },
    y: { label: null, domain: counts.map((count) => count.name) }, marks: [Plot.barX(counts, { y: 'name', x: 'share', fill: STABLE }), Plot.ruleX([0])] }),
  name, 'How much each key counts: squares of the direction of the nearest design point.');
}

export function sweepFigure(points, numeric, label, quantity, name) {
  const far = numeric && points.every((point) => point.x > 0) && Math.max(...points.map((p) => p.x)) > 30 * Math.min(...points.map((p) => p.x));
  return framed(Plot.plot({ ...LOOK, x: numeric ? { label, type: far ? 'log' : 'linear', tickFormat: far ? '~g' : undefined, nice: true } : { label, type: 'point', domain: points.map((p) => p.x) },
    y: { label: quantity, grid: true, nice: true },
    marks: [numeric ? Plot.line(points, { x: 'x', y: 'result', stroke: STABLE }) : null,
      Plot.ruleX(points.filter((p) => p.bar > 0), { x: 'x', y1: (p) => p.result - p.bar, y2: (p) => p.result + p.bar, stroke: STABLE }),
      Plot.dot(points, { x: 'x', y: 'result', fill: STABLE, r: 4, tip: true })] }),
  name, `${quantity} against ${label}; bars are numerical.`);
}

// A grid's cells by their places; marks, a cross in what fails and a ring in what is within its error bar of the limit.
export function gridMap({ places, x, y, quantity, range, limit, line, title }, name) {
  const known = places.filter((place) => Number.isFinite(place.value)), few = places.length <= 120, marked = (verdict) => places.filter((place) => place.fails === verdict);
  const box = { x1: (p) => p.x - 0.5, x2: (p) => p.x + 0.5, y1: (p) => p.y - 0.5, y2: (p) => p.y + 0.5, inset: 0.5 };
  const ticks = (values) => values.map((_, k) => k).filter((k) => k % Math.ceil(values.length / 12) === 0);
  const longest = Math.max(...y.values.map((value) => value.length));
  const notes = [line.length ? `line: ${digits(limit)}, interpolated` : '', marked('yes').length ? '×: fails' : '', marked('undecided').length ? '○: within its error bar of the limit' : '', known.length < places.length ? 'grey: no result' : ''].filter(Boolean);
  return framed(Plot.plot({ ...LOOK, height: 90 + Math.min(420, Math.max(140, 40 * y.values.length)), marginLeft: 30 + 8 * longest, marginRight: 20,
    color: { type: 'linear', range: ['#f7fbff', '#6aaed6'], domain: range[0] < range[1] ? range : [range[0] - 1, range[0] + 1], legend: true, label: quantity },
    x: { label: x.label, domain: [-0.5, x.values.length - 0.5], ticks: ticks(x.values), tickFormat: (k) => x.values[k] },
    y: { label: y.label, domain: [-0.5, y.values.length - 0.5], ticks: ticks(y.values), tickFormat: (k) => y.values[k] },
    marks: [Plot.rect(places, { ...box, fill: '#dddddd' }), Plot.rect(known, { ...box, fill: 'value' }),
      Plot.link(line, { x1: (s) => s[0][0], y1: (s) => s[0][1], x2: (s) => s[1][0], y2: (s) => s[1][1], stroke: FAILED, strokeWidth: 2.5 }),
      few ? Plot.text(known, { x: 'x', y: 'y', text: (p) => digits(p.value), fill: '#202020' }) : null,
      Plot.dot(marked('yes'), { x: 'x', y: 'y', dy: few ? 13 : 0, r: 4, symbol: 'times', stroke: '#202020', strokeWidth: 1.5 }),
      Plot.dot(marked('undecided'), { x: 'x', y: 'y', dy: few ? 13 : 0, r: 4, stroke: '#202020', strokeWidth: 1.5 })] }),
  name, `${title}${capital(quantity)} by ${x.label} and ${y.label}${notes.length ? `; ${notes.join('; ')}` : ''}.`);
}

// ---- joints

const shares = (label) => ({ label, grid: true, domain: [0, 100] });
const pointsOf = (points, curve) => points.map(([value, share]) => ({ value, share, curve }));

// `sets`: name, colour, spacings_m; `rate` of the exponential law that spacings at random follow, 0: none is drawn
export function spacings(sets, rate) {
  const points = sets.flatMap((set) => pointsOf(set.spacings_m, set.name)), widest = Math.max(...points.map((point) => point.value));
  const law = rate > 0 ? Array.from({ length: 101 }, (_, k) => [(widest * k) / 100, 100 * (1 - Math.exp((-rate * widest * k) / 100))]) : [];
  return framed(Plot.plot({ ...LOOK, color: { type: 'categorical', domain: sets.map((set) => set.name), range: sets.map((set) => set.colour), legend: true },
    x: { label: 'spacing (m)', nice: true }, y: shares('spacings up to this (%)'),
    marks: [Plot.line(law, { stroke: '#808080', strokeDasharray: '5 3' }), Plot.line(points, { x: 'value', y: 'share', stroke: 'curve' })] }),
  'spacings', `Spacings along the mean normals${law.length ? `; dashed: exponential, ${digits(rate)} per metre` : ''}.`);
}

export function blockSizes(blocks, label) {
  const curves = [...pointsOf(blocks.by_number, 'of their number'), ...pointsOf(blocks.by_size, 'of the whole')];
  return framed(Plot.plot({ ...LOOK, color: { domain: ['of their number', 'of the whole'], range: OKABE, legend: true },
    x: { type: 'log', label, tickFormat: '~g' }, y: shares('in blocks up to this (%)'), marks: [Plot.line(curves, { x: 'value', y: 'share', stroke: 'curve' }),
      blocks.count < 60 ? Plot.dot(curves, { x: 'value', y: 'share', fill: 'curve', r: 2 }) : null] }), 'block-sizes', 'Block sizes.');
}

// ---- linings

// `curve`: the strength of the section, [moment, thrust]; empty if none is stated
export function interaction(nodes, curve, worst, caption, name) {
  return framed(Plot.plot({ ...LOOK, height: 380, x: { label: 'moment (kN m/m)', nice: true, grid: true }, y: { label: 'thrust (kN/m)', grid: true, nice: true },
    marks: [Plot.ruleX([0], { stroke: '#b0b0b0' }), Plot.ruleY([0], { stroke: '#b0b0b0' }), Plot.line(curve, { stroke: FAILED, strokeWidth: 1.5 }),
      Plot.dot(nodes, { x: 'moment', y: 'thrust', fill: STABLE, r: 2.5, title: (node) => `node ${node.node}` }),
      curve.length ? Plot.dot([worst], { x: 'moment', y: 'thrust', stroke: FAILED, strokeWidth: 2, r: 6 }) : null,
      curve.length ? Plot.text([worst], { x: 'moment', y: 'thrust', text: (node) => `node ${node.node}`, dy: -14 }) : null] }), name, caption);
}

// `columns`: key and name of each; those without a value are left out
export function alongLining(nodes, columns, label, caption, name) {
  const points = columns.flatMap(({ key, name: column }) => nodes.map((node) => ({ angle: node.angle, value: node[key], column }))).filter((point) => Number.isFinite(point.value));
  const domain = columns.map((column) => column.name).filter((column) => points.some((point) => point.column === column));
  const [first, last] = [nodes[0].angle, nodes.at(-1).angle], ticks = Array.from({ length: 17 }, (_, k) => 45 * (k - 4)).filter((t) => t >= first - 1 && t <= last + 1);
  return framed(Plot.plot({ ...LOOK, height: 240, color: { domain, range: OKABE, legend: domain.length > 1 }, x: { label: 'angle (°), 0 at the right, 90 at the crown', ticks },
    y: { label, grid: true, nice: true }, marks: [Plot.ruleY([0], { stroke: '#b0b0b0' }), Plot.line(points, { x: 'angle', y: 'value', stroke: 'column' })] }), name, caption);
}
