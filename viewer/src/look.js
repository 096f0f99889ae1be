// What a page shows first, and what its address states: view.html#frame=3&magnified=100&colour=displacement.
import { START, TRIAL } from './data.js';
import { lastTrial } from './report/forces.js';
import { BOLTS, LININGS } from './supports.js';

// the failed trial of a search that is next to its result; of another run its end
export function firstFrame(run) {
  const trial = lastTrial(run);
  return trial >= 0 ? trial : run.frames.length - 1;
}

export const initialLook = (run, supports) => ({
  frame: firstFrame(run), since: -1, magnified: 1, exploded: 0, colour: run.verdicts ? 'factor' : run.head.joints.length ? 'set' : 'displacement',
  forces: 'none', forceSize: 1, bolts: supports.uses ? 'use' : 'force', lining: 'none', section: 'none', cutAt: 0.5, cutOther: false, hidden: new Set(),
  chosen: -1, showFixed: true, edges: true, shape: -1, face: -1,
});

// the ends of stages since which displacements can count: [frame, name]
export function stageEnds({ head, frames }) {
  return head.stages.map((name, stage) => [frames.findLastIndex(({ kind, stage: of }) => kind !== TRIAL && kind !== START && of === stage), name])
    .filter(([frame]) => frame >= 0 && frame < frames.length - 1);
}

// Names and values that this page does not have are told.
export function readAddress(viewer, address) {
  const { look, run, element, camera, plane } = viewer, unread = new Set(address.keys()), unknown = [];
  const has = (key) => unread.delete(key) || address.has(key);
  const tell = (key, value = address.get(key)) => unknown.push(`${key}=${value}`);
  const number = (key, low, high) => {
    if (!has(key)) return;
    const value = Number(address.get(key));
    if (Number.isFinite(value) && address.get(key) !== '') look[key] = Math.min(high, Math.max(low, value));
    else tell(key);
  };
  number('frame', 0, run.frames.length - 1);
  look.frame = Math.round(look.frame);
  number('magnified', 1, 1000);
  number('exploded', 0, 2);
  number('forceSize', 0.1, 10);
  number('cutAt', 0, 1);
  for (const [key, allowed] of [['colour', Object.keys(viewer.choices)], ['forces', ['none', 'arrows', 'network']], ['bolts', Object.keys(BOLTS)],
    ['lining', Object.keys(LININGS)]])
    if (has(key)) allowed.includes(address.get(key)) ? (look[key] = address.get(key)) : tell(key);
  const ends = [[-1, 'start'], ...stageEnds(run)];
  if (has('since')) {
    const end = ends.find(([, name]) => name === address.get('since'));
    end ? ([look.since] = end) : tell('since');
  }
  const section = address.get('section'), joint = run.head.joints.findIndex((j) => j.name === section);
  if (['x', 'y', 'z', 'none'].includes(section)) look.section = section;
  else if (joint >= 0) look.section = `joint ${joint}`;
  else if (has('section')) tell('section');
  unread.delete('section');
  const named = (name) => run.groups.findIndex((group) => group.name === name);
  if (has('chosen') && (look.chosen = named(address.get('chosen'))) < 0) tell('chosen');
  unread.delete('hidden');
  for (const name of address.getAll('hidden')) named(name) >= 0 ? look.hidden.add(named(name)) : tell('hidden', name);
  for (const key of ['showFixed', 'edges', 'cutOther']) if (has(key)) ['0', '1'].includes(address.get(key)) ? (look[key] = address.get(key) === '1') : tell(key);
  if (has('block')) {
    viewer.pickByName(address.get('block'));
    if (look.shape < 0) tell('block');
  }
  const poster = address.get('poster')?.match(/^(\d{2,4})x(\d{2,4})(\.webp)?$/);
  if (poster) {
    Object.assign(element.style, { width: `${poster[1]}px`, height: `${poster[2]}px` });
    viewer.poster = poster[3] ? 'image/webp' : 'image/png';
  }
  if (poster || address.get('panel') === '0') element.classList.add('bare');
  for (const key of ['poster', 'panel', 'azimuth', 'height']) unread.delete(key);
  for (const key of unread) tell(key);
  if (unknown.length) viewer.panel.tell(`The address names what this page does not have: ${unknown.join(', ')}.`);
  const view = ['azimuth', 'height'].map((key) => Number(address.get(key)));
  if (!plane && address.has('azimuth') && view.every(Number.isFinite)) camera.look(...view);
  viewer.size();
}
