// What view_test.mjs tests of supports, of the blocks' own colours, of the first picture, of distances, and of displacements since
// a stage. `t` has its runs and its hold on the page.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { supportsOf } from '../src/supports.js';

const near = (found, wanted, tolerance, what) => assert.ok(Math.abs(found - wanted) <= tolerance * Math.max(1e-9, Math.abs(wanted)), `${what}: ${found}, not ${wanted}`);
const table = (file) => {
  const [head, ...rows] = readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(head.map((name, k) => [name, row[k]])));
};
const options = (t, name) => t.js('return [...document.querySelector(arguments[0]).options].map((o) => o.value)', t.at(name));
const atLast = 'const s = v.run.frames.at(-1).support;';

// ---- bolts: forces, utilisations and collars as in bolts.csv, and their colours

export async function testBolts(t) {
  const out = t.run(join(t.source, 'examples/bolted_roof.toml'), 'bolted_roof');
  await t.open(t.page(out));
  assert.equal(await t.viewer('return v.look.bolts'), 'use', 'the first choice');
  await t.save('bolts');
  const rows = table(join(out, 'bolts.csv')).filter((row) => row.stage === '2');
  const shown = await t.viewer(`${atLast} return { force: [...s.force], use: [...s.use], mark: [...s.mark] }`);
  assert.equal(rows.length, shown.force.length);
  rows.forEach((row, i) => {
    near(shown.force[i], Number(row.force_N), 2 ** -11, 'force');
    near(shown.use[i], Number(row.use), 2 ** -11, 'utilisation');
  });
  assert.deepEqual(shown.mark, [2, 2], 'each begins at its collar');
  assert.deepEqual(await t.viewer('return v.pieces.list.head.filter((h) => h < 0).length'), 2, 'two dots');
  const collar = await t.viewer(`${atLast} return [s.ends[0][0][0] + v.run.head.origin[0], s.ends[0][1][0] + v.run.head.origin[1]]`);
  near(collar[0], -0.7, 1e-3, 'its collar');
  near(collar[1], 2.1, 1e-3, 'its collar');
  assert.match((await t.seen()).text, /bolts: utilisation01/);
  await t.changes('bolts by force', () => t.set('bolts', 'force'), { text: /bolts: axial force024\.1 kN/ });
  await t.changes('bolts in one colour', () => t.browser.type(t.at('bolts'), 'o'));
  assert.doesNotMatch((await t.seen()).text, /bolts: /);
  await t.open(t.page(out), '#bolts=force&lining=thrust');
  assert.equal(await t.viewer('return v.look.bolts'), 'force', 'the address wins');
  await t.changes('utilisation', () => t.set('bolts', 'use'), { text: /bolts: utilisation/ });
  await t.changes('a broken bolt', () => t.viewer(`${atLast} s.mark[0] |= 4; s.use[1] = -1; v.update()`), { text: /no yield statedbroken/ });
  await t.changes('before they were installed', () => t.set('frame', 1));
  assert.doesNotMatch((await t.seen()).text, /bolts: utilisation0/);
  await testSince(t, out);

  // a force that is rounding has no colour
  const rounding = { frames: [{ support: { mark: [2], use: [-1], force: [2e-9], linings: 0 } }] };
  assert.deepEqual([1e4, 1].map((largest) => supportsOf(rounding, largest).force), [0, 2e-9]);

  // bars without a yield have no utilisation, and their segments one collar
  const bars = t.run(join(t.source, 'cases/support/grouted.toml'), 'grouted');
  await t.open(t.page(bars));
  assert.deepEqual(await options(t, 'bolts'), ['plain', 'force']);
  assert.equal(await t.viewer('return v.look.bolts'), 'force');
  assert.equal(await t.viewer(`${atLast} return s.mark.filter((m) => m === 2).length`), 3);
  assert.ok(await t.viewer(`${atLast} return s.use.every((u) => u === -1)`));
}

