// The page's figures, all by Observable Plot, in one look.
import * as Plot from '@observablehq/plot';
import { OKABE } from '../colours.js';
import { element, save } from './table.js';

export const LOOK = { width: 640, height: 300, marginLeft: 62, marginBottom: 44, style: { background: 'white', color: '#202020', fontSize: '12px', fontFamily: 'DejaVu Sans, Helvetica, Arial, sans-serif' } };
export const STABLE = OKABE[0], FAILED = OKABE[1];

function svgText(drawn) {
  const copy = drawn.cloneNode(true);
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  return new XMLSerializer().serializeToString(copy);
}

function savePng(drawn, name) {
  const image = new Image(), scale = 2;
  image.onload = () => {
    const canvas = element('canvas', { width: scale * drawn.clientWidth, height: scale * drawn.clientHeight });
    const context = canvas.getContext('2d');
    context.fillStyle = 'white';
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => save(`${name}.png`, blob));
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgText(drawn))}`;
}

// the figure with its caption, and buttons that save it
export function framed(drawn, name, caption) {
  const svg = drawn.tagName === 'svg' ? drawn : drawn.querySelector('svg:last-of-type');
  const button = (words, act) => {
    const made = element('button', { type: 'button', class: 'small' }, words);
    made.onclick = act;
    return made;
  };
  svg.setAttribute('role', 'img');
  svg.setAttribute('aria-label', caption);
  return element('figure', {}, drawn, element('figcaption', {}, caption, ' ',
    button('SVG', () => save(`${name}.svg`, new Blob([svgText(svg)], { type: 'image/svg+xml' }))),
    button('PNG', () => savePng(svg, name))));
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
    x: { type: 'log', label: 'displacement of the body that moved most (m)', tickFormat: '~g' }, y: { label: levelName, grid: true, nice: true },
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

const limit = (threshold) => (Number.isFinite(threshold) ? Plot.ruleX([threshold], { stroke: FAILED, strokeDasharray: '5 3', strokeWidth: 1.5 }) : null);

export function histogram(values, bins, threshold, quantity, name) {
  return framed(Plot.plot({ ...LOOK, x: { label: quantity, nice: true }, y: { label: 'rows', grid: true },
    marks: [Plot.rectY(bins, { x1: 'from', x2: 'to', y: 'count', fill: STABLE, fillOpacity: 0.75, insetLeft: 0.5, insetRight: 0.5 }), Plot.ruleY([0]), limit(threshold)] }),
  name, `Histogram of ${values.length} results${Number.isFinite(threshold) ? '; dashed: the limit of failure' : ''}.`);
}

export function cumulative(values, threshold, quantity, name) {
  const ascending = [...values].sort((a, b) => a - b).map((value, i) => ({ value, share: (100 * (i + 1)) / values.length }));
  return framed(Plot.plot({ ...LOOK, x: { label: quantity, nice: true }, y: { label: 'rows up to this (%)', grid: true, domain: [0, 100] },
    marks: [Plot.line(ascending, { x: 'value', y: 'share', curve: 'step-after', stroke: STABLE }), limit(threshold)] }),
  name, `Cumulative curve of the results${Number.isFinite(threshold) ? '; it meets the dashed limit at the share below it' : ''}.`);
}

// `effects`: name and rank correlation, the strongest first
export function tornado(effects, quantity, name) {
  return framed(Plot.plot({ ...LOOK, height: 60 + 26 * effects.length, marginLeft: 170, x: { label: `rank correlation with ${quantity}`, domain: [-1, 1], grid: true },
    y: { label: null, domain: effects.map((effect) => effect.name) },
    marks: [Plot.barX(effects, { y: 'name', x: 'effect', fill: (effect) => (effect.effect > 0 ? STABLE : FAILED) }), Plot.ruleX([0])] }),
  name, 'On what the result depends: Spearman\'s rank correlation, +1 if it rises with the quantity, −1 if it falls.');
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
