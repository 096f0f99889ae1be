// Straight pieces that are some pixels wide: forces, supports (supports.js), and edges in the plane.
import { BufferAttribute, InstancedBufferAttribute, InstancedBufferGeometry, Mesh } from 'three';
import { edgePieces } from './geometry.js';
import { groupColour, latestShapes, listColour, PRESSED, PULLED, rampColour, rgb, share, HELD, EDGE } from './colours.js';

// along (0 begin, 1 end of the shaft or begin of the head, 2 tip), across, of the head
const CORNERS = new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0, 1, -1, 1, 2, 0, 1, 1, 1, 1]);

const DOT = -1; // in place of a head

export class Pieces {
  constructor(material) {
    this.mesh = new Mesh(new InstancedBufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.clear();
  }
  clear() { this.list = { begin: [], end: [], tint: [], width: [], head: [], share: [] }; }
  add(begin, end, tint, width, head = 0, share = 0) {
    const { list } = this;
    list.begin.push(...begin);
    list.end.push(...end);
    list.tint.push(...tint);
    list.width.push(width);
    list.head.push(head);
    list.share.push(share);
  }
  // `width` is its diameter
  addDot(at, tint, width) { this.add(at, at, tint, width, DOT); }
  show() {
    this.mesh.geometry.dispose();
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(CORNERS, 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3, 4, 5, 6]);
    for (const [name, values] of Object.entries(this.list))
      geometry.setAttribute(name, new InstancedBufferAttribute(new Float32Array(values), values.length / this.list.width.length));
    geometry.instanceCount = this.list.width.length;
    this.mesh.geometry = geometry;
    this.mesh.visible = geometry.instanceCount > 0;
  }
}

const length = (v) => Math.hypot(v[0], v[1], v[2]);
const forceOf = ({ force }, i) => [force[0][i], force[1][i], force[2][i]];

// the largest force of a contact at any time, N
export function largestForce(run) {
  let most = 0;
  for (const { contacts } of run.frames)
    for (let i = 0; i < contacts.count; ++i) most = Math.max(most, length(forceOf(contacts, i)));
  return most;
}

// and between two bodies
export function largestBetween(run) {
  let most = 0;
  for (const frame of run.frames) for (const { force } of bodyPairs(run, frame).values()) most = Math.max(most, length(force));
  return most;
}

// pairs of bodies in contact, with the resultant of their contact forces
export function bodyPairs(run, { contacts }) {
  const found = new Map();
  for (let i = 0; i < contacts.count; ++i) {
    const p = contacts.pair[i], a = run.pairs.bodyA[p], b = run.pairs.bodyB[p], key = `${a},${b}`;
    if (!found.has(key)) found.set(key, { a, b, force: [0, 0, 0], normal: 0 });
    const pair = found.get(key);
    forceOf(contacts, i).forEach((f, k) => (pair.force[k] += f));
    pair.normal += contacts.normal[i];
  }
  return found;
}

const centroid = (run, frame, shape, k) => shape.reference[k] + run.frames[frame].displacement[k][shape.body];

// Contact forces on each free body: an arrow that ends at the contact, with a length by the force. If a body is picked,
// only the forces on it.
export function addArrows(pieces, { run, bodies, look, frame, reach, picked }) {
  const { contacts } = run.frames[frame], latest = latestShapes(run, frame), most = largestForce(run);
  const point = [0, 0, 0], at = [0, 0, 0];
  for (let i = 0; i < contacts.count; ++i) {
    const p = contacts.pair[i], sides = [latest.get(run.pairs.bodyA[p]), latest.get(run.pairs.bodyB[p])];
    const f = forceOf(contacts, i), size = length(f);
    if (!sides[0] || !sides[1] || size < 1e-4 * most) continue;
    sides.forEach((shape, side) => {
      if (picked ? shape !== picked : bodies.isFixed(shape, frame)) return;
      // relative to its own centroid, so that the arrow moves with the body when displacements are magnified
      const apart = (k) => centroid(run, frame, sides[0], k) - centroid(run, frame, shape, k);
      for (let k = 0; k < 3; ++k) point[k] = contacts.point[k][i] + apart(k);
      bodies.placeOfArm(shape, frame, point, look, at);
      const sign = side ? 1 : -1, scale = (sign * reach) / most;
      // compression: it comes from outside; tension: it points outwards
      const tail = at.map((x, k) => x - scale * f[k]), tint = rgb(contacts.normal[i] >= 0 ? PRESSED : PULLED);
      if (contacts.normal[i] >= 0) pieces.add(tail, at, tint, 2.5, 1);
      else pieces.add(at, at.map((x, k) => x + scale * f[k]), tint, 2.5, 1);
    });
  }
}

// lines with a width by the force between the bodies
export function addNetwork(pieces, { run, bodies, look, frame }) {
  const latest = latestShapes(run, frame), most = largestBetween(run), ends = [[0, 0, 0], [0, 0, 0]];
  const pairs = [...bodyPairs(run, run.frames[frame]).values()].sort((x, y) => length(x.force) - length(y.force));
  for (const { a, b, force, normal } of pairs) {
    const shapes = [latest.get(a), latest.get(b)], size = length(force);
    if (!shapes[0] || !shapes[1] || size < 1e-4 * most) continue;
    shapes.forEach((shape, k) => bodies.place(shape, frame, 0, 0, 0, look, ends[k]));
    pieces.add(ends[0], ends[1], rgb(normal >= 0 ? PRESSED : PULLED), 1, 0, size / most);
  }
}

// In the plane the joints are edges: in the colour of their set, their properties, or their mobilised friction.
export function addJointEdges(pieces, { run, faces, bodies, look, frame, colours, hidden, chosenGroup, showFixed }) {
  const ends = [[0, 0, 0], [0, 0, 0]];
  faces.forEach((face, f) => {
    if (face.face < 0 || face.corners.length !== 2 || hidden.has(face.group)) return;
    const shape = run.shapes[face.shape];
    if (!bodies.isShown(shape, frame) || (!showFixed && bodies.isFixed(shape, frame))) return;
    const tint = edgeTint(run, face, f, colours), chosen = face.group === chosenGroup;
    if (!tint && !chosen) return;
    const pale = chosenGroup >= 0 && !chosen;
    for (const points of edgePieces(shape.parts[face.part], face.of)) {
      points.forEach((x, k) => bodies.place(shape, frame, ...x, look, ends[k]));
      pieces.add(ends[0], ends[1], pale ? rgb(HELD) : tint ?? rgb(EDGE), chosen ? 5 : 3);
    }
  });
}

function edgeTint(run, face, number, { choice, values, legend }) {
  if (choice === 'set') return face.group === run.noJoint ? null : rgb(groupColour(run, face.group));
  if (choice === 'properties') return face.properties < 0 ? null : rgb(listColour(face.properties));
  if (choice === 'friction') return values[number] < 0 ? null : rampColour(share(values[number], legend));
  return null;
}
