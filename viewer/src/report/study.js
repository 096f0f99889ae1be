// The report on a study: of each sample how likely it fails, how the results scatter and what they depend on; of each
// reliability analysis its probability; of each grid a map; of each sweep the result against what it varies; the worst
// rows with their runs.
import { digits } from '../colours.js';
import { cumulative, histogram, sweepFigure, tornado } from './figures.js';
import { gridSection } from './grid.js';
import { bullets, header, paragraph, section } from './parts.js';
import { reliabilitySection } from './reliability.js';
import { element, list, readCsv, table } from './table.js';
import { capital, keyName, plural, quantityName, shownUnit, valueWithBar, withUnits } from './words.js';

const MOST_WORST = 10;

// ranks from 1; equal values share the mean of theirs
function ranks(values) {
  const order = values.map((value, i) => [value, i]).sort((a, b) => a[0] - b[0]), out = new Array(values.length);
  for (let k = 0; k < order.length;) {
    let end = k;
    while (end < order.length && order[end][0] === order[k][0]) ++end;
    for (let i = k; i < end; ++i) out[order[i][1]] = (k + end + 1) / 2;
    k = end;
  }
  return out;
}

// Spearman's coefficient: 1 if one rises whenever the other does, -1 if it falls; 0 if one of them never changes
export function rankCorrelation(x, y) {
  const a = ranks(x), b = ranks(y), mean = (x.length + 1) / 2;
  let ab = 0, aa = 0, bb = 0;
  a.forEach((_, i) => {
    ab += (a[i] - mean) * (b[i] - mean);
    aa += (a[i] - mean) ** 2;
    bb += (b[i] - mean) ** 2;
  });
  return aa > 0 && bb > 0 ? ab / Math.sqrt(aa * bb) : 0;
}

const folderOf = (study, row) => {
  const line = study.manifest[row];
  return line ? `runs/${line.hash}` : null;
};

function link(address, words) {
  return address ? element('a', { href: `${address}/` }, words) : words;
}

// rows of study.csv that a sweep, grid or sample of this name made, with their places in the study
const rowsOf = (study, name) => study.rows.map((row, place) => ({ ...row, place })).filter((row) => row.sweep === name);

function failureText({ below, above, count, standing, undecided, share, low, high, confidence }, unit) {
  const limit = below !== undefined ? `below ${withUnits(below, unit)}` : `above ${withUnits(above, unit)}`;
  return `${count} of ${count + standing + undecided} rows are ${limit}${undecided ? `, ${undecided} undecided` : ''}: probability ${digits(100 * share)} %, `
    + `with ${digits(100 * confidence)} % confidence between ${digits(100 * low)} and ${digits(100 * high)} %.`;
}

function sampleSection(study, { summary, csv }, number) {
  const { head, rows } = readCsv(csv), column = head.findIndex((name) => name === summary.quantity), keys = head.slice(1, column);
  const valid = rows.filter((row) => row[column] !== '' && Number.isFinite(Number(row[column])));
  const results = valid.map((row) => Number(row[column])), quantity = quantityName(summary.quantity), unit = summary.unit;
  const threshold = summary.failed?.below ?? summary.failed?.above;
  const effects = keys.map((key, k) => ({ ...keyName(key), effect: rankCorrelation(valid.map((row) => Number(row[k + 1])), results) }))
    .filter((key) => key.effect !== 0).sort((a, b) => Math.abs(b.effect) - Math.abs(a.effect));
  const worst = [...valid].sort((a, b) => (Number(a[column]) - Number(b[column])) * (summary.failed?.above !== undefined ? -1 : 1)).slice(0, MOST_WORST);
  const places = new Map(rowsOf(study, summary.name).map((row) => [row.value, row.place]));
  if (!valid.length) return section(`Sample: ${summary.name}`, paragraph(`None of ${plural(summary.rows, 'row')} has a result.`));
  const linked = worst.some((row) => places.has(row[0]));
  const made = [
    summary.failed ? element('p', { class: 'answer' }, element('span', {}, 'Probability of failure '), element('strong', {}, `${digits(100 * summary.failed.share)} %`)) : null,
    summary.failed ? paragraph(failureText(summary.failed, unit) + (summary.without_result ? ' Rows without a result are not counted: if they collapsed, more fail than that.' : '')) : null,
    paragraph(`${capital(quantity)}: mean ${withUnits(summary.mean, unit)} (standard error ${digits(summary.mean_error)}), deviation ${digits(summary.deviation)}, from ${digits(summary.smallest)} to ${digits(summary.largest)}; ${plural(summary.rows - summary.without_result, 'row')} of ${summary.rows} have a result.`),
    histogram(results, summary.histogram, threshold, quantity, `sample-${number}-histogram`),
    cumulative(results, threshold, quantity, `sample-${number}-cumulative`),
    effects.length ? tornado(effects, quantity, `sample-${number}-effects`) : null,
  ];
  const rowsShown = worst.map((row) => [row[0], ...keys.map((key, k) => digits(Number(row[k + 1]) / keyName(key).size)), digits(Number(row[column]))]);
  const drawn = table(['row', ...keys.map((key) => { const { name, unit: u } = keyName(key); return u ? `${name} (${u})` : name; }), quantity], rowsShown,
    { numbers: keys.map((_, k) => k + 1).concat(keys.length + 1), caption: `The worst rows${linked ? '; a row\'s number opens its run, beside the study' : ''}` });
  drawn.querySelectorAll('tbody tr').forEach((tr, k) => tr.cells[0].replaceChildren(link(folderOf(study, places.get(worst[k][0])), worst[k][0])));
  return section(`Sample: ${summary.name}`, ...made, drawn);
}

