// The file that a run keeps for the viewer (core/output/view.cpp writes it): a head, shapes of bodies, frames.

export const HEAD = 1, SHAPE = 2, FRAME = 3, AGAIN = 4, VERDICTS = 5;
export const START = 0, TRIAL = 2;
export const PRESENT = 1, FIXED = 2;
export const LINING = 1, COLLAR = 2, BROKEN = 4; // of a piece of support
// the columns of a pair of faces in contact
export const PAIR = ['bodyA', 'partA', 'faceA', 'bodyB', 'partB', 'faceB', 'joint', 'properties'];

export async function inflate(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

class Reader {
  constructor(buffer) {
    this.view = new DataView(buffer);
    this.bytes = new Uint8Array(buffer);
    this.at = 8; // behind the magic word
  }
  get more() { return this.at < this.bytes.length; }
  int() { return this.view.getInt32((this.at += 4) - 4, true); }
  float() { return this.view.getFloat32((this.at += 4) - 4, true); }
  double() { return this.view.getFloat64((this.at += 8) - 8, true); }
  raw(n) {
    const list = this.bytes.subarray(this.at, this.at + n);
    this.at += Math.ceil(n / 4) * 4;
    return list;
  }
  text() { return new TextDecoder().decode(this.raw(this.int())); }
  floats(n) { return Float32Array.from({ length: n }, () => this.float()); }
  // the first bytes of all numbers, then the second ones …
  column(Type, n) {
    const out = new Uint8Array(4 * n);
    for (let k = 0; k < 4; ++k) for (let i = 0; i < n; ++i) out[4 * i + k] = this.bytes[this.at++];
    return new Type(out.buffer);
  }
  columns(Type, n, count) { return Array.from({ length: count }, () => this.column(Type, n)); }
}

// in the plane all vectors get a third component, 0
const inSpace = (columns, dimension, n) => (dimension === 3 ? columns : [...columns, new Float32Array(n)]);

function readPart(reader, dimension) {
  const count = reader.int(), points = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) for (let k = 0; k < dimension; ++k) points[3 * i + k] = reader.float();
  const smooth = reader.int() === 1;
  const faces = Array.from({ length: reader.int() }, () => {
    const joint = reader.int();
    return { joint, corners: Array.from({ length: reader.int() }, () => reader.int()) };
  });
  // in the plane faces are edges, and the outline is filled
  const outline = dimension === 2 ? faces.pop().corners : null;
  return { points, smooth, faces, outline };
}

function readShape(reader, dimension) {
  const body = reader.int(), name = reader.text(), reference = [0, 0, 0];
  for (let k = 0; k < dimension; ++k) reference[k] = reader.float();
  const volume = reader.float(), size = reader.float();
  const parts = Array.from({ length: reader.int() }, () => readPart(reader, dimension));
  return { body, name, reference, volume, size, parts, from: 0, to: Infinity };
}

function readContacts(reader, dimension, pairs, base) {
  const fresh = reader.int(), touching = reader.int();
  PAIR.forEach((name) => pairs[name].push(...reader.column(Int32Array, fresh)));
  const known = pairs.bodyA.length - base, bits = reader.raw(Math.ceil(known / 8));
  const pair = new Int32Array(touching);
  for (let i = 0, n = 0; i < known; ++i) if ((bits[i >> 3] >> (i & 7)) & 1) pair[n++] = base + i;
  const vector = () => inSpace(reader.columns(Float32Array, touching, dimension), dimension, touching);
  const point = vector(), force = vector();
  const [normal, friction, overlap] = reader.columns(Float32Array, touching, 3);
  return { count: touching, pair, point, force, normal, friction, overlap };
}

