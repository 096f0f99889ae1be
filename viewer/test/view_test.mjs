// node view_test.mjs PROGRAM SOURCE SCRIPT FOLDER: runs scenes, opens their pages from disk in headless Chromium, and uses
// every control. SCRIPT is the bundled viewer.js; pictures for inspection stay in FOLDER. Ends with 77 if a program
// is missing, which VOUSSOIR_NO_SKIP=1 makes a failure.
import assert from 'node:assert/strict';
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Browser, found } from './browser.mjs';
import { cornersByBody } from './blocks_vtp.mjs';
import { testBlockColours, testBolts, testFirstPicture, testLining, testMeasure } from './looks.mjs';
import { ramp } from '../src/colours.js';
import { PAIR, readRun } from '../src/data.js';

const [program, source, script, folder] = process.argv.slice(2);
const long = process.argv[6] === 'long';

function skip(why) {
  console.log(`not tested: ${why}`);
  process.exit(process.env.VOUSSOIR_NO_SKIP === '1' ? 1 : 77);
}
for (const needed of ['chromium', 'chromedriver']) if (!found(needed)) skip(`${needed} is not installed`);
try { statSync(script); } catch { skip('the viewer is not built: npm or its registry is missing (viewer/modules/npm.log)'); }

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const own = (name) => join(source, 'viewer/test', name);
const run = (scene, name, ...more) => {
  const out = join(folder, name);
  const { status, stderr } = spawnSync(program, ['run', scene, '--view', '--quiet', '--out', out, ...more], { encoding: 'utf8' });
  assert.ok(status === 0 || status === 1, `${name}: ${stderr}`);
  return out;
};
const page = (out) => join(out, 'view.html');

const browser = await Browser.open({ width: 800, height: 560 });
const js = (text, ...args) => browser.js(text, ...args);
const wait = (ms) => new Promise((done) => setTimeout(done, ms));

const until = (what, text) => browser.until(what, text);

// the page is shown, has requested only itself, and its console is empty
async function open(file, hash = '') {
  await browser.go(file, hash);
  await until(`${file} opens`, "document.querySelector('.voussoir')?.dataset.state !== undefined");
  await quiet(file);
}
async function quiet(file) {
  await browser.quiet(file);
  assert.equal(await js("return document.querySelector('.voussoir').dataset.state"), 'ready');
}

// the visible content: a number from the picture's pixels, and all text
const SEEN = `
  const v = window.voussoir.views[0], gl = v.renderer.getContext();
  v.draw();
  const w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, pixels = new Uint32Array(w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(pixels.buffer));
  let hash = 0;
  for (let i = 0; i < pixels.length; ++i) hash = (Math.imul(hash, 31) + pixels[i]) | 0;
  return { pixels: hash, text: v.element.innerText + v.overlay.element.textContent };`;
const seen = () => js(SEEN);
const save = async (name) => writeFileSync(join(folder, `${name}.png`), await browser.png());

async function changes(what, act, { pixels = true, text = null } = {}) {
  const before = await seen();
  await act();
  const after = await seen();
  if (pixels) assert.notEqual(after.pixels, before.pixels, `${what}: the picture stays the same`);
  if (text) assert.match(after.text, text, `${what}: the text does not match`);
}

const at = (name) => `.voussoir [name="${name}"]`;
const set = (name, value) => js(`
  const input = document.querySelector(arguments[0]);
  input.value = arguments[1];
  input.dispatchEvent(new Event(input.type === 'range' ? 'input' : 'change', { bubbles: true }));`, at(name), value);
const KEY = { right: '\uE014', down: '\uE015', left: '\uE012', end: '\uE010', home: '\uE011', tab: '\uE004', enter: '\uE007', space: ' ', escape: '\uE00C' };
// restores what a test of the mouse has changed
const restore = (name) => js('document.querySelector(arguments[0]).click()', at(name));
const middle = (css) => js(`
  const box = document.querySelector(arguments[0]).getBoundingClientRect();
  return [box.x + box.width / 2, box.y + box.height / 2];`, css);
const viewer = (text, ...args) => js(`const v = window.voussoir.views[0]; ${text}`, ...args);

// ---- sizes

