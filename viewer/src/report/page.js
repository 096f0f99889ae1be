// The report on a run, a study, a kinematic analysis or joints: its sections in the order in which a reader asks. The page contains the texts of their
// files (app/report/report_data.hpp); the blocks, if the run kept them, are the viewer's.
import style from './style.css';
import { digits, groupColour } from '../colours.js';
import { inflate, readRun } from '../data.js';
import { convergence, history, knee, svgOf } from './figures.js';
import { jointForces, lastState, lastTrial } from './forces.js';
import { jointSections } from './joints.js';
import { kinematicSections } from './kinematics.js';
import { liningFigures } from './linings.js';
import { poleWith } from './net.js';
import { bullets, header, paragraph, section } from './parts.js';
import { jointNets } from './stereonets.js';
import { studySections } from './study.js';
import { element, list, readCsv, table } from './table.js';
import { aboutBar, capital, columnName, directionOf, kilo, partsOfBar, plural, quantityName, shownUnit, valueWithBar, withUnits } from './words.js';

const MOST_HISTORIES = 8, MOST_COLUMNS = 6, MOST_ROWS = 20;
const ENDED = { done: 'complete', incomplete: 'incomplete', failed: 'failed' };

// whether the scene states a table or key of this name
const states = (scene, name) => new RegExp(`(^\\[\\[?|\\.|[{,\\s])${name}\\b`, 'm').test(scene);

const head = ({ results, block }) => header(results.title || 'Run', block,
  { class: results.status, text: `${capital(ENDED[results.status] ?? results.status)}${results.message ? `: ${results.message}` : '.'}` });

function asked({ results, scene }) {
  const words = { settle: 'to equilibrium', run: 'motion in time', reduce: 'search of the strength at which it fails' };
  return section('What was asked',
    paragraph(`${results.dimension === 3 ? 'Blocks in space' : 'Blocks in the plane, per metre of thickness'}, cut by the joints of the input, in ${plural(results.stages.length, 'stage')}:`),
    table(['stage', 'kind', 'ended', 'steps', 'simulated (s)'], results.stages.map((stage) =>
      [stage.name, words[stage.kind] ?? stage.kind, stage.ended, stage.steps, digits(stage.time_s)]), { numbers: [3, 4] }),
    states(scene, 'seed') ? paragraph('Joints or properties were drawn at random from the seed that the input states.') : null);
}

function answers({ results }) {
  const values = Object.entries(results.values ?? {});
  if (!values.length) return section('Answer', paragraph('The input asks for no value: the state at the end is the answer.'));
  const searched = values.filter(([, value]) => value.error_bar > 0), others = values.filter(([, value]) => !(value.error_bar > 0));
  return section('Answer', ...searched.flatMap(([name, value]) => {
    const parts = partsOfBar(value), budget = (value.budget ?? []).map((row) =>
      [row.varied, row.change, withUnits(row.shift, value.unit), withUnits(row.left, value.unit), withUnits(row.part, value.unit)]);
    return [
      element('p', { class: 'answer' }, element('span', {}, `${capital(quantityName(name))} `), element('strong', {}, valueWithBar(value))),
      parts ? paragraph(`Parts of the bar: ${parts}.`) : null,
      paragraph(aboutBar(value)),
      value.divides ? paragraph(`The factor ${value.divides}.`) : null,
      value.not_varied?.length ? paragraph(`Not varied for the bar: ${[value.not_varied].flat().join('; ')}.`) : null,
      budget.length ? table(['varied', 'change', 'shift', 'error left', 'part of the bar'], budget, { numbers: [2, 3, 4], caption: 'Error budget' }) : null,
    ];
  }), ...(others.length ? [table(['quantity', 'value', 'unit'], others.map(([name, { value, unit }]) => {
    const shown = shownUnit(unit);
    const short = shown.unit === 'm' && Math.abs(value) < 0.1 ? { unit: 'mm', size: 1e-3 } : shown;
    return [quantityName(name), digits(value / short.size), short.unit];
  }), { numbers: [1] }), paragraph('These values have no error bar: their numerical error is not known.')] : []));
}

