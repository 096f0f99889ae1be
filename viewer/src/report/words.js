// Numbers, units and names as an engineer reads them: kN, kPa, m³, degrees. Files have N and Pa.
import { digits } from '../colours.js';

const UNITS = { deg: '°', 1: '' };
const unitOf = (unit) => UNITS[unit] ?? ` ${unit}`;
const QUANTITIES = { factor_of_safety: 'factor of safety', critical_friction: 'critical friction angle' };

// "safety_factor_of_safety" of a scene with several searches: "safety: factor of safety"
export function quantityName(name) {
  for (const [key, words] of Object.entries(QUANTITIES)) {
    if (name === key) return words;
    if (name.endsWith(`_${key}`)) return `${name.slice(0, -key.length - 1)}: ${words}`;
  }
  return name.replaceAll('_', ' ');
}

// two digits of the bar, and as many decimals of the value
export function valueWithBar({ value, unit, error_bar: bar }) {
  if (!Number.isFinite(bar) || bar <= 0) return `${Number(value.toPrecision(6))}${unitOf(unit)}`;
  const decimals = Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(bar))));
  return `${value.toFixed(decimals)} ± ${bar.toFixed(decimals)}${unitOf(unit)}`;
}

// "bracket 0.003, criterion 0.05, stiffness 0.11": those of at least a twentieth of the bar
export function partsOfBar(value) {
  const middle = Math.abs(value.value - value.bracket_middle) <= 1e-9 * Math.abs(value.value);
  const parts = [['bracket', middle ? value.bracket : 0], ['criterion', value.criterion], ...(value.budget ?? []).map((row) => [row.varied, row.part])];
  return parts.filter(([, size]) => size > 0.05 * value.error_bar).map(([name, size]) => `${name} ${Number(size.toPrecision(2))}`).join(', ');
}

const LEFT_OUT = { bracket: ' Only the search\'s bracket is in it; errors of the model are not (an error budget adds them).',
  criterion: ' Errors of the model are not in it (an error budget adds them).' };
export function aboutBar(value) {
  if (!(value.error_bar > 0)) return 'No error bar: the numerical error is not known.';
  return `The bar is the numerical error only: it says nothing of strengths, geometry or water.${LEFT_OUT[value.covers] ?? ''}`;
}

export const withUnits = (number, unit) => `${digits(number)}${unitOf(unit)}`;
export const kilo = (newton) => (Number.isFinite(newton) ? digits(newton / 1000) : '–');
export const plural = (count, word) => `${count} ${word}${count === 1 ? '' : 's'}`;
export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

// forces, moments, pressures and energies in thousands, as engineers write them
const THOUSANDS = { N: 'kN', 'N/m': 'kN/m', Nm: 'kN m', 'N m': 'kN m', 'N m/m': 'kN m/m', Pa: 'kPa', J: 'kJ', 'J/m': 'kJ/m' };
export const shownUnit = (unit) => (THOUSANDS[unit] ? { unit: THOUSANDS[unit], size: 1000 } : { unit: UNITS[unit] ?? unit, size: 1 });

// plunge and trend; in the plane down or up, to a side
export function directionOf({ plunge_deg: plunge, trend_deg: trend }, dimension) {
  if (dimension === 3) return `${plunge.toFixed(1)}/${trend.toFixed(1).padStart(5, '0')}`;
  if (Math.abs(plunge) > 89.95) return plunge > 0 ? 'straight down' : 'straight up';
  return `${Math.abs(plunge).toFixed(1)}° ${plunge < 0 ? 'up' : 'down'} to the ${trend < 180 ? 'right' : 'left'}`;
}

const LAST = [['_deg', '°'], ['_m_per_s', 'm/s'], ['_per_s', '1/s'], ['_Nm_per_m', 'N m/m'], ['_N_per_m', 'N/m'], ['_Nm', 'N m'], ['_kN', 'kN'],
  ['_N', 'N'], ['_Pa', 'Pa'], ['_J', 'J'], ['_m3', 'm³'], ['_m2', 'm²'], ['_m', 'm'], ['_s', 's'], ['_rad', 'rad']];
// "friction_clay_deg" of a history: what it is, and its unit
export function columnName(column) {
  const [end, unit] = LAST.find(([text]) => column.endsWith(text)) ?? ['', ''];
  return { name: column.slice(0, column.length - end.length).replaceAll('_', ' '), unit };
}

// "joint_properties.joint.friction_deg (deg)": "joint: friction (°)"
export function keyName(head) {
  const [, key, unit = ''] = head.match(/^(.*?)(?: \(([^)]*)\))?$/), parts = key.split('.');
  const last = parts.pop().replace(/_(deg|Pa|m|N|s)$/, '').replaceAll('_', ' '), shown = shownUnit(unit);
  return { name: `${parts.length > 1 ? `${parts.at(-1)}: ` : ''}${last}`, ...shown };
}