const FALL = ['--until', 'fall', '--set', 'stage.fall.duration_s=1', '--set', 'output.frame_interval_s=0.0205'];

// larger values are darker, also printed in grey: the luminance of sRGB
function testGrey() {
  const linear = (c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
  const luminance = ramp.map(([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b));
  luminance.slice(1).forEach((light, i) => assert.ok(light < 0.9 * luminance[i], `colour ${i + 1} is darker than the one before`));
}

function testSizes() {
  const size = statSync(script).size;
  assert.ok(size <= 650_000, `the viewer's script has ${size} bytes`);
  const fall = run(join(source, 'cases/free_fall/scene.toml'), 'fall', ...FALL);
  const bytes = statSync(page(fall)).size;
  assert.ok(bytes <= 1_000_000, `200 blocks and 50 frames take ${bytes} bytes`);
  console.log(`script ${size} bytes; 200 blocks and 50 frames ${bytes} bytes`);
  return fall;
}

// ---- positions as they are read back from the page, against the frames that ParaView gets

async function testPositions(out, frames) {
  await open(page(out));
  assert.equal(await viewer('return v.run.frames.length'), frames + 1);
  const draw = (seed) => () => (seed = (Math.imul(seed, 1103515245) + 12345) >>> 1) / 2 ** 31;
  const random = draw(2024);
  for (let k = 0; k < 10; ++k) {
    const frame = Math.floor(random() * frames);
    const bodies = cornersByBody(join(out, 'frames', `blocks_${String(frame).padStart(4, '0')}.vtp`));
    const body = [...bodies.keys()][Math.floor(random() * bodies.size)];
    const found = (await viewer('return v.positions(...arguments[0])', [body, frame + 1])).flat();
    const wanted = bodies.get(body), size = Math.max(...wanted.flat().map(Math.abs), 1);
    assert.equal(found.length, wanted.length);
    found.forEach((p, i) => p.forEach((c, d) =>
      assert.ok(Math.abs(c - wanted[i][d]) <= 4 * 2 ** -24 * size, `body ${body}, frame ${frame}: ${p} is not ${wanted[i]}`)));
    // and the picture shows it there
    const centre = wanted.reduce((s, p) => s.map((c, d) => c + p[d] / wanted.length), [0, 0, 0]);
    const face = await viewer(`v.set({ frame: arguments[1], showFixed: true });
      const o = [...v.run.head.origin, 0], f = v.faceAt(...v.project(arguments[0].map((c, k) => c - o[k])));
      return f < 0 ? -1 : v.faces[f].shape`, centre, frame + 1);
    assert.ok(face >= 0, 'a block is where the page says');
  }
}

// ---- the controls, one after the other

async function testControls(out) {
  await open(page(out));
  await save('wedge');
  const canvas = await middle('.voussoir canvas');
  await changes('time', () => browser.type(at('frame'), KEY.home), { text: /at the start/ });
  await changes('time', () => set('frame', 3), { text: /trial|stage/ });
  await changes('magnified', () => browser.type(at('magnified'), KEY.end), { text: /×1000/ });
  await set('magnified', 1);
  for (const [colour, text] of [['displacement', / mm/], ['velocity', /m\/s/], ['friction', /share of friction mobilised/],
    ['properties', /joint properties/], ['size', /m³/], ['set', /joint set/]])
    await changes(`colour ${colour}`, () => set('colour', colour), { pixels: !['properties'].includes(colour), text });
  await changes('arrows', () => set('forces', 'arrows'), { text: /N/ });
  await changes('size of forces', () => browser.type(at('forceSize'), KEY.right + KEY.right + KEY.right));
  await changes('network', () => set('forces', 'network'), { text: /N/ });
  await set('forces', 'none');
  for (const section of ['x', 'y', 'z', 'joint 0']) await changes(`section ${section}`, () => set('section', section));
  await changes('place of the section', () => set('cutAt', 0.3), { text: /below it/ });
  await changes('other side', () => browser.click(at('cutOther')));
  await restore('cutOther');
  await set('section', 'none');
  await changes('exploded', () => set('exploded', 0.5), { text: /50 %/ });
  for (const group of ['group 0', 'group 1']) await changes(`hide ${group}`, () => browser.click(at(group)));
  await restore('group 0');
  await restore('group 1');
  await changes('hide fixed blocks', () => browser.click(at('showFixed')));
  await restore('showFixed');
  await changes('no edges', () => browser.click(at('edges')));
  await restore('edges');
  await set('exploded', 0);
  for (const side of ['top', 'north', 'east', 'south', 'west']) await changes(`from ${side}`, () => browser.click(at(`from ${side}`)));
  await changes('turn', () => browser.mouse([canvas, [canvas[0] + 80, canvas[1] - 40]]));
  await changes('zoom', () => js("document.querySelector('.voussoir canvas').dispatchEvent(new WheelEvent('wheel', { deltaY: -300, cancelable: true }))"));
  await changes('keys turn', () => browser.type('.voussoir canvas', KEY.left));
  await changes('keys zoom', () => browser.type('.voussoir canvas', '-'));
  await changes('whole model', () => browser.click(at('fit')));
  await testPlay();
  await testLinks();
  await testPng();
  await quiet(page(out));
}

async function testPlay() {
  await viewer('v.lookFrom(-60, 24)');
  await set('frame', 0);
  await set('magnified', 2);
  await changes('play', async () => {
    await browser.click(at('play'));
    await until('the last frame', 'window.voussoir.views[0].look.frame === window.voussoir.views[0].run.frames.length - 1');
  });
  await until('it stops', '!window.voussoir.views[0].playing');
  await set('magnified', 0);
}

// faces choose poles, poles choose faces, and a block shows its information
async function testLinks() {
  await viewer('v.set({ exploded: 0.6, shape: -1, face: -1 }); v.lookFrom(-60, 24)');
  await changes('a pole', () => browser.click('.voussoir .pole[data-joint="0"]'));
  assert.equal(await viewer('return v.look.chosen'), 0);
  assert.equal(await js("return document.querySelector('.voussoir .name[data-group=\"0\"]').getAttribute('aria-pressed')"), 'true');
  await changes('the same pole again', () => browser.click('.voussoir .pole[data-joint="0"]'));
  await changes('the name of a set', () => browser.click('.voussoir .name[data-group="1"]'));
  assert.equal(await js("return document.querySelectorAll('.voussoir .pole[data-chosen]').length"), 1);
  await viewer('v.set({ chosen: -1 })');
  const pixel = await viewer(`
    for (const [f, face] of v.faces.entries()) {
      if (face.joint !== 1) continue;
      const shape = v.run.shapes[face.shape], { points } = shape.parts[face.part], sum = [0, 0, 0];
      for (const c of face.corners)
        v.bodies.place(shape, v.look.frame, ...points.subarray(3 * c, 3 * c + 3), v.look, []).forEach((x, k) => (sum[k] += x / face.corners.length));
      const pixel = v.project(sum);
      if (v.faceAt(...pixel) === f) return pixel;
    }`);
  assert.ok(pixel, 'a face of the second joint is to be seen');
  const box = await js("const b = document.querySelector('.voussoir canvas').getBoundingClientRect(); return [b.x, b.y]");
  await changes('a face', () => browser.mouse([[box[0] + pixel[0], box[1] + pixel[1]]]), { text: /face\s+cross, 60°\/220°/ });
  assert.equal(await viewer("return v.net.ring.getAttribute('visibility')"), 'visible');
  await changes('Escape', () => browser.type('.voussoir canvas', KEY.escape));
  const free = await viewer('return v.run.shapes.findIndex((s) => !v.bodies.isFixed(s, v.look.frame))');
  await changes('a block by its number', () => browser.type(at('block'), `${free}${KEY.enter}`),
    { text: /volume\s+[\d.]+ m³[^]*displacement[^]*normal\s+shear\s+friction[^]*(bedding|cross)/ });
  await viewer('v.set({ exploded: 0, shape: -1, face: -1 })');
}

async function testPng() {
  const found = await viewer(`return (async () => {
    const image = await createImageBitmap(await v.png());
    const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const data = context.getImageData(0, 0, image.width, image.height).data;
    const dark = (x0, y0, x1, y1) => { let n = 0; for (let y = y0; y < y1; ++y) for (let x = x0; x < x1; ++x) { const i = 4 * (y * image.width + x); if (data[i] + data[i + 1] + data[i + 2] < 600) ++n; } return n; };
    return { width: image.width, title: dark(10, 8, 300, 32), all: dark(0, 0, image.width, image.height) };
  })()`);
  assert.ok(found.width > 300 && found.title > 100 && found.all > 5000, `PNG: ${JSON.stringify(found)}`);
  await browser.click(at('save'));
  await until('saved', 'window.voussoir.views[0].saved');
  assert.match(await viewer('return v.saved'), /^Wedge_on_bedding.*\.png$/);
}

// what the address names and the page does not have is told, the rest holds; the keys are shown on request
async function testAddress(out) {
  await open(page(out), '#frame=0&colour=mood&block=nobody&spin=3&hidden=bedding&magnified=many');
  assert.match(await js("return document.querySelector('.told').textContent"), /: magnified=many, colour=mood, block=nobody, spin=3\.$/);
  assert.deepEqual(await viewer("return [v.look.frame, v.look.hidden.size, v.look.magnified]"), [0, 1, 1]);
  await open(page(out), '#frame=0&colour=displacement&panel=1');
  assert.equal(await js("return document.querySelector('.told')"), null);
  for (const hidden of [false, true]) {
    await browser.type('.voussoir canvas', '?');
    assert.equal(await js("return document.querySelector('.keys').hidden"), hidden);
  }
}

// the tabulator alone comes to every control
async function testKeyboard(out) {
  await open(page(out));
  await js("document.activeElement.blur(); window.reached = []; addEventListener('focusin', ({ target: e }) => window.reached.push(e.name || e.dataset?.joint && 'pole ' + e.dataset.joint || e.tagName))");
  const tabs = Array.from({ length: 60 }, () => [{ type: 'keyDown', value: KEY.tab }, { type: 'keyUp', value: KEY.tab }]).flat();
  await browser.command('/actions', { actions: [{ type: 'key', id: 'keys', actions: tabs }] });
  const reached = new Set(await js('return window.reached'));
  const all = await js("return [...document.querySelectorAll('.voussoir :is(input, select, button[name])')].map((e) => e.name)");
  assert.deepEqual([...all, 'pole 0', 'pole 1', 'CANVAS'].filter((name) => !reached.has(name)), [], 'no key reaches these');
}

// ---- a first inspection without help: at most ten inputs

async function testTenInputs(out) {
  await open(page(out));
  let inputs = 0;
  const input = (act) => { ++inputs; return act; };
  const canvas = await middle('.voussoir canvas');
  await changes('turn the wedge', input(() => browser.mouse([canvas, [canvas[0] - 50, canvas[1] + 30]])));
  await save('ten_1_turned');
  const slider = await js(`const b = document.querySelector(arguments[0]).getBoundingClientRect(); return [b.x, b.y + b.height / 2, b.width]`, at('frame'));
  assert.match((await seen()).text, /taken back/, 'it opens at a trial that slips');
  const trials = await viewer("return v.run.frames.map((f, i) => [f.kind, i]).filter(([k]) => k === 2).map(([, i]) => i / (v.run.frames.length - 1))");
  await changes('another trial that slips', input(() => browser.mouse([[slider[0] + 8 + trials.at(-2) * (slider[2] - 16), slider[1]]])), { text: /taken back/ });
  const magnify = await js(`const b = document.querySelector(arguments[0]).getBoundingClientRect(); return [b.x, b.y + b.height / 2, b.width]`, at('magnified'));
  await changes('magnify its slip', input(() => browser.mouse([[magnify[0] + 0.42 * magnify[2], magnify[1]]])), { text: /displacements ×1\d/ });
  await save('ten_2_slip');
  await changes('choose bedding', input(() => browser.click('.voussoir .pole[data-joint="0"]')));
  await save('ten_3_bedding');
  await changes('forces that hold it', input(() => browser.type(at('forces'), 'a')), { text: /[\d.]+ k?N/ });
  await save('ten_4_forces');
  assert.ok(inputs <= 10, `${inputs} inputs`);
  console.log(`turned, magnified, chosen, held: ${inputs} inputs`);
}

// ---- other pages that must open

async function testOthers() {
  const tunnel = run(join(source, 'app/testing/tunnel.toml'), 'tunnel', '--set', 'output.frames=false');
  await open(page(tunnel), '#forces=network');
  await save('tunnel');
  const area = await viewer('return [0, v.run.frames.length - 1].map((f) => v.run.shapes.filter((s) => v.bodies.isShown(s, f)).reduce((a, s) => a + s.volume, 0))');
  const tunnelArea = 12 * Math.tan(Math.PI / 12);  // twelve sides about a circle of 1 m
  assert.ok(Math.abs(area[0] - 64) < 1e-4 && Math.abs(area[0] - area[1] - tunnelArea) < 1e-4, `the excavated rock is removed: ${area}`);
  await changes('before it was dug', () => browser.type(at('frame'), KEY.home));
  const alone = run(own('alone.toml'), 'alone');
  await open(page(alone), '#colour=friction&forces=network');
  await changes('it falls', () => set('frame', 3));
  const arch = run(join(source, 'cases/arch/scene.toml'), 'arch', '--set', 'output.frame_interval_s=0.2', '--set', 'output.frames=false');
  await open(page(arch), '#forces=arrows&colour=displacement&magnified=50');
  await save('arch');
  const slope = join(folder, 'slope');
  execFileSync(program, ['slice', join(source, 'cases/slicing/bench.toml'), '--view', '--out', slope]);
  await open(page(slope), '#showFixed=0&azimuth=-50&height=30&section=y&cutAt=0.35');
  await save('bench');
}

// ---- verdicts of block theory: blocks 2 and 5 slide together, at 1.0694, on A1 and B1

async function testVerdicts() {
  const out = join(folder, 'verdicts');
  execFileSync(program, ['blocks', join(source, 'examples/tutorial/slope.toml'), '--view', '--required', '1.3', '--out', out]);
  await open(page(out));
  assert.equal(await viewer('return v.look.colour'), 'factor', 'the first choice');
  const legend = await viewer('return v.overlay.element.textContent');
  assert.match(legend, /as sliced, strength of stage "safety".*factor of safety.*1 to 1\.3 \(2\)/);
  await changes('another colour', () => set('colour', 'size'), { text: /m³/ });
  await changes('factor of safety', () => set('colour', 'factor'), { text: /factor of safety/ });
  await changes('a moving block', () => browser.type(at('block'), `5${KEY.enter}`), {
    text: /It slides on two faces \(A2, B1\) towards 38\.9\/170\.4.*factor of safety 1\.0794; force for 1\.3: 50 kN.* As part of 2\+5 it .*1\.0694/ });
  await changes('a section', () => set('section', 'y'));
  await save('verdicts');
  assert.equal(readRun(new Uint8Array(readFileSync(join(out, 'view.bin'))).buffer).verdicts.bodies[2].factor.toFixed(6), '1.069448');
}

// Given and random names: none runs, none is lost.
async function testNames() {
  const pieces = ['</script>', "<script>window['broken']++</script>", '"', "'", '`', '<', '>', '&lt;', '<!--', '-->', ']]>', '\\', '\\u003c', '${1}',
    'é', 'ß', '岩', '\u{1F9F1}', ' ', '%3C', 'javascript:', '<iframe>', '<b>', '\\0', '{{', '#'];
  let seed = 7;
  const pick = () => pieces[(seed = (Math.imul(seed, 1103515245) + 12345) >>> 1) % pieces.length];
  const fuzzed = `x${Array.from({ length: 40 }, pick).join('')}`.replace(/[.=]/g, '');
  const scene = join(folder, 'names.toml');
  writeFileSync(scene, `${readFileSync(own('names.toml'), 'utf8')}
[[joints]]
name = ${JSON.stringify(fuzzed)}
dip = 90
dip_direction = 0
point = [0, 1, 0]
`);
  const out = run(scene, 'names');
  await open(page(out));
  await viewer('v.pick(0); v.choose(0); v.set({ section: "joint 0", forces: "arrows" }); v.draw()');
  await viewer('return v.png().then(() => 1)');
  assert.equal(await js('return window.broken ?? null'), null, 'a name has run');
  assert.equal(await js("return document.querySelectorAll('img, iframe, b').length"), 0, 'a name became an element');
  assert.ok((await viewer('return v.panel.element.textContent')).includes(fuzzed), 'a name is shown as it is');
  assert.match(await js('return document.title'), /^<\/script><script>window.broken=1.*Тоннель$/);
  const html = readFileSync(page(out), 'utf8');
  for (const part of ['broken', 'Fjell', '<iframe']) assert.ok(!html.includes(part), `the page has ${part} as text`);
  await quiet(page(out));
  // in the sentence of a verdict, too
  const judged = join(folder, 'judged_names');
  execFileSync(program, ['blocks', scene, '--view', '--seismic', '0.3/90', '--out', judged]);
  await open(page(judged));
  assert.ok(await viewer("return v.run.verdicts.bodies.some((b, i) => b.sentence.includes('<script>') && (v.pickByName(String(i)), true))"));
  assert.match(await viewer("return v.panel.info.textContent"), /slides on one face \(--><\/script><script>/);
  assert.equal(await js('return window.broken ?? null'), null, 'a name has run');
  await quiet(page(judged));
}

// fragments for a page with many: a poster first, a picture when it is clicked
async function testFragments(out) {
  const poster = join(folder, 'poster.png'), piece = join(folder, 'piece.html'), code = join(folder, 'script.html');
  execFileSync(process.execPath, [join(source, 'viewer/poster.mjs'), page(out), poster, 'colour=displacement', '480', '320']);
  execFileSync(program, ['view', out, '--fragment', '--look', 'frame=1&magnified=20', '--poster', poster, '--out', piece]);
  execFileSync(program, ['view', '--script', '--out', code]);
  const many = join(folder, 'many.html');
  writeFileSync(many, `<!doctype html><meta charset=utf-8><style>.voussoir{height:320px;margin:8px}</style>${readFileSync(code)}${readFileSync(piece)}${readFileSync(piece)}`);
  await browser.go(many);
  await until('posters', "[...document.querySelectorAll('.voussoir')].every((e) => e.dataset.state === 'poster')");
  assert.equal(await js("return document.querySelectorAll('canvas').length"), 0);
  assert.equal(await js("return document.querySelector('.poster img').naturalWidth"), 480);
  await browser.click('.voussoir .poster');
  await until('a picture', "document.querySelector('.voussoir').dataset.state === 'ready'");
  assert.deepEqual(await js('const { frame, magnified } = window.voussoir.views[0].look; return [frame, magnified]'), [1, 20]);
  assert.equal(await js("return document.querySelectorAll('canvas').length"), 1);
}

// an interrupted and resumed run keeps the same file as an uninterrupted one
async function testResumed(whole, ...settings) {
  const out = join(folder, 'resumed'), data = join(out, 'view.bin');
  const child = spawn(program, ['run', join(source, 'cases/free_fall/scene.toml'), '--view', '--quiet', '--out', out, ...settings], { stdio: 'ignore' });
  const ended = new Promise((done) => child.on('exit', done));
  const size = () => { try { return statSync(data).size; } catch { return 0; } };
  while (size() < 200_000 && child.exitCode === null) await wait(2);
  child.kill('SIGINT');
  assert.equal(await ended, 130, 'it was interrupted');
  execFileSync(program, ['resume', '--quiet', out]);
  const [found, wanted] = [out, whole].map((f) => readRun(new Uint8Array(readFileSync(join(f, 'view.bin'))).buffer));
  assert.equal(found.frames.length, wanted.frames.length);
  // pairs have other numbers, and so another order
  const rows = (r, { count, pair, ...columns }) => Array.from({ length: count }, (_, i) =>
    [...PAIR.map((name) => r.pairs[name][pair[i]]), ...Object.values(columns).flat().map((column) => column[i])].join()).sort();
  found.frames.forEach((frame, f) => {
    assert.deepEqual({ ...frame, contacts: rows(found, frame.contacts) }, { ...wanted.frames[f], contacts: rows(wanted, wanted.frames[f].contacts) });
  });
}

// missing parts are named
function testFaults(out) {
  const fails = (args, text) => {
    const { status, stderr } = spawnSync(program, args, { encoding: 'utf8' });
    assert.equal(status, 2, stderr);
    assert.match(stderr, text);
  };
  const bare = join(folder, 'bare');
  execFileSync(program, ['run', own('alone.toml'), '--quiet', '--out', bare]);
  assert.throws(() => statSync(join(bare, 'view.bin')), 'a run without --view keeps no file');
  fails(['view', bare], /has no view\.bin.*--view/);
  fails(['view', folder], /contains no run/);
  fails(['view', join(folder, 'nowhere')], /not a folder/);
  fails(['view', out, '--out', join(bare, 'results.json')], /--overwrite/);
  writeFileSync(join(bare, 'view.bin'), 'VOUSVIEW and no more');
  fails(['view', bare], /damaged.*--view/);
  execFileSync(program, ['view', out]);  // its own page is made again
}

// ---- long: twenty thousand blocks, and posters

async function testMany() {
  const scene = join(folder, 'many.toml');
  const joints = (axis, dip, direction, point, n) => Array.from({ length: n - 1 }, (_, k) =>
    `[[joints]]\nname = "${axis}${k + 1}"\ndip = ${dip}\ndip_direction = ${direction}\npoint = ${point.replace('k', k + 1)}\n`).join('');
  writeFileSync(scene, `title = "Many"
dimension = 3
gravity = [0, 0, -10]
density = 2500
domain = { box = { min = [0, 0, 0], max = [28, 28, 26] } }
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]
fix = [{ below = ["z1"] }]
stage = [{ name = "load", kind = "run", duration_s = 0.01 }]
time = { step_s = 0.001 }
output = { frame_interval_s = 0.00111, frames = false }
${joints('z', 0, 0, '[0, 0, k]', 26)}${joints('x', 90, 90, '[k, 0, 0]', 28)}${joints('y', 90, 0, '[0, k, 0]', 28)}`);
  const out = run(scene, 'many', '--threads', '2');
  let began = Date.now();
  await open(page(out), '#colour=displacement');
  const opened = Date.now() - began;
  assert.equal(await viewer('return v.run.frames.at(-1).bodies'), 28 * 28 * 26);
  assert.ok(await viewer('return v.run.frames.length') >= 10);
  began = Date.now();
  await changes('turn', () => browser.mouse([[700, 350], [760, 330]]));
  const turned = Date.now() - began;
  await changes('time', () => set('frame', 5));
  await changes('section', () => set('section', 'x'));
  await changes('network', () => set('forces', 'network'));
  await save('many');
  console.log(`20384 blocks, ${await viewer('return v.run.frames.length')} frames: ${statSync(page(out)).size} bytes, opened in ${opened} ms, turned in ${turned} ms`);
}

try {
  const began = Date.now();
  let last = began;
  const timed = (what) => { console.log(`${what}: ${Date.now() - last} ms`); last = Date.now(); };
  if (long) {
    await testMany();
    await testFragments(run(own('wedge.toml'), 'wedge'));  // in `make test` the manual's test opens such pieces
  } else {
    testGrey();
    const fall = testSizes();
    timed('sizes');
    await testPositions(fall, 50);
    const turning = run(join(source, 'app/testing/turning_block.toml'), 'turning');
    await testPositions(turning, 6);
    timed('positions');
    const wedge = run(own('wedge.toml'), 'wedge');
    await testControls(wedge);
    timed('controls');
    const hold = { run, page, open, at, set, js, viewer, seen, changes, save, browser, source, KEY };
    await testBolts(hold);
    timed('bolts');
    await testLining(hold);
    timed('linings');
    await testFirstPicture(hold, wedge);
    await testBlockColours(hold, wedge);
    await testMeasure(hold, wedge);
    timed('looks');
    await testAddress(wedge);
    await testKeyboard(wedge);
    timed('keyboard');
    await testTenInputs(wedge);
    timed('teninputs');
    await testOthers();
    timed('others');
    await testVerdicts();
    timed('verdicts');
    await testNames();
    timed('names');
    testFaults(wedge);
    timed('faults');
    await testResumed(fall, ...FALL);
    timed('resumed');
  }
  console.log(`viewer: all well in ${((Date.now() - began) / 1000).toFixed(1)} s`);
} finally {
  await browser.close();
}