function theoryText({ block_theory: theory, unit }, dimension) {
  if (!theory) return '';
  let text = `Block theory, another method, judges the same blocks: ${theory.verdict}`;
  if (Number.isFinite(theory.critical)) text += `, ${withUnits(theory.critical, unit)}`;
  if (Number.isFinite(theory.brittle)) text += ` (plastic cohesion; ${digits(theory.brittle)} at the first slip if brittle)`;
  if (Number.isFinite(theory.friction_only)) text += `; ${digits(theory.friction_only)} by friction only`;
  if (theory.force) text += `. A force of ${kilo(theory.force.force_N)} kN (${dimension === 3 ? 'plunge/trend ' : ''}${directionOf(theory.force, dimension)}) would give ${digits(theory.force.required)}`;
  if (theory.lower) text += `. Less, ${withUnits(theory.lower.critical, unit)}, has block ${theory.lower.block} alone, if the blocks around it do not give way`;
  if (theory.differs) text += `. It differs by more than the error bar${theory.reasons?.length ? `: ${theory.reasons.join('; ')}` : ''}`;
  return `${text}.`;
}

function clusterTable(mechanism, dimension) {
  const per = dimension === 3 ? '' : '/m';
  return table(['blocks', `volume (m³${per})`, `weight (kN${per})`, 'motion', dimension === 3 ? 'direction (plunge/trend, °)' : 'direction', 'moved (m)', 'turned (°)', 'joints that slip', 'joints that open'],
    mechanism.clusters.slice(0, MOST_ROWS).map((c) => [c.blocks.join(', '), digits(c.volume_m3 ?? c.volume_m2 ?? NaN), kilo(c.weight_N), c.motion,
      directionOf(c, dimension), digits(c.displacement_m), digits(c.turn_deg),
      c.joints.filter((j) => j.slips).map((j) => j.joint || 'no joint').join(', '), c.joints.filter((j) => j.opens).map((j) => j.joint || 'no joint').join(', ')]),
    { numbers: [1, 2, 5, 6], caption: mechanism.clusters.length > MOST_ROWS ? `The ${MOST_ROWS} heaviest of ${mechanism.clusters.length} groups of blocks that move as one` : 'Blocks that move as one' });
}

function fails({ results }) {
  const of = [...(results.at_last_stable_state ?? []).map((at) => ({ ...at, mechanism: at.last_failed_trial?.mechanism })),
    ...results.stages.map((stage) => ({ stage: stage.name, mechanism: stage.mechanism }))];
  const searched = (results.at_last_stable_state ?? []).some((at) => at.last_failed_trial);
  return section(searched || results.status !== 'done' ? 'What fails' : 'What moved', ...of.filter((at) => at.mechanism?.sentence).flatMap((at) => [
    paragraph(`${capital(at.mechanism.sentence)}.`, { class: 'sentence' }),
    paragraph(theoryText(at, results.dimension)),
    at.followed ? paragraph(at.followed.rests ? `Beyond its failure it comes to rest after ${digits(at.followed.displacement_m)} m (without inertia).`
      : `Followed beyond its failure it has moved by ${digits(at.followed.displacement_m)} m and not come to rest.`) : null,
    clusterTable(at.mechanism, results.dimension),
  ]));
}

function picture(fragment) {
  if (!fragment) return section('Blocks', paragraph('The run kept no picture of its blocks: run it with --view, and they can be turned here.'));
  return section('Blocks', fragment, element('p', { class: 'note' }, 'Drag turns the blocks, with shift it moves them; the time bar has the other states.'));
}

function forces({ blocks, results }) {
  const frame = blocks ? lastState(blocks) : -1, per = results.dimension === 3 ? '' : '/m';
  if (frame < 0) return null;
  const rows = jointForces(blocks, frame);
  return section('What the joints carry', paragraph(lastTrial(blocks) >= 0 ? 'In the last stable state of the search.' : 'At the end of the run.'),
    rows.length ? table(['joint', 'contacts', `normal force (kN${per})`, `shear force (kN${per})`, 'largest share of friction mobilised'],
      rows.slice(0, MOST_ROWS).map((row) => [row.name, row.contacts, kilo(row.normal), kilo(row.shear), digits(row.friction)]), { numbers: [1, 2, 3, 4],
        caption: rows.length > MOST_ROWS ? `The ${MOST_ROWS} that carry most, of ${rows.length}` : '' }) : paragraph('No joint is closed.'));
}

function orientations({ blocks }) {
  if (!blocks || blocks.head.dimension === 2 || !blocks.head.joints.length) return null;
  const sets = blocks.groups.map((group, k) => ({ name: group.name, colour: groupColour(blocks, k), poles: group.joints.map((j) => poleWith(blocks.head.joints[j].normal)) }))
    .filter((set) => set.poles.length);
  return section('Orientations', jointNets(sets));
}

