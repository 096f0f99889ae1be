// A section: each convex part that the plane cuts gives a polygon, so blocks look solid and their joints show as lines.
import { BufferAttribute, BufferGeometry } from 'three';
import { edgesOf } from './geometry.js';
import { BODY, LISTED, POINT } from './choices.js';
import { HELD, rampColour, rgb, ROCK, share } from './colours.js';

// the plane's unit normal and the position of the cut along it; everything beyond is removed
export function cutParts({ run, bodies, look, frame, showFixed }, normal, offset) {
  const polygons = [], place = [0, 0, 0], away = [0, 0, 0];
  run.shapes.forEach((shape, s) => {
    if (!bodies.isShown(shape, frame) || (!showFixed && bodies.isFixed(shape, frame))) return;
    for (const part of shape.parts) {
      const n = part.points.length / 3, beyond = new Float64Array(n), at = new Float64Array(4 * n);
      for (let i = 0; i < n; ++i) {
        const [x, y, z] = part.points.subarray(3 * i, 3 * i + 3);
        bodies.place(shape, frame, x, y, z, look, place);
        bodies.away(frame, shape, x, y, z, away);
        at.set([...place, Math.hypot(...away)], 4 * i);
        beyond[i] = place[0] * normal[0] + place[1] * normal[1] + place[2] * normal[2] - offset;
      }
      const corners = crossing((part.edges ??= edgesOf(part)), beyond, at);
      if (corners.length >= 3) polygons.push({ shape: s, corners: inOrder(corners, normal) });
    }
  });
  return polygons;
}

function crossing(edges, beyond, at) {
  const corners = [];
  for (const [a, b] of edges) {
    if (beyond[a] > 0 === beyond[b] > 0) continue;
    const t = beyond[a] / (beyond[a] - beyond[b]);
    corners.push([0, 1, 2, 3].map((k) => at[4 * a + k] + t * (at[4 * b + k] - at[4 * a + k])));
  }
  return corners;
}

// around their middle, as seen along the normal
function inOrder(corners, normal) {
  const middle = [0, 1, 2].map((k) => corners.reduce((sum, c) => sum + c[k], 0) / corners.length);
  const least = [0, 1, 2].reduce((m, k) => (Math.abs(normal[k]) < Math.abs(normal[m]) ? k : m), 0);
  const axis = [0, 0, 0];
  axis[least] = 1;
  const u = cross(normal, axis), v = cross(normal, u);
  const angle = (c) => Math.atan2(dot(c, v, middle), dot(c, u, middle));
  return corners.map((c) => [angle(c), c]).sort((a, b) => a[0] - b[0]).map(([, c]) => c);
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (c, u, middle) => u[0] * (c[0] - middle[0]) + u[1] * (c[1] - middle[1]) + u[2] * (c[2] - middle[2]);

// Polygons as triangles with colours, and their outlines. Faces' values have no meaning inside of a block.
export function cutGeometry(polygons, { run, bodies, frame, choice, legend }) {
  const position = [], colour = [], lines = [];
  for (const { shape, corners } of polygons) {
    const own = run.shapes[shape], rock = rgb(bodies.isFixed(own, frame) ? HELD : ROCK);
    const tint = (c) => choice.mode === POINT ? rampColour(share(c[3], legend))
      : choice.mode === LISTED ? rgb(choice.list[choice.value(own)])
      : choice.mode === BODY ? rampColour(share(choice.value(own, frame), legend)) : rock;
    for (let i = 1; i + 1 < corners.length; ++i)
      for (const c of [corners[0], corners[i], corners[i + 1]]) {
        position.push(c[0], c[1], c[2]);
        colour.push(...tint(c));
      }
    corners.forEach((c, i) => lines.push(...c.slice(0, 3), ...corners[(i + 1) % corners.length].slice(0, 3)));
  }
  return { faces: geometryOf({ position, colour }), lines: geometryOf({ position: lines }) };
}

function geometryOf(lists) {
  const geometry = new BufferGeometry();
  for (const [name, list] of Object.entries(lists)) geometry.setAttribute(name, new BufferAttribute(new Float32Array(list), 3));
  return geometry;
}