function readFrame(reader, dimension, pairs, base) {
  const kind = reader.int(), stage = reader.int(), trial = reader.int();
  reader.int();
  const time = reader.double(), bodies = reader.int();
  const flags = reader.raw(bodies);
  const displacement = inSpace(reader.columns(Float32Array, bodies, dimension), dimension, bodies);
  const turn = dimension === 3
    ? reader.columns(Float32Array, bodies, 3)
    : [new Float32Array(bodies), new Float32Array(bodies), reader.column(Float32Array, bodies)];
  const speed = reader.column(Float32Array, bodies);
  const contacts = readContacts(reader, dimension, pairs, base);
  const pieces = reader.int();
  const ends = [0, 1].map(() => inSpace(reader.columns(Float32Array, pieces, dimension), dimension, pieces));
  const [force, use, mark] = reader.columns(Float32Array, pieces, 3), linings = mark.filter((m) => m === LINING).length;
  // of linings alone, at both ends of each piece
  const [thrust, moment, pressure] = [0, 1, 2].map(() => reader.columns(Float32Array, linings, 2));
  return { kind, stage, trial, time, bodies, flags, displacement, turn, speed, contacts,
    support: { count: pieces, ends, force, use, mark, linings, thrust, moment, pressure } };
}

function readHead(reader) {
  const head = JSON.parse(reader.text()), n = head.joints.length;
  const [set, properties, holds] = reader.columns(Int32Array, n, 3);
  const normal = inSpace(reader.columns(Float32Array, n, head.dimension), head.dimension, n), offset = reader.column(Float32Array, n);
  head.joints = head.joints.map((name, j) => ({ name, set: set[j], properties: properties[j], holds: holds[j] === 1,
    normal: normal.map((column) => column[j]), offset: offset[j] }));
  return head;
}

// of block theory: when they hold, and by body a kind, the factor of safety (NaN: none) and a sentence
function readVerdicts(reader) {
  const moment = reader.text();
  return { moment, bodies: Array.from({ length: reader.int() }, () =>
    ({ kind: reader.int(), factor: reader.double(), sentence: reader.text() })) };
}

export function readRun(buffer) {
  const reader = new Reader(buffer);
  const run = { head: null, verdicts: null, shapes: [], frames: [], pairs: Object.fromEntries(PAIR.map((name) => [name, []])) };
  let latest = new Map(), base = 0;
  while (reader.more) {
    const begin = reader.at, tag = reader.int(), size = reader.int();
    if (tag === HEAD) run.head = readHead(reader);
    if (tag === SHAPE) {
      const shape = readShape(reader, run.head.dimension);
      shape.from = run.frames.length;
      shape.number = run.shapes.length;
      if (latest.has(shape.body)) latest.get(shape.body).to = shape.from;
      latest.set(shape.body, shape);
      run.shapes.push(shape);
    }
    if (tag === FRAME) run.frames.push(readFrame(reader, run.head.dimension, run.pairs, base));
    if (tag === VERDICTS) run.verdicts = readVerdicts(reader);
    if (tag === AGAIN) base = run.pairs.bodyA.length;
    reader.at = begin + size;
  }
  nameGroups(run);
  return run;
}

// The joints of a set are a group, and so are the faces of an excavation; any other joint is a group by itself. The last
// group contains faces that no joint made.
function nameGroups(run) {
  const { joints, sets } = run.head, outlines = new Map();
  run.groups = sets.map((name) => ({ name, joints: [] }));
  const add = (name) => run.groups.push({ name, joints: [] }) - 1;
  joints.forEach((joint, j) => {
    const outline = joint.holds && joint.name.match(/^(.+) face \d+$/)?.[1];
    if (outline && !outlines.has(outline)) outlines.set(outline, add(`outline of ${outline}`));
    joint.group = joint.set >= 0 ? joint.set : outline ? outlines.get(outline) : add(joint.name);
    run.groups[joint.group].joints.push(j);
  });
  run.groups.push({ name: 'no joint', joints: [] });
  run.noJoint = run.groups.length - 1;
}

export const nameOf = (run, body) => {
  const shape = run.shapes.findLast((s) => s.body === body);
  return shape?.name || `block ${body}`;
};
