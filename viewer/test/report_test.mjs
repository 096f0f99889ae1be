// node report_test.mjs PROGRAM SOURCE FOLDER: reports on runs, opened from disk in headless Chromium: their numbers
// against the runs' files, orientations against their definition, hostile names, phone and print. Pictures for inspection
// stay in FOLDER. Ends with 77 if a program is missing, which VOUSSOIR_NO_SKIP=1 makes a failure.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Browser, found } from './browser.mjs';

const [program, source, folder] = process.argv.slice(2);

for (const needed of ['chromium', 'chromedriver'])
  if (!found(needed)) {
    console.log(`not tested: ${needed} is not installed`);
    process.exit(process.env.VOUSSOIR_NO_SKIP === '1' ? 1 : 77);
  }

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const call = (...words) => spawnSync(program, words, { encoding: 'utf8' });
function run(scene, name, ...more) {
  const out = join(folder, name), { status, stderr } = call('run', join(source, scene), '--quiet', '--out', out, ...more);
  assert.ok(status === 0 || status === 1, `${name}: ${stderr}`);
  return out;
}
function report(out, ...more) {
  const { status, stdout, stderr } = call('report', out, ...more);
  assert.equal(status, 0, stderr);
  return stdout.split('\n')[0];
}
const results = (out) => JSON.parse(readFileSync(join(out, 'results.json'), 'utf8'));

const browser = await Browser.open({ width: 1000, height: 900 });
const js = (text, ...args) => browser.js(text, ...args);
async function open(file) {
  await browser.go(file);
  await browser.until(`${file} opens`, "document.querySelector('main')?.dataset.state !== undefined");
  await browser.quiet(file);
  assert.equal(await js("return document.querySelector('main').dataset.state"), 'ready');
}
const picture = async (name) => writeFileSync(join(folder, `${name}.png`), await browser.png());
const text = () => js("return document.querySelector('main').innerText");
// the rows of the table after a heading, as texts
const rows = (title) => js(`
  const part = [...document.querySelectorAll('section')].find((s) => s.querySelector('h2').textContent === arguments[0]);
  return part ? [...part.querySelectorAll('tbody tr')].map((row) => [...row.cells].map((cell) => cell.textContent)) : null;`, title);

// ---- a search in space, with its blocks

const slope = run('examples/tutorial/slope.toml', 'slope', '--view');
const page = report(slope, '--project', 'Road 7 <b>&', '--author', 'A. Voss', '--date', '2026-11-28');
assert.equal(page, join(slope, 'report.html'));
assert.ok(statSync(page).size < 400_000, `${statSync(page).size} bytes`);
await open(page);
await picture('slope');
{
  const found = results(slope), seen = await text(), value = found.values.factor_of_safety;
  for (const words of ['Road 7 <b>&', 'A. Voss', '2026-11-28', `Factor of safety ${value.value.toFixed(4)} ± ${value.error_bar.toFixed(4)}`,
    found.at_last_stable_state[0].last_failed_trial.mechanism.sentence.slice(1), '1.07', found.state_hash, 'last stable state', 'numerical error only'])
    assert.ok(seen.includes(words), words);
  assert.ok(seen.includes(readFileSync(join(slope, 'scene.toml'), 'utf8').trim()), 'the input in full');
  for (const file of ['results.json', 'search.csv', 'view.bin']) assert.ok(!seen.includes(file), `${file} is no word of the user`);

  // normal and shear forces: equilibrium of the two blocks, whose weight is the sum of all forces on the held joints
  const carried = await rows('What the joints carry');
  const of = (name) => carried.find((row) => row[0] === name).slice(2, 4).map(Number);
  const mechanism = found.at_last_stable_state[0].last_failed_trial.mechanism.clusters[0];
  const [normalA] = of('A1'), [normalB] = of('B1');
  const sizes = Object.fromEntries(mechanism.joints.map((joint) => [joint.joint, joint.normal_force_N / 1000]));
  assert.ok(Math.abs(normalA / sizes.A1 - 1) < 0.05 && Math.abs(normalB / sizes.B1 - 1) < 0.05, `${normalA} ${normalB} ${JSON.stringify(sizes)}`);

  const trials = await rows('The search');
  assert.equal(trials.length, readFileSync(join(slope, 'search.csv'), 'utf8').trim().split('\n').length - 1);
}

