// The shaders. One for faces, which also draws their numbers to be picked; one for edges; one for straight pieces that
// are some pixels wide (forces, bolts, edges in the plane); one for the faces of a section.
import { Color, DataTexture, DoubleSide, FloatType, NearestFilter, RedFormat, RGBAFormat, ShaderMaterial, UnsignedByteType, Vector2, Vector3, Vector4 } from 'three';
import { bodyShader } from './bodies.js';
import { EDGE, HELD, LISTED_COLOURS, ramp, rgb, ROCK } from './colours.js';

const LIST = 1024; // a row of a texture that is a list
const MOST_LISTED = LISTED_COLOURS.length; // the longest list of a choice

export function listTexture(count, { bytes = false } = {}) {
  const rows = Math.max(1, Math.ceil(count / LIST));
  const values = bytes ? new Uint8Array(4 * LIST * rows) : new Float32Array(LIST * rows);
  const texture = bytes
    ? new DataTexture(values, LIST, rows, RGBAFormat, UnsignedByteType)
    : new DataTexture(values, LIST, rows, RedFormat, FloatType);
  texture.minFilter = texture.magFilter = NearestFilter;
  return { values, texture };
}

// values that all materials of one viewer share: they are set once
export function sharedUniforms(bodies, groups, properties, faceValues) {
  const u = (value) => ({ value });
  return {
    bodies: u(bodies.texture), magnified: u(1), exploded: u(0), centre: u(new Vector3()),
    cut: u(new Vector4(0, 0, 0, 1)), showFixed: u(true),
    groups: u(groups.texture), propertyColours: u(properties.texture), faceValues: u(faceValues.texture),
    mode: u(0), low: u(0), high: u(1), logarithmic: u(false), ramp: u(ramp.map((c) => new Vector3(...c))),
    listed: u(listedColours([])),
    chosenGroup: u(-1), picked: u(-1), opacity: u(1), light: u(new Vector3(0, 0, 1)),
    viewport: u(new Vector2(1, 1)), widest: u(0),
  };
}

export const listedColours = (list) => Array.from({ length: MOST_LISTED }, (_, i) => new Vector3(...rgb(list[i] ?? ROCK)));

const clip = `
  uniform vec4 cut;
  varying vec3 at;
  void clip() { if (dot(cut.xyz, at) > cut.w) discard; }
`;

const placed = `
  vec4 own = texel(3);
  vec3 moved = away(position);
  at = place(position, moved, own.xyz);
  vec4 more = texel(4);
  gl_Position = own.w > 0.0 && (showFixed || more.y == 0.0) ? projectionMatrix * viewMatrix * vec4(at, 1.0) : vec4(0.0, 0.0, -2.0, 1.0);
`;

const faceVertex = `
  ${bodyShader}
  uniform bool showFixed;
  uniform int mode;
  uniform highp sampler2D faceValues;
  attribute float number, group, properties;
  varying vec3 at;
  flat varying vec4 which; // number, group, properties, shape
  flat varying float held;
  varying float value;
  void main() {
    ${placed}
    which = vec4(number, group, properties, shape);
    held = more.y;
    int n = int(number);
    value = mode == 1 ? length(moved) : mode == 2 || mode == 5 ? more.x
      : mode == 3 ? texelFetch(faceValues, ivec2(n % ${LIST}, n / ${LIST}), 0).r : 0.0;
  }
`;

const entry = `vec4 entry(sampler2D list, float n) { int i = int(n); return texelFetch(list, ivec2(i % ${LIST}, i / ${LIST}), 0); }`;

const shade = `
  uniform vec3 light;
  vec3 shaded(vec3 colour) {
    vec3 n = normalize(cross(dFdx(at), dFdy(at)));
    return colour * (0.78 + 0.22 * dot(n, light));
  }
`;

const faceFragment = `
  precision highp float;
  ${clip}
  ${entry}
  ${shade}
  uniform sampler2D groups, propertyColours;
  uniform int mode;
  uniform float low, high, chosenGroup, picked, opacity;
  uniform bool logarithmic;
  uniform vec3 ramp[${ramp.length}], listed[${MOST_LISTED}];
  flat varying vec4 which;
  flat varying float held;
  varying float value;
  float shareOf(float v) {
    return logarithmic ? (log(max(v, 1e-30)) - log(low)) / (log(high) - log(low)) : (v - low) / max(high - low, 1e-30);
  }
  vec3 rampOf(float v) {
    float t = clamp(shareOf(v), 0.0, 1.0) * ${(ramp.length - 1).toFixed(1)};
    int i = min(int(t), ${ramp.length - 2});
    return mix(ramp[i], ramp[i + 1], t - float(i));
  }
  void main() {
    clip();
    vec4 group = entry(groups, which.y);
    if (group.a < 0.5) discard;
    #ifdef PICK
      float n = which.x + 1.0;
      gl_FragColor = vec4(mod(n, 256.0), mod(floor(n / 256.0), 256.0), floor(n / 65536.0), 255.0) / 255.0;
    #else
      vec3 rock = held > 0.5 ? vec3(${held()}) : vec3(${rock()});
      bool bare = group.a < 0.75;
      vec3 colour = mode == 0 ? (bare ? rock : group.rgb)
        : mode == 4 ? (which.z < 0.5 ? rock : entry(propertyColours, which.z).rgb)
        : mode == 5 ? listed[int(value + 0.5)]
        : mode == 3 && value < 0.0 ? rock : rampOf(value);
      if (mode == 0 && held > 0.5 && !bare) colour = mix(colour, vec3(${held()}), 0.35);
      if (chosenGroup >= 0.0 && which.y != chosenGroup) colour = mix(colour, vec3(0.96), 0.82);
      float alpha = opacity;
      if (chosenGroup >= 0.0 && which.y == chosenGroup) alpha = max(alpha, 0.85);
      if (which.w == picked) { colour = mix(colour, vec3(0.94, 0.89, 0.26), 0.55); alpha = max(alpha, 0.6); }
      gl_FragColor = vec4(shaded(colour), alpha);
    #endif
  }
`;

