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

// Every face gets a number; in the plane the first faces of a part are its edges and the last is the filled outline.
export function listFaces(run) {
  const faces = [];
  const plane = run.head.dimension === 2;
  run.shapes.forEach((shape, s) => shape.parts.forEach((part, p) => {
    part.firstFace = faces.length;
    part.faces.forEach((face, k) => {
      const group = face.joint >= 0 ? run.head.joints[face.joint].group : run.noJoint;
      const properties = face.joint >= 0 ? run.head.joints[face.joint].properties : -1;
      faces.push({ shape: s, part: p, face: k, joint: face.joint, group, properties, corners: face.corners, of: face });
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

// ---- the interior of a body of several parts: construction joints are not shown as joints

const midpoint = (points, corners) => [0, 1, 2].map((k) => corners.reduce((s, c) => s + points[3 * c + k], 0) / corners.length);
const dot = (n, p) => n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
const contains = (planes, p, slack) => planes.every(({ normal, offset }) => dot(normal, p) <= offset + slack);

// unit normals and offsets of a part's faces, outwards
function planesOf(part) {
  return part.faces.filter(isFilled).map((face) => {
    const n = polygonNormal(part.points, face.corners), size = Math.hypot(...n) || 1, normal = n.map((c) => c / size);
    return { normal, offset: dot(normal, midpoint(part.points, face.corners)), corners: new Set(face.corners) };
  });
}

// In the plane the pieces of each edge that are edges of the body, from 0 to 1; in space whether an edge of a part is
// none of the body, because it ends a face on another part and the surface continues without a bend.
export function findInner(run) {
  const plane = run.head.dimension === 2, joints = run.head.joints;
  for (const shape of run.shapes) {
    const slack = 1e-5 * shape.volume ** (1 / run.head.dimension);
    const held = (face) => shape.parts.length > 1 && face.joint >= 0 && joints[face.joint].holds;
    if (plane)
      for (const part of shape.parts)
        for (const face of part.faces) face.pieces = held(face) ? outerPieces(part, face, shape.parts, slack) : [[0, 1]];
    else if (shape.parts.length > 1) findInnerEdges(shape, held, slack);
  }
}

// the rest of an edge after edges of other parts on the same joint are removed
function outerPieces(part, face, parts, slack) {
  const at = (of, c) => [of.points[3 * c], of.points[3 * c + 1]], [a, b] = face.corners.map((c) => at(part, c));
  const d = [b[0] - a[0], b[1] - a[1]], size = Math.hypot(...d);
  let pieces = [[0, 1]];
  for (const other of parts)
    for (const opposite of other === part ? [] : other.faces) {
      if (opposite.joint !== face.joint) continue;
      const ends = opposite.corners.map((c) => at(other, c).map((x, k) => x - a[k]));
      if (ends.some((e) => Math.abs(e[0] * d[1] - e[1] * d[0]) > slack * size)) continue;
      const [low, high] = ends.map((e) => (e[0] * d[0] + e[1] * d[1]) / (size * size)).sort((x, y) => x - y);
      pieces = pieces.flatMap(([u, v]) => [[u, Math.min(v, low)], [Math.max(u, high), v]]).filter(([u, v]) => (v - u) * size > slack);
    }
  return pieces;
}

function findInnerEdges(shape, held, slack) {
  const planes = shape.parts.map(planesOf);
  shape.parts.forEach((part, p) => {
    const others = planes.filter((_, q) => q !== p), goesOn = (a, b, at) => dot(a.normal, b.normal) > 1 - 1e-6 && Math.abs(dot(b.normal, at) - b.offset) < slack;
    part.isInner = ([a, b]) => {
      if (!part.faces.some((face) => held(face) && face.corners.includes(a) && face.corners.includes(b))) return false;
      const middle = midpoint(part.points, [a, b]), mine = planes[p].filter(({ corners }) => corners.has(a) && corners.has(b));
      return others.some((other) => contains(other, middle, slack) && mine.some((m) => other.some((o) => goesOn(m, o, middle))));
    };
  });
}

// the ends of the pieces of an edge in the plane, in the body's frame
export function edgePieces(part, face) {
  const [a, b] = face.corners;
  return face.pieces.map((ends) => ends.map((t) => [0, 1, 2].map((k) => part.points[3 * a + k] + t * (part.points[3 * b + k] - part.points[3 * a + k]))));
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

// In space the joint sets whose traces the edges of a part are: of edges of one face of a joint and one that is free, or
// made by an excavation.
function traces(run, part) {
  const groups = new Map(), key = (a, b) => `${Math.min(a, b)},${Math.max(a, b)}`;
  for (const { joint, corners } of part.faces) {
    const own = run.head.joints[joint], group = own && !own.holds ? own.group : run.noJoint;
    corners.forEach((a, i) => {
      const k = key(a, corners[(i + 1) % corners.length]);
      groups.set(k, [...(groups.get(k) ?? []), group]);
    });
  }
  return ([a, b]) => {
    const of = groups.get(key(a, b)), made = of.filter((group) => group !== run.noJoint);
    return of.length === 2 && made.length === 1 ? made[0] : -1;
  };
}

export function edgeGeometry(run) {
  const position = [], shape = [], trace = [];
  const add = (point, number, of = -1) => {
    position.push(...point);
    shape.push(number);
    trace.push(of);
  };
  run.shapes.forEach((s, number) => {
    for (const part of s.parts) {
      if (part.outline && part.faces.length)
        for (const face of part.faces) for (const ends of edgePieces(part, face)) ends.forEach((point) => add(point, number));
      else if (part.outline || !part.smooth) {
        const traceOf = part.outline ? () => -1 : traces(run, part);
        for (const edge of edgesOf(part))
          if (!part.isInner?.(edge)) for (const c of edge) add(part.points.subarray(3 * c, 3 * c + 3), number, traceOf(edge));
      }
    }
  });
  return buffers({ position: [new Float32Array(position), 3], shape: [new Float32Array(shape), 1], trace: [new Float32Array(trace), 1] });
}

function buffers(lists) {
  const geometry = new BufferGeometry();
  for (const [name, [list, size]] of Object.entries(lists)) geometry.setAttribute(name, new BufferAttribute(list, size));
  return geometry;
}

// the box of shapes in their initial positions
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
