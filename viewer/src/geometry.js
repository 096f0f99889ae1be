// Faces and edges of all shapes as two buffers, in the bodies' frames; they never change.
import { BufferAttribute, BufferGeometry } from 'three';

// Newell's normal of a polygon, not unit; its length is twice the area
export function polygonNormal(points, corners) {
  const n = [0, 0, 0];
  corners.forEach((c, i) => {
    const d = corners[(i + 1) % corners.length];
    for (let k = 0; k < 3; ++k) {
      const u = (k + 1) % 3, v = (k + 2) % 3;
      n[k] += points[3 * c + u] * points[3 * d + v] - points[3 * c + v] * points[3 * d + u];
    }
  });
  return n;
}

// Every face gets a number; in the plane the first faces of a part are its edges and the last is what is filled.
export function listFaces(run) {
  const faces = [];
  const plane = run.head.dimension === 2;
  run.shapes.forEach((shape, s) => shape.parts.forEach((part, p) => {
    part.firstFace = faces.length;
    part.faces.forEach((face, k) => {
      const group = face.joint >= 0 ? run.head.joints[face.joint].group : run.noJoint;
      const properties = face.joint >= 0 ? run.head.joints[face.joint].properties : -1;
      faces.push({ shape: s, part: p, face: k, joint: face.joint, group, properties, corners: face.corners, inner: face.inner });
    });
    if (plane)
      faces.push({ shape: s, part: p, face: -1, joint: -1, group: run.noJoint, properties: -1, corners: part.outline });
  }));
  return faces;
}

export const isFilled = (face) => face.corners.length >= 3;

export function faceGeometry(run, faces) {
  let triangles = 0;
  for (const face of faces) if (isFilled(face)) triangles += face.corners.length - 2;
  const position = new Float32Array(9 * triangles);
  const [shape, number, group, properties] = [0, 0, 0, 0].map(() => new Float32Array(3 * triangles));
  let v = 0;
  faces.forEach((face, f) => {
    if (!isFilled(face)) return;
    const { points } = run.shapes[face.shape].parts[face.part];
    for (let i = 1; i + 1 < face.corners.length; ++i)
      for (const corner of [face.corners[0], face.corners[i], face.corners[i + 1]]) {
        for (let k = 0; k < 3; ++k) position[3 * v + k] = points[3 * corner + k];
        shape[v] = face.shape;
        number[v] = f;
        group[v] = face.group;
        properties[v++] = face.properties + 1;
      }
  });
  return buffers({ position: [position, 3], shape: [shape, 1], number: [number, 1], group: [group, 1],
    properties: [properties, 1] });
}

// ---- what lies inside of a body of several parts: construction joints are no joints to be seen

const midpoint = (points, corners) => [0, 1, 2].map((k) => corners.reduce((s, c) => s + points[3 * c + k], 0) / corners.length);
const offsetOf = (n, p) => n[0] * p[0] + n[1] * p[1] + n[2] * p[2];

// unit normals and offsets of a part's faces
function planesOf(part, plane) {
  return part.faces.filter((face) => face.corners.length >= (plane ? 2 : 3)).map((face) => {
    const { points } = part, [a, b] = face.corners;
    const n = plane ? [points[3 * b + 1] - points[3 * a + 1], points[3 * a] - points[3 * b], 0] : polygonNormal(points, face.corners);
    const size = Math.hypot(...n) || 1, unit = n.map((c) => c / size), p = midpoint(points, face.corners);
    const inside = midpoint(points, [...Array(points.length / 3).keys()]);
    const sign = offsetOf(unit, inside) > offsetOf(unit, p) ? -1 : 1;
    return { normal: unit.map((c) => sign * c), offset: sign * offsetOf(unit, p), corners: new Set(face.corners) };
  });
}

const holds = (planes, p, slack) => planes.every(({ normal, offset }) => offsetOf(normal, p) <= offset + slack);

// Marks the faces that lie on another part of their body, and finds the edges of each part that are no edges of the
// body: those that end such a face where the surface goes on without a bend.
export function findInner(run) {
  const plane = run.head.dimension === 2;
  for (const shape of run.shapes) {
    if (shape.parts.length < 2) continue;
    const planes = shape.parts.map((part) => planesOf(part, plane)), slack = 1e-5 * shape.volume ** (1 / run.head.dimension);
    shape.parts.forEach((part, p) => {
      const others = planes.filter((_, q) => q !== p);
      for (const face of part.faces)
        face.inner = face.joint >= 0 && run.head.joints[face.joint].holds &&
          others.some((other) => holds(other, midpoint(part.points, face.corners), slack));
      part.isInner = (edge) => isInner(edge, part, planes[p], others, slack, plane);
    });
  }
}

function isInner(edge, part, planes, others, slack, plane) {
  const ends = (face) => face.inner && face.corners.includes(edge[0]) && face.corners.includes(edge[1]);
  if (!part.faces.some(ends)) return false;
  if (plane) return true;
  const middle = midpoint(part.points, edge), mine = planes.filter(({ corners }) => corners.has(edge[0]) && corners.has(edge[1]));
  const same = (a, b) => offsetOf(a.normal, b.normal) > 1 - 1e-6;
  return others.some((other) => holds(other, middle, slack) && mine.some((a) =>
    other.some((b) => same(a, b) && Math.abs(offsetOf(b.normal, middle) - b.offset) < slack)));
}

// each edge of a part once
export function edgesOf(part) {
  const seen = new Set(), edges = [];
  const loops = part.outline ? [part.outline] : part.faces.map((face) => face.corners);
  for (const loop of loops)
    loop.forEach((a, i) => {
      const b = loop[(i + 1) % loop.length], key = Math.min(a, b) * 65536 + Math.max(a, b);
      if (loop.length > 1 && !seen.has(key)) {
        seen.add(key);
        edges.push([a, b]);
      }
    });
  return edges;
}

export function edgeGeometry(run) {
  const position = [], shape = [];
  run.shapes.forEach((s, number) => {
    for (const part of s.parts) {
      if (part.smooth && !part.outline) continue;
      for (const edge of edgesOf(part)) {
        if (part.isInner?.(edge)) continue;
        for (const corner of edge) {
          for (let k = 0; k < 3; ++k) position.push(part.points[3 * corner + k]);
          shape.push(number);
        }
      }
    }
  });
  return buffers({ position: [new Float32Array(position), 3], shape: [new Float32Array(shape), 1] });
}

function buffers(lists) {
  const geometry = new BufferGeometry();
  for (const [name, [list, size]] of Object.entries(lists)) geometry.setAttribute(name, new BufferAttribute(list, size));
  return geometry;
}

// the box of shapes where they began
export function boxOf(shapes) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const shape of shapes)
    for (const part of shape.parts)
      for (let i = 0; i < part.points.length; ++i) {
        const value = shape.reference[i % 3] + part.points[i];
        low[i % 3] = Math.min(low[i % 3], value);
        high[i % 3] = Math.max(high[i % 3], value);
      }
  const centre = low.map((l, k) => 0.5 * (l + high[k]));
  return { low, high, centre, radius: shapes.length ? 0.5 * Math.hypot(...low.map((l, k) => high[k] - l)) : 0 };
}