// ---- displacements since the end of a stage

async function testSince(t, out) {
  await t.open(t.page(out), '#colour=displacement&magnified=100&bolts=plain');
  assert.deepEqual(await options(t, 'since'), ['-1', '1']);
  const read = `const f = v.look.frame, d = [0, 0, 0];
    return v.run.shapes.filter((s) => v.bodies.isShown(s, f)).map((s) => [...v.bodies.away(f, s, 0.1, 0.2, 0, d), ...v.run.frames[f].displacement.map((c) => c[s.body])])`;
  const whole = await t.viewer(read), range = await t.viewer('return v.legend.high'), drawn = await t.viewer('return v.positions(1, v.look.frame)');
  await t.changes('since the end of a stage', () => t.set('since', '1'), { text: /displacements ×100 after stage rock/ });
  const part = await t.viewer(read), before = await t.viewer('v.set({ since: -1, frame: 1 }); const d = [0, 0, 0]; const l = v.run.shapes.filter((s) => v.bodies.isShown(s, v.run.frames.length - 1)).map((s) => [...v.bodies.away(1, s, 0.1, 0.2, 0, d)]); v.set({ since: 1, frame: v.run.frames.length - 1 }); return l');
  part.forEach((row, i) => [0, 1, 2].forEach((k) => assert.ok(Math.abs(row[k] - (whole[i][k] - before[i][k])) < 1e-9, `body ${i}: ${row[k]}`)));
  // the wedge hangs since then, vertically as its bolts: by their extension
  const extension = Number(table(join(out, 'bolts.csv'))[0].extension_m), most = (list) => Math.max(...list.map((row) => Math.hypot(...row.slice(0, 3))));
  near(most(part), extension, 1e-6, 'the displacement since the bolts');
  assert.ok(most(whole) > 1.05 * extension, 'and before');
  assert.ok(await t.viewer('return v.legend.high') < range, 'the legend follows');
  assert.deepEqual(await t.viewer('return v.positions(1, v.look.frame)'), drawn, 'true positions stay');
  await t.open(t.page(out), '#since=rock');
  assert.equal(await t.viewer('return v.look.since'), 1);
  await t.open(t.page(out), '#since=tunnel');
  assert.match(await t.js("return document.querySelector('.told').textContent"), /since=tunnel/, 'nothing moves after the last stage');
}

// ---- linings: the forces at their nodes as in lining.csv, drawn across the ring

export async function testLining(t) {
  const out = t.run(join(t.source, 'cases/support/ring.toml'), 'ring', '--set', 'output.frames=false');
  await t.open(t.page(out));
  const rows = table(join(out, 'lining.csv')).filter((row) => row.stage === '2');
  const shown = await t.viewer(`${atLast} return { thrust: s.thrust.map((e) => [...e]), moment: s.moment.map((e) => [...e]), pressure: s.pressure.map((e) => [...e]) }`);
  assert.equal(rows.length, 240);
  for (const [name, column] of [['thrust', 'thrust_N'], ['moment', 'moment_Nm'], ['pressure', 'pressure_Pa']])
    rows.forEach((row, i) => {
      near(shown[name][0][i], Number(row[column]), 2 ** -11, name);
      near(shown[name][1][(i + 239) % 240], Number(row[column]), 2 ** -11, name);
    });
  assert.deepEqual(await options(t, 'lining'), ['none', 'thrust', 'moment', 'pressure']);
  for (const [name, text] of [['thrust', /lining: thrust[\d.]+ kN\/mcompression/], ['moment', /lining: moment[\d.]+ kN m\/m/], ['pressure', /lining: rock pressure[\d.]+ kPapressure/]]) {
    await t.changes(name, () => t.browser.type(t.at('lining'), t.KEY.down), { text });
    assert.equal(await t.viewer('return v.look.lining'), name);
    await t.save(`lining_${name}`);
  }
  // ordinates from the ring outwards, as long as the value, normal to the ring, which is nearly a circle
  const ordinates = await t.viewer(`
    v.set({ lining: 'thrust' });
    const { begin, end, width } = v.pieces.list, found = [];
    width.forEach((w, i) => { if (w === 1) found.push([begin.slice(3 * i, 3 * i + 2), end.slice(3 * i, 3 * i + 2)]); });
    return { found, reach: 0.4 * v.supports.half, most: v.supports.thrust }`);
  assert.equal(ordinates.found.length, 480);
  ordinates.found.forEach(([a, b], i) => {
    const d = [b[0] - a[0], b[1] - a[1]], out = Math.hypot(...a), value = shown.thrust[i % 2][i >> 1];
    near(Math.hypot(...d), (ordinates.reach * value) / ordinates.most, 1e-3, 'its length');
    assert.ok((d[0] * a[0] + d[1] * a[1]) / (out * Math.hypot(...d)) > 0.95, 'outwards');
  });
  await t.changes('size of forces', () => t.browser.type(t.at('forceSize'), t.KEY.right + t.KEY.right));
  await t.changes('no diagram', () => t.set('lining', 'none'));
}