function sweepSection(study, name, number) {
  const rows = rowsOf(study, name), good = rows.filter((row) => row.result !== '' && Number.isFinite(Number(row.result)));
  const points = good.map((row) => ({ x: row.value, result: Number(row.result), bar: Number(row.error_bar) || 0 }));
  const numeric = points.length > 0 && points.every((point) => point.x !== '' && Number.isFinite(Number(point.x)));
  if (numeric) for (const point of points) point.x = Number(point.x);
  const { name: keyWords } = keyName(rows[0].key), quantity = quantityName(rows[0].quantity), unit = rows[0].unit;
  const drawn = table([unit && unit !== '1' ? `${keyWords} (${shownUnit(unit).unit})` : keyWords, quantity, '±', 'state'],
    rows.map((row) => [row.value, row.result === '' ? '' : Number(Number(row.result).toPrecision(6)), row.error_bar === '' ? '' : digits(Number(row.error_bar)), row.status]), { numbers: [0, 1, 2] });
  return section(`Sweep: ${name}`, points.length > 1 ? sweepFigure(points, numeric, `${keyWords}${unit && unit !== '1' ? ` (${shownUnit(unit).unit})` : ''}`, quantity, `sweep-${number}`) : null, drawn);
}

function origin({ study, files }) {
  return section('How it was made',
    list([['program', study.program], ['program\'s hash', study.program_hash], ['plan', study.manifest_hash], ['results', study.digest]]),
    paragraph('Values with a bar have a numerical one: it says nothing of strengths, geometry or water. Probabilities are of the laws that the input states.'),
    ...files.input.flatMap(({ name, text }) => [element('h3', {}, `Input: ${name.replace(/^.*\//, '')}`), element('pre', { class: 'input' }, text)]));
}

export function studySections({ study: stated, files, block }) {
  const { head, rows } = readCsv(files.study);
  const study = { ...stated, manifest_hash: stated.manifest, manifest: files.manifest.trim().split('\n').map((line) => JSON.parse(line)),
    rows: rows.map((row) => Object.fromEntries(head.map((name, k) => [name, row[k] ?? '']))) };
  const title = files.input.map(({ text }) => text.match(/^title = "(.*)"$/m)?.[1]).find(Boolean) ?? 'Study';
  const samples = files.samples.map(({ json, csv }) => ({ summary: JSON.parse(json), csv }));
  const analyses = files.reliability.map(({ json, csv }) => ({ summary: JSON.parse(json), csv }));
  const grids = files.grids.map(({ json, csv }) => ({ axes: JSON.parse(json), csv }));
  const named = new Set([...samples.map(({ summary }) => summary.name), ...grids.map(({ axes }) => axes.name)]);
  const sweeps = [...new Set(study.rows.map((row) => row.sweep))].filter((name) => name !== 'default' && !named.has(name));
  const failed = study.rows.filter((row) => row.status !== 'ok'), [first] = study.rows.filter((row) => row.sweep === 'default');
  return [
    header(title, block, failed.length ? { class: 'incomplete', text: `${failed.length} of ${study.rows.length} rows ${failed.length === 1 ? 'has' : 'have'} no result.` } : { class: '', text: `${plural(study.rows.length, 'row')}, all with a result.` }),
    section('What was asked', paragraph(`${capital(quantityName(study.rows[0].quantity))} of one input with settings changed: ${[...samples.map(({ summary }) => `a sample of ${plural(summary.rows, 'row')} (${summary.name})`), ...analyses.map(({ summary }) => `a reliability analysis (${summary.name})`), ...grids.map(({ axes }) => `a grid of ${axes.keys.map((key) => key.values.length).join(' × ')} (${axes.name})`), ...sweeps.map((name) => `a sweep (${name})`)].join(', ')}.`),
      first ? paragraph(`As the input states it: ${valueWithBar({ value: Number(first.result), unit: first.result_unit, error_bar: Number(first.error_bar) })}.`) : null),
    ...samples.map((sample, k) => sampleSection(study, sample, k + 1)),
    ...analyses.map((analysis, k) => reliabilitySection(analysis, k + 1)),
    ...grids.map((grid, k) => gridSection(grid, k + 1)),
    ...sweeps.map((name, k) => sweepSection(study, name, k + 1)),
    failed.length ? section('Rows without a result', bullets(failed.slice(0, 20).map((row) => `${row.sweep} ${row.value}: ${row.status}`))) : null,
    origin({ study, files }),
  ];
}
