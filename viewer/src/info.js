// The information on a picked block.
import { digits, withUnit } from './colours.js';
import { nameOf } from './data.js';
import { orientationText } from './stereonet.js';

const MOST = 40; // contacts that are listed

export function describe(viewer) {
  const { run, bodies, look, faces, plane } = viewer;
  const shape = run.shapes[look.shape], b = shape.body, frame = run.frames[look.frame];
  if (!bodies.isShown(shape, look.frame)) return { title: nameOf(run, b), lines: [['', 'not there at this time']] };
  const d = bodies.away(look.frame, shape, 0, 0, 0, [0, 0, 0]), since = viewer.sinceText(), turn = frame.turn.map((column) => column[b]);
  const lines = [
    [plane ? 'area' : 'volume', withUnit(shape.volume, plane ? 'm²' : 'm³')],
    ['displacement', withUnit(Math.hypot(...d), 'm')],
    ['', `(${d.slice(0, plane ? 2 : 3).map((x) => withUnit(x, 'm')).join(', ')})`],
    ...(since ? [['', since]] : []),
    [since ? 'rotation from the start' : 'rotation', `${digits((Math.hypot(...turn) * 180) / Math.PI)}°`],
    ['velocity', withUnit(frame.speed[b], 'm/s')],
  ];
  if (shape.name) lines.unshift(['block', String(b)]);
  if (bodies.isFixed(shape, look.frame)) lines.push(['', 'fixed']);
  const joint = look.face >= 0 && faces[look.face].shape === look.shape ? faces[look.face].joint : -1;
  if (look.face >= 0 && faces[look.face].face >= 0)
    lines.push(['face', joint < 0 ? 'no joint' : `${run.head.joints[joint].name}, ${orientationText(run.head.joints[joint], plane)}`]);
  return { title: shape.name || `block ${b}`, text: run.verdicts?.bodies[b].sentence, lines, table: contactTable(run, frame, b) };
}

function contactTable(run, { contacts }, body) {
  const rows = [];
  for (let i = 0; i < contacts.count; ++i) {
    const p = contacts.pair[i], a = run.pairs.bodyA[p], b = run.pairs.bodyB[p];
    if (a !== body && b !== body) continue;
    const size = Math.hypot(...contacts.force.map((column) => column[i])), normal = contacts.normal[i];
    const joint = run.head.joints[run.pairs.joint[p]];
    rows.push([Math.abs(size), [nameOf(run, a === body ? b : a), joint?.name ?? '', withUnit(normal, 'N'),
      withUnit(Math.sqrt(Math.max(0, size * size - normal * normal)), 'N'), digits(contacts.friction[i])]]);
  }
  rows.sort((x, y) => y[0] - x[0]);
  const named = rows.some(([, row]) => row[1] !== ''), cells = (row) => (named ? row : row.filter((_, k) => k !== 1));
  return { head: cells(['with', 'joint', 'normal', 'shear', 'friction']), rows: rows.slice(0, MOST).map(([, row]) => cells(row)) };
}
