// A reliability analysis of a study: the probability with its interval, how it converged, design points, and how much
// each key counts.
import { digits } from '../colours.js';
import { importances, probabilityConvergence } from './figures.js';
import { bullets, paragraph, section } from './parts.js';
import { element, readCsv, table } from './table.js';
import { keyName, plural } from './words.js';

const MOST_POINTS = 400;

// the estimate after each row of importance sampling; where the medians fail the rows count standing
function estimates({ head, rows }, summary) {
  const at = (name) => head.indexOf(name);
  const limit = summary.fails_below ?? summary.fails_above, weight = at('weight'), purpose = at('purpose'), quantity = at(summary.quantity);
  const failed = (value) => (summary.fails_below !== undefined ? value <= limit : value >= limit);
  const found = [];
  let sum = 0, squares = 0;
  for (const row of rows) {
    if (row[purpose] !== 'importance') continue;
    const counts = row[quantity] !== '' && failed(Number(row[quantity])) !== summary.medians_fail;
    const term = counts ? Number(row[weight]) : 0, n = found.length + 1;
    sum += term;
    squares += term * term;
    const p = sum / n, error = n > 1 ? Math.sqrt(Math.max(0, squares / n - p * p) / (n - 1)) : 0;
    const ends = p > 0 ? [p * Math.exp((-1.96 * error) / p), p * Math.exp((1.96 * error) / p)] : [NaN, NaN];
    found.push(summary.medians_fail ? { rows: n, p: 1 - p, low: 1 - ends[1], high: 1 - ends[0] } : { rows: n, p, low: ends[0], high: ends[1] });
  }
  const every = Math.ceil(found.length / MOST_POINTS);
  return found.filter(({ rows: n, p }) => (n % every === 0 || n === found.length) && n >= 20 && p > 0);
}

export function reliabilitySection({ summary, csv }, number) {
  const { sampled, first_order: first, second_order: second, design_points: points = [] } = summary, read = readCsv(csv);
  if (summary.failure) return section(`Reliability: ${summary.name}`, paragraph(`No probability: ${summary.failure}.`));
  const limit = summary.fails_below !== undefined ? `below ${digits(summary.fails_below)}` : `above ${digits(summary.fails_above)}`;
  const p = sampled?.probability ?? first?.probability, units = Object.fromEntries(read.head.map((name) => [name.replace(/ \([^)]*\)$/, ''), name]));
  const counts = Object.entries(points[0].importances).map(([key, share]) => ({ name: keyName(units[key] ?? key).name, share: 100 * share }))
    .sort((a, b) => b.share - a.share);
  const answers = Object.values(summary.answers).reduce((sum, count) => sum + count, 0);
  const keys = Object.keys(points[0].values);
  return section(`Reliability: ${summary.name}`,
    element('p', { class: 'answer' }, element('span', {}, `Probability of failure (${limit}) `), element('strong', {}, digits(p))),
    sampled ? paragraph(`With 95 % confidence between ${digits(sampled.low)} and ${digits(sampled.high)}, by ${plural(sampled.rows, 'row')} of importance sampling around ${plural(points.length, 'design point')}; ${answers} answers in all, ${summary.pilot_rows} of them pilot rows that looked for other mechanisms.`)
      : paragraph('To first order; not checked, and other mechanisms were not looked for.'),
    sampled && first ? paragraph(`To first order ${digits(first.probability)}${second ? `, to second order ${digits(second.hohenbichler)}` : ''}.`) : null,
    sampled ? probabilityConvergence(estimates(read, summary), `reliability-${number}-convergence`) : null,
    importances(counts, `reliability-${number}-importances`),
    table(['design point', ...keys.map((key) => { const { name, unit } = keyName(units[key] ?? key); return unit ? `${name} (${unit})` : name; }), 'beta', 'mechanism'],
      points.map((point, k) => [k + 1, ...keys.map((key) => digits(point.values[key] / keyName(units[key] ?? key).size)), digits(point.beta), point.mode]),
      { numbers: keys.map((_, k) => k + 1).concat(0, keys.length + 1), caption: 'The values nearest to the medians, in deviations (beta), with which it fails' }),
    summary.shared_draws ? paragraph(`${summary.shared_draws}.`) : null,
    bullets(summary.warnings));
}