// poles, not the planes' own lines: of A1, dip 46 towards 128, plunges 44 towards 308
{
  const poles = await js(`
    const net = [...document.querySelectorAll('figure')].find((f) => f.textContent.includes('Poles')), circle = [...net.querySelectorAll('[aria-label="line"] path')].map((p) => p.getBBox()).sort((a, b) => b.width + b.height - a.width - a.height)[0];
    const R = circle.width / 2, cx = circle.x + R, cy = circle.y + R;
    return [...net.querySelectorAll('[aria-label="dot"] circle')].map((dot) => [(dot.cx.baseVal.value - cx) / R, (cy - dot.cy.baseVal.value) / R]);`);
  assert.equal(poles.length, 4);
  const r = Math.SQRT2 * Math.sin(((90 - 44) / 2) * Math.PI / 180), trend = (308 * Math.PI) / 180;
  const nearest = Math.min(...poles.map(([x, y]) => Math.hypot(x - r * Math.sin(trend), y - r * Math.cos(trend))));
  assert.ok(nearest < 0.02, `the pole of A1 is off by ${nearest} radii: ${JSON.stringify(poles)}`);
}

// the buttons: a table as CSV, a figure as a file
{
  await js("window.copied = null; navigator.clipboard.writeText = async (t) => { window.copied = t; };");
  await js("[...document.querySelectorAll('button')].find((b) => b.textContent === 'copy as CSV').click()");
  await browser.until('a table is copied', 'window.copied !== null');
  assert.match(await js('return window.copied'), /^stage,kind,ended,steps,/);
  await js("window.saved = []; HTMLAnchorElement.prototype.click = function () { window.saved.push(this.download); };");
  for (const kind of ['SVG', 'PNG']) await js(`[...document.querySelectorAll('figcaption button')].find((b) => b.textContent === '${kind}').click()`);
  await browser.until('a figure is saved twice', 'window.saved.length === 2');
  assert.deepEqual(await js('return window.saved'), ['convergence.svg', 'convergence.png']);
  await browser.quiet(page);
}

// a print has the blocks as a picture, the one that is seen
{
  const printed = () => js("return document.querySelector('img.printed').src");
  const first = await printed();
  assert.ok(first.startsWith('data:image/png') && first.length > 10_000, 'the blocks are no picture');
  await js("const bar = document.querySelector('.voussoir input[name=frame]'); bar.value = 0; bar.dispatchEvent(new Event('input', { bubbles: true }));");
  await browser.until('the picture follows', `document.querySelector('img.printed').src !== ${JSON.stringify(first)}`);
}

// ---- supports in the plane; names that are no markup; a run without blocks

const tunnel = run('docs/supports.toml', 'tunnel', '--view');
await open(report(tunnel));
await picture('tunnel');
{
  const stage = results(tunnel).stages.at(-1), [bolts, lining] = await rows('Supports');
  assert.deepEqual(bolts.slice(1, 3), [stage.bolts[0].bolts, String(stage.bolts[0].count)]);
  assert.ok(Math.abs(Number(bolts[3]) * 1000 / stage.bolts[0].force_N - 1) < 5e-3);
  assert.ok(Math.abs(Number(lining[2]) * 1000 / stage.linings[0].thrust_N_per_m - 1) < 5e-3);
}

const names = run('viewer/test/names.toml', 'names', '--view');
await open(report(names));
assert.equal(await js('return window.broken'), null, 'a name runs as a script');
assert.ok((await text()).includes('Fjellskråning – Stollen 岩盤 Тоннель'));

const plain = run('viewer/test/wedge.toml', 'plain');
await open(report(plain, '--out', join(folder, 'elsewhere.html')));
assert.ok((await text()).includes('run it with --view'));
assert.ok(statSync(join(folder, 'elsewhere.html')).size < 200_000);

// ---- a study: probability of failure, what it depends on, the worst rows and their runs