// ---- the first picture, and the blocks' own colours

export async function testFirstPicture(t, wedge) {
  await t.open(t.page(wedge));
  const trial = await t.viewer('return v.run.frames.findLastIndex((f) => f.kind === 2)');
  assert.ok(trial > 0);
  assert.deepEqual(await t.viewer('return [v.look.frame, v.look.colour]'), [trial, 'set'], 'the failed trial, by joint sets');
  assert.ok(await t.viewer("const a = v.edges.geometry.attributes.trace.array; return a.includes(0) && a.includes(1) && a.includes(-1)"), 'traces in the colour of their set');
  await t.browser.click(t.at('play'));
  await t.viewer('v.play()');
  assert.ok(await t.viewer('return v.look.frame') < trial, 'it plays from the start');
  await t.changes('edges by another colour', () => t.set('colour', 'size'));
  await t.open(t.page(wedge), '#frame=1&colour=displacement');
  assert.deepEqual(await t.viewer('return [v.look.frame, v.look.colour]'), [1, 'displacement'], 'the address wins');
}

export async function testBlockColours(t, wedge) {
  const slope = t.run(join(t.source, 'examples/tutorial/slope.toml'), 'slope_run', '--set', 'output.frames=false');
  await t.open(t.page(slope));
  await t.changes('block', () => t.set('colour', 'block'), { text: /neighbours differ/ });
  await t.save('by_block');
  const colours = "return v.run.shapes.map((s) => v.choices.block.value(s, v.look.frame))";
  const first = await t.viewer(colours);
  const pairs = await t.viewer('return v.run.pairs.bodyA.map((a, i) => [a, v.run.pairs.bodyB[i]])');
  assert.ok(pairs.length > 5);
  for (const [a, b] of pairs) assert.notEqual(first[a], first[b], `blocks ${a} and ${b} touch`);
  await t.set('frame', 0);
  assert.deepEqual(await t.viewer(colours), first, 'the same at all times');
  // in the trial that fails the wedge moves and no other block does
  await t.open(t.page(wedge));
  await t.changes('moved most', () => t.set('colour', 'most'), { text: /share of the largest, [\d.]+ m[^]*75 to 100 %[^]*below 10 %fixed/ });
  const places = await t.viewer("return v.run.shapes.map((s) => [v.bodies.isFixed(s, v.look.frame), v.choices.most.value(s)])");
  assert.deepEqual(places.filter(([fixed]) => !fixed), [[false, 0]], 'the wedge');
  for (const [fixed, place] of places) assert.equal(place, fixed ? 5 : 0);
  await t.save('moved_most');
  await t.changes('a section', () => t.set('section', 'x'));
  await t.changes('at the start', () => t.set('frame', 0), { text: /no block has moved/ });
}

