// A distance between two points of blocks. The points belong to their blocks and move with them, and the length is that of
// the true positions at the time that is shown: magnified displacements and exploded blocks do not count.
import { withUnit } from './colours.js';

const TRUE = { magnified: 1, exploded: 0 };

export class Measure {
  constructor(viewer) {
    this.viewer = viewer;
    this.on = false;
    this.points = [];
  }

  toggle(on = !this.on) {
    this.on = on;
    this.points = [];
  }

  // the third point begins again
  add(point) {
    if (!point) return;
    if (this.points.length === 2) this.points = [];
    this.points.push(point);
  }

  placed(look) {
    const { bodies, look: { frame } } = this.viewer;
    if (this.points.some(({ shape }) => !bodies.isShown(shape, frame))) return [];
    return this.points.map(({ shape, at }) => bodies.place(shape, frame, ...at, look, [0, 0, 0]));
  }

  // m, undefined without two points
  get length() {
    const [a, b] = this.placed(TRUE);
    return b && Math.hypot(...a.map((x, k) => x - b[k]));
  }

  get text() {
    if (!this.on) return '';
    if (this.length === undefined) return this.points.length === 1 ? 'the second point' : 'the first point: a click, or Enter for the point at the cross';
    const { look } = this.viewer;
    return `${withUnit(this.length, 'm', 4)}${look.magnified !== 1 ? ', not magnified' : ''}${look.exploded > 0 ? ', not exploded' : ''}`;
  }

  // for the overlay: ends in pixels, and the text beside them
  get drawn() {
    const { viewer } = this;
    return this.on ? { ends: this.placed(viewer.look).map((point) => viewer.project(point)), text: this.length === undefined ? '' : this.text } : null;
  }
}

// Where the line of sight through a pixel first meets a block: its shape, and the point in its frame.
export function pointUnder(viewer, x, y) {
  const { bodies, look, faces, run } = viewer, ray = viewer.camera.ray(x, y), found = [];
  const f = viewer.faceAt(x, y);
  if (f >= 0) {
    const shape = run.shapes[faces[f].shape], { points } = shape.parts[faces[f].part];
    const corners = faces[f].corners.map((c) => bodies.place(shape, look.frame, ...points.subarray(3 * c, 3 * c + 3), look, [0, 0, 0]));
    const normal = normalOf(corners), t = meet(ray, normal, dot(normal, corners[0]));
    if (Number.isFinite(t)) found.push({ t, shape });
  }
  // the filled faces of a section are none of a block
  const plane = viewer.cutPlane(), t = plane ? meet(ray, plane.normal, plane.offset) : NaN;
  if (Number.isFinite(t)) {
    const at = along(ray, t), cut = viewer.cutPolygons.find(({ corners }) => isInside(at, corners, plane.normal));
    if (cut) found.push({ t, shape: run.shapes[cut.shape] });
  }
  if (!found.length) return null;
  const nearest = found.reduce((a, b) => (b.t < a.t ? b : a));
  return { shape: nearest.shape, at: bodies.pointDrawnAt(nearest.shape, look.frame, along(ray, nearest.t), look) };
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const minus = (a, b) => a.map((x, k) => x - b[k]);
const along = ({ from, towards }, t) => from.map((x, k) => x + t * towards[k]);
const meet = ({ from, towards }, normal, offset) => (offset - dot(normal, from)) / dot(normal, towards);

// Newell's, of corners in space
function normalOf(corners) {
  return corners.reduce((sum, a, i) => {
    const b = corners[(i + 1) % corners.length], c = cross(minus(a, corners[0]), minus(b, corners[0]));
    return sum.map((x, k) => x + c[k]);
  }, [0, 0, 0]);
}

function isInside(at, corners, normal) {
  const sides = corners.map((a, i) => dot(cross(minus(corners[(i + 1) % corners.length], a), minus(at, a)), normal));
  return sides.every((side) => side >= 0) || sides.every((side) => side <= 0);
}