const study = join(folder, 'study');
{
  const { status, stderr } = call('study', join(source, 'examples/wet_slope_study.toml'), '--quiet', '--out', study);
  assert.equal(status, 0, stderr);
  await open(report(study, '--project', 'Road 7'));
  await picture('study');
  const sample = JSON.parse(readFileSync(join(study, 'sample_1.json'), 'utf8')), seen = await text();
  for (const words of ['Road 7', `Probability of failure ${Number((100 * sample.failed.share).toPrecision(3))} %`, `${sample.failed.count} of 30 rows are below 1`,
    'joint: cohesion', 'rank correlation']) assert.ok(seen.includes(words) || (await js("return document.querySelector('main').textContent")).includes(words), words);
  const worst = await rows('Sample: scatter of strength');
  assert.equal(worst.length, 10);
  assert.equal(Number(worst[0].at(-1)), Number(sample.smallest.toPrecision(3)));
  const links = await js("return [...document.querySelectorAll('td a')].map((a) => a.getAttribute('href'))");
  assert.equal(links.length, 10);
  const result = JSON.parse(readFileSync(join(study, links[0], 'results.json'), 'utf8'));
  const value = result.values?.factor_of_safety?.value ?? result.factor_of_safety;
  if (value !== undefined) assert.ok(Math.abs(value - sample.smallest) < 1e-9, `the first link's run has ${value}`);
}

// ---- a kinematic analysis: two nets whose friction circles are not each other's

const directions = join(folder, 'directions');
{
  const { status, stdout, stderr } = call('blocks', join(source, 'examples/tutorial/slope.toml'), '--kinematics', '--face', '70/180', '--friction', '29', '--out', directions);
  assert.equal(status, 0, stderr);
  await open(report(directions));
  await picture('directions');
  const zones = await rows('Zones of the face'), printed = stdout.split('\n').filter((line) => / of +\d+ +[\d.]+ %/.test(line));
  assert.equal(zones.length, 14);
  zones.forEach(([mode, count], k) => assert.ok(printed[k].includes(mode) && printed[k].match(/(\d+) of/)[1] === count, printed[k]));
  // in each net, the radius of the largest circle about the centre in the colour of sliding
  const circles = await js(`
    return ['Poles: plane', 'Lines of'].map((begin) => {
      const net = [...document.querySelectorAll('figure')].find((f) => f.querySelector(':scope > figcaption')?.textContent.startsWith(begin));
      const paths = [...net.querySelectorAll('[aria-label="line"]')].map((g) => ({ stroke: g.getAttribute('stroke'), dashed: g.hasAttribute('stroke-dasharray'), box: g.querySelector('path').getBBox() }));
      const rim = Math.max(...paths.map((p) => p.box.width));
      return paths.find((p) => p.stroke === '#d55e00' && !p.dashed).box.width / rim;
    });`);
  assert.ok(Math.abs(circles[0] - 0.354091) < 2e-3 && Math.abs(circles[1] - 0.717768) < 2e-3, `friction circles ${circles}`);
  // equal angle by choice
  await js("const s = document.querySelectorAll('select')[1]; s.value = 'angle'; s.dispatchEvent(new Event('change'));");
  await browser.quiet(join(directions, 'report.html'));
}

// ---- a phone: nothing is wider than the page

await browser.command('/window/rect', { width: 420, height: 900 });
await open(page);
await picture('phone');
assert.ok(await js('return document.documentElement.scrollWidth <= window.innerWidth'), 'the page is wider than a phone');

// ---- what is refused, and how

const refused = (words, pattern) => {
  const { status, stderr } = call(...words);
  assert.equal(status, 2, stderr);
  assert.match(stderr, pattern);
};
refused(['report', join(folder, 'nothing')], /is not a folder/);
refused(['report', folder], /contains no run: make one with 'voussoir run/);
refused(['report', plain, '--out', join(folder, 'elsewhere.html')], /--overwrite/);
const verdicts = join(folder, 'verdicts');
assert.equal(call('blocks', join(source, 'examples/wedge.toml'), '--out', verdicts).status, 0);
refused(['report', verdicts], /of another command than 'run'/);
refused(['report', plain, '--out', join(plain, 'scene.toml'), '--overwrite'], /is read/);
assert.equal(report(slope), page, 'its own page is replaced');

await browser.close();
console.log('the reports are right');