function search({ results, files }) {
  if (!files.search) return null;
  const { head: names, rows } = readCsv(files.search), at = (row, name) => row[names.indexOf(name)];
  return section('The search', ...(results.at_last_stable_state ?? []).filter((state) => state.level !== undefined).flatMap((state) => {
    const number = results.stages.findIndex((stage) => stage.name === state.stage) + 1;
    const trials = rows.filter((row) => Number(at(row, 'stage')) === number).map((row) => ({ trial: Number(at(row, 'trial')),
      level: Number(at(row, 'level')), outcome: at(row, 'outcome'), moved: Number(at(row, 'displacement_m')), blocks: at(row, 'moving_blocks'), motion: at(row, 'motion') }));
    const value = Object.values(results.values ?? {}).find((v) => v.bracket !== undefined), unit = state.unit === 'deg' ? ' (°)' : '';
    const levelName = state.unit === 'deg' ? 'friction angle (°)' : 'factor';
    return [convergence(trials, value?.value, levelName), knee(trials, value?.value, levelName),
      table(['trial', `level${unit}`, 'outcome', 'largest displacement (m)', 'blocks that move', 'motion'],
        trials.map((t) => [t.trial, digits(t.level), t.outcome, digits(t.moved < 1e-12 ? 0 : t.moved), t.blocks, t.motion]), { numbers: [0, 1, 3, 4] }),
      value?.rule ? paragraph(`Rule: ${value.rule}.`, { class: 'note' }) : null];
  }));
}

function supports({ results, files, linings: strengths }) {
  const rows = [], linings = [];
  for (const stage of results.stages) {
    for (const b of stage.bolts ?? [])
      rows.push([stage.name, b.bolts, b.count, kilo(b.force_N), kilo(b.shear_N ?? 0), b.use === undefined ? '' : `${digits(100 * b.use)} %`, b.yielded ?? 0, b.broken ?? 0, b.slipped ?? 0]);
    for (const l of stage.linings ?? [])
      linings.push([stage.name, l.lining, kilo(l.thrust_N_per_m), kilo(l.moment_Nm_per_m), kilo(l.pressure_Pa), l.use === undefined ? '' : `${digits(100 * l.use)} %`]);
  }
  return section('Supports',
    rows.length ? table(['after stage', 'bolts', 'number', 'largest force (kN)', 'largest shear (kN)', 'of yield', 'yielded', 'broken', 'slipped'], rows, { numbers: [2, 3, 4, 5, 6, 7, 8] }) : null,
    linings.length ? table(['after stage', 'lining', 'thrust (kN/m)', 'moment (kN m/m)', 'pressure (kPa)', 'of strength'], linings, { numbers: [2, 3, 4, 5] }) : null,
    ...liningFigures({ results, files, linings: strengths }));
}

function histories({ files, every }) {
  if (!files.history) return null;
  const { head: names, rows } = readCsv(files.history);
  const time = rows.map((row) => Number(row[names.indexOf('time_s')])), byUnit = new Map();
  names.forEach((column, k) => {
    if (['time_s', 'stage', 'trial'].includes(column)) return;
    const values = rows.map((row) => (row[k] === '' ? NaN : Number(row[k])));
    const known = values.filter(Number.isFinite);
    if (!known.some((x) => x !== known[0])) return;
    const { name, unit: written } = columnName(column), { unit, size } = shownUnit(written), group = byUnit.get(unit) ?? [];
    group.push({ name, values: values.map((x) => x / size) });
    byUnit.set(unit, group);
  });
  const figures = [];
  for (const [unit, columns] of byUnit)
    for (let k = 0; k < columns.length; k += MOST_COLUMNS)
      figures.push(history(time, columns.slice(k, k + MOST_COLUMNS), unit, `history-${figures.length + 1}`));
  const more = figures.length - MOST_HISTORIES;
  return section('Histories', every > 1 ? paragraph(`Every ${every}th row is drawn.`, { class: 'note' }) : null, ...figures.slice(0, MOST_HISTORIES), more > 0 ? paragraph(`${plural(more, 'more figure')} could be drawn of history.csv.`, { class: 'note' }) : null);
}

function assumptions({ results, scene }) {
  const has = (name) => states(scene, name), value = Object.values(results.values ?? {})[0];
  return section('Assumptions', bullets([
    'Blocks are rigid: all deformation is in the joints.',
    'Joints have the strength and stiffness of the input (Coulomb friction, with the tension and cohesion that it states). '
      + (has('cohesion') ? `Cohesion is ${/cohesion_law = "(softening|brittle)"/.exec(scene)?.[1] ?? 'perfectly plastic'}: ${/cohesion_law = "(softening|brittle)"/.test(scene) ? 'slip takes it' : 'slip keeps it, which is unsafe if the joint is brittle'}.` : 'No cohesion is stated.'),
    has('in_situ') || has('stress') ? 'Stress of the rock around is counted as the input states it.' : 'No stress of the rock around is counted: blocks in roofs and walls are judged as if it were unstressed.',
    has('water') ? 'Water acts as the input states it.' : 'There is no water.',
    value?.divides ? `The factor of safety ${value.divides}.` : null,
    has('bolts') ? 'Bolts act as springs with the yield of the input; the factor of safety does not divide their strength.' : 'There are no bolts.',
    has('move') || has('forces') ? 'Motions or forces are prescribed as the input states; a horizontal force on a block points where the block is pushed, against the ground\'s acceleration.' : 'There is no earthquake load.',
    'Error bars are numerical: they say nothing of strengths, geometry, stress or water.',
  ].filter(Boolean)));
}

