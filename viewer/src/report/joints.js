// The report on joints without a run: those that a slice draws or lists, measured in its domain, or those of an imported
// file (app/report/joints_data.hpp).
import { digits, listColour } from '../colours.js';
import { blockSizes, spacings } from './figures.js';
import { poleWith } from './net.js';
import { bullets, header, paragraph, section } from './parts.js';
import { rose, traceTable } from './rose.js';
import { jointNets } from './stereonets.js';
import { element, list, table } from './table.js';
import { plural } from './words.js';

// counts in full, other numbers to five digits
const shown = (x) => (x === null ? '' : Number.isInteger(x) ? String(x) : String(Number(x.toPrecision(5))));

function quantities(set, name) {
  const columns = ['quantity', 'unit', ...(set.drawn ? ['stated'] : []), 'measured', 'standard error'];
  return section(set.drawn ? `${name}, drawn` : name, table(columns, set.rows.map((row) =>
    [row.quantity, row.unit === '1' ? '' : row.unit === 'deg' ? '°' : row.unit, ...(set.drawn ? [shown(row.stated)] : []), shown(row.measured), row.error === null ? '' : String(Number(row.error.toPrecision(2)))]),
  { numbers: columns.map((_, k) => k).slice(2) }));
}

function spacingSection(sets) {
  const curves = sets.filter((set) => set.spacings_m?.length);
  if (!curves.length) return null;
  const rates = sets.map((set) => set.frequency_per_m).filter((rate) => rate > 0), rate = Math.min(...rates);
  return section('Spacings', spacings(curves, Number.isFinite(rate) ? rate : 0));
}

function blockSection(blocks, dimension, fragment) {
  const unit = dimension === 3 ? 'm³' : 'm²';
  return section('Blocks', fragment, fragment ? paragraph('Drag turns the blocks, with shift it moves them.', { class: 'note' }) : null,
    blockSizes(blocks, `${dimension === 3 ? 'volume' : 'area'} (${unit})`),
    table(['blocks up to this size make up', unit], [...blocks.shares.map(([share, size]) => [`${share} % of the whole`, digits(size)]),
      ['smallest block', digits(blocks.smallest)], ['largest block', digits(blocks.largest)]], { numbers: [1] }));
}

export function jointSections({ joints, block = {}, fragment }) {
  const { dimension, blocks, report } = joints;
  const sets = joints.sets.map((set, k) => ({ ...set, colour: listColour(k), poles: dimension === 3 ? set.normals.map((normal) => poleWith(normal)) : [],
    name: set.name ? (blocks && !set.drawn ? `${set.name}, stated` : set.name) : blocks ? 'without a set' : '(none)' })).filter((set) => set.normals.length || set.rows?.length);
  const measured = sets.filter((set) => set.normals.length), count = measured.reduce((sum, set) => sum + set.normals.length, 0);
  const many = `${plural(count, 'joint')} in ${plural(measured.length, 'set')}`;
  return [
    header(joints.title, block, { class: '', text: blocks ? `${plural(blocks.count, 'block')}, ${digits(blocks.total)} ${dimension === 3 ? 'm³' : 'm²'} in total; ${many}.` : `${many}.` }),
    section(report ? 'Warnings' : 'How it was measured', bullets(joints.notes)),
    report ? section('What was read', element('pre', {}, report.trim())) : null,
    count ? section('Orientations', dimension === 3 ? jointNets(measured) : [rose(measured), traceTable(measured)]) : null,
    ...sets.filter((set) => set.rows?.length).map((set) => quantities(set, set.name)),
    spacingSection(sets),
    blocks ? blockSection(blocks, dimension, fragment) : null,
    section('How it was made', list([['program', joints.program], ['input', joints.input_hash]]),
      element('pre', {}, blocks ? 'voussoir slice SCENE --report --out FOLDER' : 'voussoir import FILE --as FORMAT --out TABLE')),
  ];
}