// ---- a distance, by clicks and by keys, which no magnification changes

const text = "return document.querySelector('.voussoir [name=measure]').parentElement.querySelector('output').textContent";

export async function testMeasure(t, wedge) {
  await t.open(t.page(wedge), '#exploded=0.4&frame=2');
  const box = await t.js("const b = document.querySelector('.voussoir canvas').getBoundingClientRect(); return [b.x, b.y]");
  // two points of one face in pixels, and their distance where they truly are
  const seen = await t.viewer(`
    for (const [f, face] of v.faces.entries()) {
      const shape = v.run.shapes[face.shape], { points } = shape.parts[face.part], place = (look, mix) => {
        const x = [0, 0, 0];
        face.corners.forEach((c, i) => { for (let k = 0; k < 3; ++k) x[k] += mix[i] * points[3 * c + k]; });
        return v.bodies.place(shape, v.look.frame, ...x, look, [0, 0, 0]);
      };
      const n = face.corners.length, mixes = [0, 1].map((i) => face.corners.map((_, j) => (j === i ? 0.6 : 0) + 0.4 / n));
      const pixels = mixes.map((mix) => v.project(place(v.look, mix)).map(Math.round));
      if (pixels.some((p) => v.faceAt(...p) !== f) || Math.hypot(pixels[0][0] - pixels[1][0], pixels[0][1] - pixels[1][1]) < 60) continue;
      const [a, b] = mixes.map((mix) => place({ magnified: 1, exploded: 0 }, mix));
      return { pixels, length: Math.hypot(...a.map((x, k) => x - b[k])) };
    }`);
  await t.changes('measure', () => t.browser.click(t.at('measure')), { pixels: false, text: /the first point/ });
  const click = (pixel) => t.browser.mouse([[box[0] + pixel[0], box[1] + pixel[1]]]);
  await click(seen.pixels[0]);
  assert.match(await t.js(text), /second point/);
  await click(seen.pixels[1]);
  const found = await t.viewer('return v.measure.length');
  near(found, seen.length, 0.02, 'the distance, to a pixel');
  const shown = await t.js(text);
  assert.match(shown, /^[\d.]+ m, not exploded$/);
  near(parseFloat(shown), found, 1e-3, 'its text');
  assert.equal(await t.viewer('return v.look.shape'), -1, 'nothing is picked');
  assert.equal(await t.js("return document.querySelectorAll('.overlay .measured circle').length"), 2);
  await t.save('measured');
  await t.set('magnified', 2);
  assert.match(await t.js(text), /not magnified, not exploded/);
  near(await t.viewer('return v.measure.length'), found, 1e-12, 'magnified');
  await t.set('exploded', 0);
  near(await t.viewer('return v.measure.length'), found, 1e-12, 'closed');
  await t.browser.type('.voussoir canvas', t.KEY.escape);
  assert.deepEqual([await t.js(text), await t.viewer('return v.measure.on')], ['', false], 'Escape ends it');

  // in the plane, and on the filled face of a section
  await t.open(t.page(t.run(join(t.source, 'examples/bolted_roof.toml'), 'roof_measured')), '#frame=0');
  await byKeys(t);
  await t.open(t.page(wedge), '#section=y&cutAt=0.5&azimuth=90&height=0');
  await byKeys(t);
}

// by keys alone: the point at the cross, and again when the picture has moved by forty pixels
async function byKeys(t) {
  await t.browser.type('.voussoir canvas', `m${t.KEY.enter}`);
  assert.match(await t.js(text), /second point/);
  await t.js("document.querySelector('.voussoir canvas').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', shiftKey: true, bubbles: true }))");
  await t.browser.type('.voussoir canvas', t.KEY.enter);
  near(await t.viewer('return v.measure.length'), await t.viewer('return 40 * v.camera.perPixel'), 1e-5, 'forty pixels');
  await t.browser.type('.voussoir canvas', 'm');
  assert.equal(await t.js(text), '');
}
