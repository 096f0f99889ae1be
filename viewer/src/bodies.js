// Positions of bodies for pictures and sections, from displacement and rotation of a frame. A point x of a body's frame
// is at
//
//   reference + x + before + magnified (displacement + (R - 1) x - before) + exploded (reference - centre),
//
// `before` is its displacement at the time since which displacements count, 0 for the start. So a magnified picture
// multiplies the displacement of every point, and points in contact stay together.
import { DataTexture, FloatType, Matrix3, NearestFilter, RGBAFormat, Vector3 } from 'three';
import { FIXED, PRESENT } from './data.js';

const TEXELS = 8, ROW = 256; // of a shape; shapes in a row of the texture

// R - 1 by rows from a rotation vector, exact also if it is small
export function turnLessOne(x, y, z, out) {
  const angle2 = x * x + y * y + z * z, angle = Math.sqrt(angle2);
  const a = angle > 1e-4 ? Math.sin(angle) / angle : 1 - angle2 / 6;
  const half = Math.sin(angle / 2);
  const b = angle > 1e-4 ? (2 * half * half) / angle2 : 0.5 - angle2 / 24;
  out[0] = -b * (y * y + z * z); out[1] = b * x * y - a * z; out[2] = b * x * z + a * y;
  out[3] = b * x * y + a * z; out[4] = -b * (x * x + z * z); out[5] = b * y * z - a * x;
  out[6] = b * x * z - a * y; out[7] = b * y * z + a * x; out[8] = -b * (x * x + y * y);
  return out;
}

export class Bodies {
  constructor(run) {
    this.run = run;
    const height = Math.max(1, Math.ceil(run.shapes.length / ROW));
    this.values = new Float32Array(4 * TEXELS * ROW * height);
    this.texture = new DataTexture(this.values, TEXELS * ROW, height, RGBAFormat, FloatType);
    this.texture.minFilter = this.texture.magFilter = NearestFilter;
    this.matrix = new Float64Array(9);
    this.motion = new Float64Array(12);
    this.setBase(-1);
    this.setFrame(0);
  }

  isShown(shape, f) { return f >= shape.from && f < shape.to && this.run.frames[f].flags[shape.body] & PRESENT; }
  isFixed(shape, f) { return (this.run.frames[f].flags[shape.body] & FIXED) !== 0; }

  turn(f, body) {
    const { turn } = this.run.frames[f];
    return turnLessOne(turn[0][body], turn[1][body], turn[2][body], this.matrix);
  }

  // three rows (a, b): a point x of the shape has the displacement a · x + b
  motionOf(shape, f, out) {
    const { displacement: d } = this.run.frames[f], m = this.turn(f, shape.body);
    for (let k = 0; k < 3; ++k) {
      for (let c = 0; c < 3; ++c) out[4 * k + c] = m[3 * k + c];
      out[4 * k + 3] = d[k][shape.body];
    }
    return out;
  }

  // Displacements count since this frame, -1: since the start. A shape that did not exist then has the motion of its
  // body's earlier one; a body that did not exist counts from its start.
  setBase(frame) {
    const { run } = this;
    this.since = frame;
    const then = new Map(frame < 0 ? [] : run.shapes.filter((shape) => this.isShown(shape, frame)).map((shape) => [shape.body, shape]));
    this.before = run.shapes.map((shape) => {
      const out = new Float64Array(12), earlier = then.get(shape.body);
      if (!earlier) return out;
      this.motionOf(earlier, frame, out);
      const moved = shape.reference.map((r, k) => r - earlier.reference[k]);
      for (let k = 0; k < 3; ++k) for (let c = 0; c < 3; ++c) out[4 * k + 3] += out[4 * k + c] * moved[c];
      return out;
    });
  }

  setFrame(f, bodyValue = () => 0) {
    const out = this.values, { motion } = this;
    this.run.shapes.forEach((shape, s) => {
      const at = 4 * TEXELS * s, before = this.before[s];
      if (!this.isShown(shape, f)) return void (out[at + 15] = 0);
      this.motionOf(shape, f, motion);
      for (let i = 0; i < 12; ++i) out[at + i] = motion[i] - before[i];
      for (let k = 0; k < 3; ++k) out[at + 12 + k] = shape.reference[k];
      out[at + 15] = 1;
      out[at + 16] = bodyValue(shape);
      out[at + 17] = this.isFixed(shape, f) ? 1 : 0;
      out.set(before, at + 20);
    });
    this.texture.needsUpdate = true;
  }

  // the displacement of a point of a body's frame, since `since`
  away(f, shape, x, y, z, out) {
    const a = this.motionOf(shape, f, this.motion), b = this.before[shape.number];
    for (let k = 0, i = 0; k < 3; ++k, i += 4) out[k] = (a[i] - b[i]) * x + (a[i + 1] - b[i + 1]) * y + (a[i + 2] - b[i + 2]) * z + (a[i + 3] - b[i + 3]);
    return out;
  }

  place(shape, f, x, y, z, look, out) {
    this.away(f, shape, x, y, z, out);
    const point = [x, y, z], b = this.before[shape.number];
    for (let k = 0, i = 0; k < 3; ++k, i += 4)
      out[k] = shape.reference[k] + point[k] + (b[i] * x + b[i + 1] * y + b[i + 2] * z + b[i + 3]) + look.magnified * out[k] +
        look.exploded * (shape.reference[k] - this.centre[k]);
    return out;
  }

  // the point of the body's frame that is drawn at a place
  pointDrawnAt(shape, f, place, look) {
    const at = (x, y, z) => new Vector3(...this.place(shape, f, x, y, z, look, [0, 0, 0])), zero = at(0, 0, 0);
    const columns = [at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)].map((column) => column.sub(zero));
    const matrix = new Matrix3().set(...[0, 1, 2].flatMap((k) => columns.map((column) => column.getComponent(k))));
    return new Vector3(...place).sub(zero).applyMatrix3(matrix.invert()).toArray();
  }

  // initial position of the material point that, in the true motion, is now at `arm` from the body's centroid
  placeOfArm(shape, f, arm, look, out) {
    const m = this.turn(f, shape.body), x = [0, 0, 0];
    for (let k = 0; k < 3; ++k) x[k] = arm[k] + m[k] * arm[0] + m[3 + k] * arm[1] + m[6 + k] * arm[2];
    return this.place(shape, f, x[0], x[1], x[2], look, out);
  }
}

export const bodyShader = `
  uniform highp sampler2D bodies;
  uniform float magnified, exploded;
  uniform vec3 centre;
  attribute float shape;
  vec4 texel(int k) {
    int i = int(shape) * ${TEXELS} + k;
    return texelFetch(bodies, ivec2(i % ${TEXELS * ROW}, i / ${TEXELS * ROW}), 0);
  }
  vec3 motion(int first, vec3 x) {
    vec4 a = texel(first), b = texel(first + 1), c = texel(first + 2);
    return vec3(dot(a.xyz, x) + a.w, dot(b.xyz, x) + b.w, dot(c.xyz, x) + c.w);
  }
  vec3 away(vec3 x) { return motion(0, x); }
  vec3 place(vec3 x, vec3 moved, vec3 reference) {
    return reference + x + motion(5, x) + magnified * moved + exploded * (reference - centre);
  }
`;
