// Positions of bodies for pictures and sections, from displacement and rotation of a frame. A point x of a body's frame
// is at
//
//   reference + x + magnified (displacement + (R - 1) x) + exploded (reference - centre),
//
// so a magnified picture multiplies the displacement of every point, and points in contact stay together.
import { DataTexture, FloatType, NearestFilter, RGBAFormat } from 'three';
import { FIXED, PRESENT } from './data.js';

const TEXELS = 5, ROW = 256; // of a shape; shapes in a row of the texture

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
    this.setFrame(0);
  }

  isShown(shape, f) { return f >= shape.from && f < shape.to && this.run.frames[f].flags[shape.body] & PRESENT; }
  isFixed(shape, f) { return (this.run.frames[f].flags[shape.body] & FIXED) !== 0; }

  turn(f, body) {
    const { turn } = this.run.frames[f];
    return turnLessOne(turn[0][body], turn[1][body], turn[2][body], this.matrix);
  }

  setFrame(f, bodyValue = () => 0) {
    const frame = this.run.frames[f], { displacement: d } = frame, out = this.values;
    this.run.shapes.forEach((shape, s) => {
      const b = shape.body, at = 4 * TEXELS * s;
      if (!this.isShown(shape, f)) return void (out[at + 15] = 0);
      const m = this.turn(f, b);
      for (let k = 0; k < 3; ++k) {
        for (let c = 0; c < 3; ++c) out[at + 4 * k + c] = m[3 * k + c];
        out[at + 4 * k + 3] = d[k][b];
        out[at + 12 + k] = shape.reference[k];
      }
      out[at + 15] = 1;
      out[at + 16] = bodyValue(shape);
      out[at + 17] = this.isFixed(shape, f) ? 1 : 0;
    });
    this.texture.needsUpdate = true;
  }

  // the displacement of a point of a body's frame
  away(f, body, x, y, z, out) {
    const { displacement: d } = this.run.frames[f], m = this.turn(f, body);
    for (let k = 0; k < 3; ++k) out[k] = d[k][body] + (m[3 * k] * x + m[3 * k + 1] * y + m[3 * k + 2] * z);
    return out;
  }

  place(shape, f, x, y, z, look, out) {
    this.away(f, shape.body, x, y, z, out);
    const point = [x, y, z];
    for (let k = 0; k < 3; ++k)
      out[k] = shape.reference[k] + point[k] + look.magnified * out[k] +
        look.exploded * (shape.reference[k] - this.centre[k]);
    return out;
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
  vec3 away(vec3 x) {
    vec4 a = texel(0), b = texel(1), c = texel(2);
    return vec3(dot(a.xyz, x) + a.w, dot(b.xyz, x) + b.w, dot(c.xyz, x) + c.w);
  }
  vec3 place(vec3 x, vec3 moved, vec3 reference) {
    return reference + x + magnified * moved + exploded * (reference - centre);
  }
`;
