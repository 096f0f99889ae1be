// Maps of a study's grids: a cell for each pair of values with the result as its colour, and the line along which the
// result equals a limit, interpolated between the cells.
import { digits } from '../colours.js';
import { gridMap } from './figures.js';
import { levelLine } from './level_line.js';
import { section } from './parts.js';
import { readCsv, table } from './table.js';
import { keyName, quantityName, shownUnit } from './words.js';

const MOST_ROWS = 200;

const withUnit = (name, unit) => (unit ? `${name} (${unit})` : name);

function axis({ key, unit, values }) {
  const { name, unit: shown, size } = keyName(unit ? `${key} (${unit})` : key), numeric = values.every((value) => value !== '' && Number.isFinite(Number(value)));
  return { label: withUnit(name, shown), values: numeric ? values.map((value) => digits(Number(value) / size)) : values };
}

export function gridSection({ axes, csv }, number) {
  const { head, rows } = readCsv(csv), column = axes.keys.length, verdicts = head.indexOf('fails');
  const [x, y, first] = axes.keys.map(axis).reverse(), nx = x.values.length, cells = nx * y.values.length;
  const { unit, size } = shownUnit(axes.unit), quantity = withUnit(quantityName(axes.quantity), unit);
  const limit = axes.fails_below ?? axes.fails_above ?? (axes.quantity.endsWith('factor_of_safety') ? 1 : undefined);
  const results = rows.map((row) => (row[column] === '' ? NaN : Number(row[column]) / size)), known = results.filter(Number.isFinite);
  const maps = Array.from({ length: rows.length / cells }, (_, map) => {
    const values = results.slice(map * cells, (map + 1) * cells);
    const places = values.map((value, k) => ({ x: k % nx, y: Math.floor(k / nx), value, fails: verdicts < 0 ? '' : rows[map * cells + k][verdicts] }));
    return gridMap({ places, x, y, quantity, range: [Math.min(...known), Math.max(...known)], limit: limit === undefined ? undefined : limit / size,
      line: limit === undefined ? [] : levelLine(values, nx, limit / size), title: first ? `${first.label} ${first.values[map]}. ` : '' }, `grid-${number}-${map + 1}`);
  });
  const columns = axes.keys.map(axis), shownRows = rows.slice(0, MOST_ROWS).map((row, k) => [...columns.map(({ values }, i) => {
    const repeated = columns.slice(i + 1).reduce((product, other) => product * other.values.length, 1);
    return values[Math.floor(k / repeated) % values.length];
  }), Number.isFinite(results[k]) ? Number(results[k].toPrecision(6)) : '', row[column + 1] === '' ? '' : digits(Number(row[column + 1]) / size), row[head.indexOf('status')], ...(verdicts < 0 ? [] : [row[verdicts]])]);
  return section(`Grid: ${axes.name}`, ...(known.length ? maps : []),
    table([...columns.map(({ label }) => label), quantity, '±', 'state', ...(verdicts < 0 ? [] : ['fails'])], shownRows,
      { numbers: [column, column + 1], caption: rows.length > MOST_ROWS ? `The first ${MOST_ROWS} of ${rows.length} rows of grid_${number}.csv` : '' }));
}