function origin({ results, scene }) {
  const { program } = results, commit = program.commit ? ` (${program.commit})` : '';
  return section('How it was made',
    list([['program', `Voussoir ${program.version}${commit}, ${program.compiler}`], ['input', results.input_hash], ['state at the end', results.state_hash],
      ['work', `${plural(results.counters.steps, 'step')}, ${plural(results.counters.contact_evaluations, 'contact evaluation')}, ${digits(results.timing.seconds)} s on ${plural(results.timing.threads, 'thread')}`],
      ['energy error', results.energy ? `${digits(results.energy.relative_energy_error)} of the energy turned over` : '']]),
    paragraph('To repeat it, save the input below as scene.toml:'),
    element('pre', {}, `voussoir run scene.toml --out repeated\nvoussoir report repeated`),
    paragraph('The same input gives the same state, bit by bit, with any number of threads.'),
    element('h3', {}, 'Input'), element('pre', { class: 'input' }, scene));
}

const sections = [head, asked, answers, fails, (page) => picture(page.fragment), forces, search, orientations, supports, histories,
  ({ results }) => (results.warnings?.length ? section('Warnings', bullets(results.warnings)) : null), assumptions, origin];

// returns the title
function show(main, parts) {
  main.replaceChildren(...parts.filter(Boolean));
  return main.querySelector('h1').textContent;
}

// A print shows the blocks as they are seen, as a picture: what WebGL draws is lost when the page takes a print's width.
async function keepPrinted(viewer, fragment) {
  const picture = element('img', { class: 'printed', alt: 'blocks' });
  const draw = async () => { picture.src = (await viewer.drawn()).toDataURL('image/png'); };
  let timer = 0;
  fragment.after(picture);
  for (const change of ['pointerup', 'wheel', 'input', 'change', 'click', 'keyup'])
    fragment.addEventListener(change, () => {
      clearTimeout(timer);
      timer = setTimeout(draw, 300);
    });
  await draw();
}

// They open as the interactive page does, without its panel.
function blocksOfPage() {
  const fragment = document.querySelector('#blocks')?.content.firstElementChild.cloneNode(true);
  if (fragment) fragment.dataset.look = btoa('panel=0');
  return fragment;
}

async function showRun(main, data) {
  const fragment = blocksOfPage();
  const blocks = fragment ? readRun(await inflate(fragment.querySelector('script').textContent)) : null;
  const page = { ...data, blocks, fragment, scene: data.files.scene };
  document.title = show(main, sections.map((make) => make(page)));
  if (fragment) await keepPrinted(await window.voussoir.start(fragment), fragment);
}

async function showJoints(main, data) {
  const fragment = blocksOfPage();
  document.title = show(main, jointSections({ ...data, fragment }));
  if (fragment) await keepPrinted(await window.voussoir.start(fragment), fragment);
}

async function begin() {
  const sheet = element('style');
  sheet.textContent = style;
  document.head.append(sheet);
  const main = document.querySelector('main');
  try {
    const data = JSON.parse(new TextDecoder().decode(await inflate(document.getElementById('voussoir-report').textContent)));
    if (data.study) document.title = show(main, studySections(data));
    else if (data.kinematics) document.title = show(main, kinematicSections(data));
    else if (data.joints) await showJoints(main, data);
    else await showRun(main, data);
    const figure = new URLSearchParams(location.hash.slice(1)).get('figure');
    if (figure) main.dataset.picture = `data:image/svg+xml;base64,${btoa(Array.from(new TextEncoder().encode(svgOf(figure)), (byte) => String.fromCharCode(byte)).join(''))}`;
    main.dataset.state = 'ready';
  } catch (error) {
    main.dataset.state = 'failed';
    main.append(paragraph(`The report cannot be shown: ${error.message}`));
    throw error;
  }
}

if (document.readyState === 'loading') document.addEventListener('DOMContentLoaded', begin);
else begin();
