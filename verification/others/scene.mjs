// What the adapters of engines in Node share: the scenes that the harness writes (scene.hpp describes them), the rows and the loop.
import { createInterface } from "node:readline";
import { writeSync } from "node:fs";

const minus = (a, b) => a.map((x, k) => x - b[k]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

// a vector of a block's axes in the world's, and back; the quaternion w x y z has length 1
const turned = ([w, ...axis], v) => {
  const t = cross(axis, v).map((x) => 2 * x), u = cross(axis, t);
  return v.map((x, k) => x + w * t[k] + u[k]);
};
const turnedBack = ([w, ...axis], v) => turned([w, ...minus([0, 0, 0], axis)], v);

// A bonded face as elastic rods of 1 m: at each of its four points one along the normal, one along each axis of the face.
export function rodsOf(weld) {
  const side = unit(minus(weld.points[1], weld.points[0])), other = cross(weld.normal, side);
  const local = (block, point) => turnedBack(block.turn, minus(point, block.centre));
  return weld.points.flatMap((point) => [[weld.normal, weld.normalStiffness], [side, weld.shearStiffness], [other, weld.shearStiffness]]
    .map(([direction, stiffness]) => ({ stiffness, damping: Math.sqrt(stiffness * weld.block.mass), onFixed: local(weld.fixed, minus(point, direction)),
      onBlock: local(weld.block, point) })));
}

// whether the greatest tensile stress of the face is above its strength, at a pose of its block (scene.hpp explains)
export function breaks(weld, motion) {
  const tension = weld.points.map((point) => {
    const own = turnedBack(weld.block.turn, minus(point, weld.block.centre)), arm = turned(motion.turn, own);
    return weld.normalStiffness * dot(weld.normal, minus(motion.centre.map((x, k) => x + arm[k]), point));
  });
  const sides = (a, b) => ((a ^ b) & 1 ? -1 : 1) + ((a ^ b) & 2 ? -1 : 1);
  return [0, 1, 2, 3].some((corner) =>
    tension.reduce((sum, force, k) => sum + force * (1 + Math.sqrt(3) * sides(corner, k)), 0) > weld.strength * weld.area);
}

function readWeld(words, numbers, blocks) {
  const [block, fixed] = words.slice(0, 2).map((name) => blocks.find((b) => b.name === name));
  const [normalStiffness, shearStiffness, area, strength, ...v] = numbers.slice(2);
  return { block, fixed, normalStiffness, shearStiffness, area, strength, normal: v.slice(0, 3),
    points: [3, 6, 9, 12].map((k) => v.slice(k, k + 3)) };
}

function readBlockLine(word, rest, block) {
  const numbers = rest.map(Number);
  if (word === "vertex") block.vertices.push(numbers);
  else if (word === "face") block.faces.push({ plane: numbers.slice(0, 4), corners: numbers.slice(4) });
  else if (["velocity", "spin", "box"].includes(word)) block[word] = numbers;
  else if (word !== "density") throw new Error(`unknown word ${word}`);
}

export function readScene(lines) {
  const scene = { gravity: [], shares: [], blocks: [], welds: [], forces: {}, settings: {}, used: new Set() };
  for (const line of lines) {
    const [word, ...rest] = line.trim().split(/\s+/);
    const numbers = rest.map(Number);
    if (word === "setting") scene.settings[rest[0]] = numbers[1];
    else if (word === "gravity") scene.gravity.push(numbers);
    else if (word === "weld") scene.welds.push(readWeld(rest, numbers, scene.blocks));
    else if (word === "share") scene.shares.push(numbers);
    else if (word === "force") scene.forces[rest[0]] = numbers.slice(1);
    else if (["duration", "output", "friction"].includes(word)) scene[word] = numbers[0];
    else if (word === "block") {
      const [mass, ...pose] = numbers.slice(2);
      scene.blocks.push({ name: rest[0], fixed: rest[1] === "fixed", mass, centre: pose.slice(0, 3), turn: pose.slice(3, 7),
        moments: pose.slice(7, 10), velocity: [0, 0, 0], spin: [0, 0, 0], box: null, vertices: [], faces: [] });
    } else if (word) readBlockLine(word, rest, scene.blocks.at(-1));
  }
  scene.setting = (key, otherwise) => { scene.used.add(key); return scene.settings[key] ?? otherwise; };
  return scene;
}

// of a table whose first column is time: linear between rows, the last one held
function valuesAt(table, time) {
  let row = 0;
  while (row + 1 < table.length && table[row + 1][0] <= time) ++row;
  const [begin, ...g] = table[row], next = table[row + 1];
  if (!next) return g;
  return g.map((x, k) => x + (next[k + 1] - x) * (time - begin) / (next[0] - begin));
}

// makeWorld(scene) returns { step(gravity, share of the full forces), motion(i): {centre, turn, velocity, spin}, free() }
function runScene(scene, makeWorld) {
  const world = makeWorld(scene), dt = scene.setting("dt", 0.002), rows = [];
  for (const key of Object.keys(scene.settings)) if (!scene.used.has(key)) throw new Error(`this adapter has no setting ${key}`);
  const steps = Math.round(scene.duration / dt), every = Math.max(1, Math.round(scene.output / dt));
  const show = (time) => scene.blocks.forEach((block, i) => {
    if (block.fixed) return;
    const m = world.motion(i);
    rows.push([time, block.name, ...m.centre, ...m.turn, ...m.velocity, ...m.spin].join(" "));
  });
  let spent = 0;
  show(0);
  for (let i = 1; i <= steps; ++i) {
    const gravity = valuesAt(scene.gravity, i * dt), begun = process.cpuUsage();
    const share = scene.shares.length ? valuesAt(scene.shares, i * dt)[0] : 0;
    world.step(gravity, share);
    const { user, system } = process.cpuUsage(begun);
    spent += user + system;
    if (i % every === 0 || i === steps) show(i * dt);
  }
  world.free();
  rows.push(`cpu ${spent * 1e-6} steps ${steps}`);
  return rows;
}

function writeAll(text) {
  for (let bytes = Buffer.from(text); bytes.length > 0;) {
    try {
      bytes = bytes.subarray(writeSync(1, bytes));
    } catch (error) {
      if (error.code !== "EAGAIN") throw error;  // the pipe is full: the harness is reading
    }
  }
}

// the main function of an adapter
export async function runScenes(makeWorld) {
  let lines = [];
  for await (const line of createInterface({ input: process.stdin })) {
    if (line !== "end") { lines.push(line); continue; }
    let rows;
    try {
      rows = runScene(readScene(lines), makeWorld);
    } catch (error) {
      rows = [`failed ${String(error.message ?? error).split("\n")[0]}`];
    }
    lines = [];
    writeAll(rows.join("\n") + "\n");
  }
}