function held() { return vector(HELD); }
function rock() { return vector(ROCK); }
function vector(hex) { return [1, 3, 5].map((i) => (parseInt(hex.slice(i, i + 2), 16) / 255).toFixed(4)).join(', '); }

const material = (uniforms, vertexShader, fragmentShader, more = {}) =>
  new ShaderMaterial({ uniforms, vertexShader, fragmentShader, side: DoubleSide, toneMapped: false, ...more });

export function faceMaterial(uniforms) {
  return material(uniforms, faceVertex, faceFragment,
    { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, transparent: true });
}

export function pickMaterial(uniforms) {
  return material(uniforms, faceVertex, faceFragment, { defines: { PICK: 1 } });
}

export function edgeMaterial(uniforms) {
  return material({ ...uniforms, colour: { value: new Color(EDGE) }, edgeOpacity: { value: 1 } }, `
    ${bodyShader}
    uniform bool showFixed;
    uniform int mode;
    uniform vec3 colour;
    uniform highp sampler2D groups;
    attribute float trace;
    varying vec3 at;
    flat varying vec3 tint;
    ${entry}
    // nearer to the eye than the faces that it bounds; traces in the colour of their set
    void main() {
      ${placed}
      gl_Position.z -= 1e-4;
      tint = mode == 0 && trace >= 0.0 ? entry(groups, trace).rgb : colour;
    }
  `, `
    ${clip}
    uniform float edgeOpacity;
    flat varying vec3 tint;
    void main() { clip(); gl_FragColor = vec4(tint, edgeOpacity); }
  `, { transparent: true });
}

// The polygons of a section, already in their positions; their colours are determined elsewhere.
export function cutMaterial(uniforms) {
  return material(uniforms, `
    attribute vec3 colour;
    varying vec3 at, tint;
    void main() { at = position; tint = colour; gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0); }
  `, `
    varying vec3 at, tint;
    ${shade}
    void main() { gl_FragColor = vec4(shaded(tint), 1.0); }
  `, { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
}

// Straight pieces from `begin` to `end`, `width` pixels wide, with a head at their end if `head` is 1. With a `share`
// their width is scaled up to that of `widest`. `position` is the place in one: along, across, and whether it belongs to
// the head. If `head` is -1 it is a dot with a dark rim.
export function pieceMaterial(uniforms) {
  return material(uniforms, `
    uniform vec2 viewport;
    uniform vec4 cut;
    attribute vec3 begin, end, tint;
    uniform float widest;
    attribute float width, head, share;
    varying vec3 colour, spot; // spot: the place in a dot, and 1
    void main() {
      vec4 a = projectionMatrix * viewMatrix * vec4(begin, 1.0), b = projectionMatrix * viewMatrix * vec4(end, 1.0);
      vec2 along = (b.xy - a.xy) * viewport * 0.5;
      float size = length(along);
      along = size > 0.0 ? along / size : vec2(1.0, 0.0);
      float tip = head * min(width * 3.2, size);
      float t = position.x < 0.5 ? 0.0 : position.z > 0.5 ? (position.x > 1.5 ? size : size - tip) : size - tip * 0.95;
      float half_width = position.z > 0.5 ? width * 1.5 * head : (width + share * widest) * 0.5;
      vec2 offset = along * t + vec2(-along.y, along.x) * position.y * half_width;
      float z = mix(a.z, b.z, size > 0.0 ? t / size : 0.0);
      colour = tint;
      spot = vec3(0.0);
      if (head < 0.0) {
        spot = vec3(2.0 * position.x - 1.0, position.y, 1.0);
        offset = position.z > 0.5 ? vec2(0.0) : spot.xy * 0.5 * width;
      }
      vec3 middle = 0.5 * (begin + end);
      gl_Position = vec4(a.xy + offset * 2.0 / viewport, z - 2e-4, 1.0);
      if (dot(cut.xyz, middle) > cut.w) gl_Position = vec4(0.0, 0.0, -2.0, 1.0);
    }
  `, `
    varying vec3 colour, spot;
    void main() {
      float radius = length(spot.xy);
      if (spot.z > 0.5 && radius > 1.0) discard;
      gl_FragColor = vec4(spot.z > 0.5 && radius > 0.7 ? colour * 0.25 : colour, 1.0);
    }
  `, { transparent: true });
}
