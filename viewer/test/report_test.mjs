// node report_test.mjs PROGRAM SOURCE FOLDER: reports on runs, studies and joints, opened from disk in headless Chromium: their numbers
// against the runs' files, orientations against their definition, hostile names, phone and print. Pictures for inspection
// stay in FOLDER. Ends with 77 if a program is missing, which VOUSSOIR_NO_SKIP=1 makes a failure.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { copyFileSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
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
  const digits = 1 - Math.floor(Math.log10(value.error_bar));  // two of the bar
  for (const words of ['Road 7 <b>&', 'A. Voss', '2026-11-28', `Factor of safety ${value.value.toFixed(digits)} ± ${value.error_bar.toFixed(digits)}`,
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

// the blocks open as the interactive page opens them: the failed trial, by joint sets
{
  const [frame, trial, colour, panel] = await js("const v = window.voussoir.views[0]; return [v.look.frame, v.run.frames.findLastIndex((f) => f.kind === 2), v.look.colour, !v.element.classList.contains('bare')]");
  assert.ok(trial > 0);
  assert.deepEqual([frame, colour, panel], [trial, 'set', false]);
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
  // numbers as spreadsheets read them
  const copies = await js("const all = []; navigator.clipboard.writeText = async (t) => { all.push(t); }; for (const b of document.querySelectorAll('button')) if (b.textContent === 'copy as CSV') b.click(); return all;");
  assert.ok(copies.length > 3 && copies.every((copied) => !copied.includes('10^')), copies.join('\n'));
  assert.ok((await text()).includes('·10^-') && copies.some((copied) => /\de-\d/.test(copied)), copies.join('\n'));
  await js("window.saved = []; HTMLAnchorElement.prototype.click = function () { window.saved.push(this.download); };");
  for (const kind of ['SVG', 'PNG']) await js(`[...document.querySelectorAll('figcaption button')].find((b) => b.textContent === '${kind}').click()`);
  await browser.until('a figure is saved twice', 'window.saved.length === 2');
  assert.deepEqual(await js('return window.saved'), ['convergence.svg', 'convergence.png']);
  // the file has the plot and its legend
  await js("window.text = null; const made = URL.createObjectURL.bind(URL); URL.createObjectURL = (blob) => { blob.text().then((t) => { window.text = t; }); return made(blob); };");
  await js("[...document.querySelectorAll('figcaption button')].find((b) => b.textContent === 'SVG').click()");
  await browser.until('the text of the file', 'window.text !== null');
  const file = await js(`const saved = new DOMParser().parseFromString(window.text, 'image/svg+xml'), of = (css) => saved.querySelectorAll(css).length;
    return { error: of('parsererror'), dots: of('[aria-label="dot"] path'), legend: [...saved.documentElement.children].filter((e) => e.tagName === 'text').map((e) => e.textContent) };`);
  assert.deepEqual([file.error, file.dots, file.legend], [0, readFileSync(join(slope, 'search.csv'), 'utf8').trim().split('\n').length - 1, ['stable', 'failed', 'undecided']]);
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
  // thrust against moment of each node, in the strength of the section; thrust and two moments along the outline
  const drawn = await js(`return ['interaction', 'thrust', 'moment'].map((part) => {
    const figure = document.querySelector('figure[data-name=lining-1-' + part + ']'), of = (css) => figure.querySelectorAll('svg[role=img] ' + css).length;
    return { dots: of('[aria-label="dot"] circle'), lines: of('[aria-label="line"] path'), caption: figure.querySelector('figcaption').textContent };
  })`);
  assert.deepEqual(drawn.map(({ dots, lines }) => [dots, lines]), [[96 + 1, 1], [0, 1], [0, 2]]);
  assert.ok(drawn[0].caption.includes('0.2 m thick, 25 MPa in compression and 2 MPa in tension'), drawn[0].caption);
  const use = Number(drawn[0].caption.match(/most of it, ([\d.]+) %/)[1]);
  assert.ok(Math.abs(use / (100 * stage.linings[0].use) - 1) < 5e-3, `${use} % ${stage.linings[0].use}`);
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

// fills the fields of a scanline
const state = (fields) => js(`for (const [name, value] of Object.entries(arguments[0])) {
  const field = document.querySelector('input[name=' + name + ']');
  field.value = value;
  field.dispatchEvent(new Event('input', { bubbles: true }));
}`, fields);

// ---- a reliability analysis: its probability, both design points

const likely = join(folder, 'likely');
{
  const { status, stderr } = call('study', join(source, 'cases/reliability/two_slabs_study.toml'), '--quiet', '--out', likely);
  assert.equal(status, 0, stderr);
  await open(report(likely));
  await picture('reliability');
  const { sampled } = JSON.parse(readFileSync(join(likely, 'reliability_1.json'), 'utf8')), seen = await js("return document.querySelector('main').textContent");
  for (const words of ['Probability of failure (below 1) ', `by ${sampled.rows} rows of importance sampling around 2 design points`, 'a: friction', 'slides on B'])
    assert.ok(seen.includes(words), `${words}: ${seen.slice(0, 2000)}`);
  assert.equal((await rows('Reliability: two slabs')).length, 2);
}

// ---- a kinematic analysis: two nets whose friction circles are not each other's

const directions = join(folder, 'directions');
{
  const { status, stdout, stderr } = call('blocks', join(source, 'examples/tutorial/slope.toml'), '--kinematics', '--face', '70/180', '--friction', '29', '--out', directions);
  assert.equal(status, 0, stderr);
  await open(report(directions));
  await picture('directions');
  assert.ok(!/\d\.\d{9}/.test(await text()), 'angles are as stated');
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
  // a scanline by choice: the counts of all tables stay, weighted ones are beside them
  await state({ trend: 128, plunge: 0 });
  const [weights, chosen] = [await rows('Joints'), await js("return [...document.querySelectorAll('p.chosen')].map((p) => p.textContent)")];
  assert.ok(chosen.length === 2 && chosen.every((words) => words.includes('A choice of this page\'s reader') && words.includes('plunge/trend 00/128') && words.includes('10 at most')), chosen.join());
  // A1 46/128 and A2 49/125: 1/sin of the angle between plane and scanline, by their normals
  const weight = (dip, direction) => Math.min(10, 1 / Math.abs(Math.sin((dip * Math.PI) / 180) * Math.cos(((direction - 128) * Math.PI) / 180)));
  const clay = weights.find((row) => row[1] === '2');
  assert.ok(Math.abs(Number(clay[3]) - weight(46, 128) - weight(49, 125)) < 0.06, JSON.stringify(weights));
  assert.equal((await rows('Zones of the face')).length, 17);
  await state({ trend: '', plunge: '' });
  assert.equal((await rows('Zones of the face')).length, 14);
  // equal angle by choice
  await js("const s = document.querySelectorAll('select')[1]; s.value = 'angle'; s.dispatchEvent(new Event('change'));");
  await browser.quiet(join(directions, 'report.html'));
}

// ---- grids of a study: a map, its line of the limit against the table

const maps = join(folder, 'maps');
{
  const strength = (key, values, unit) => `{ key = "joint_properties.joint.${key}", values = [${values}], unit = "${unit}" }`;
  copyFileSync(join(source, 'examples/wet_slope.toml'), join(folder, 'wet_slope.toml'));
  writeFileSync(join(folder, 'maps.toml'), `scene = "wet_slope.toml"\nquantity = "factor_of_safety"\nlimit = { factor = true, joint = ["joint"], cohesion = true }\n`
    + `[[grid]]\nname = "strength <img src=x onerror=broken=1>"\nfails = { below = 1 }\nkeys = [${strength('friction_deg', '30, 40, 50', 'deg')}, ${strength('cohesion', '0, 20e3, 60e3', 'Pa')}]\n`
    + `[[grid]]\nname = "three"\nkeys = [{ key = "density", values = [2400, 2800] }, ${strength('friction_deg', '30, 40', 'deg')}, ${strength('cohesion', '0, 20e3', 'Pa')}]\n`);
  const { status, stderr } = call('study', join(folder, 'maps.toml'), '--quiet', '--out', maps);
  assert.equal(status, 0, stderr);
  await open(report(maps));
  await picture('maps');
  assert.equal(await js("return document.querySelectorAll('img').length"), 0, 'a name is markup');
  const drawn = await js(`return [...document.querySelectorAll('figure[data-name^=grid]')].map((figure) => {
    const of = (css) => [...figure.querySelectorAll('svg[role=img] ' + css)];
    return { cells: of('[aria-label="rect"]:nth-of-type(1) rect').length, values: of('[aria-label="text"] text').map((t) => t.textContent), line: of('[aria-label="link"] path').length, crosses: of('[aria-label="dot"] path').length };
  })`);
  const results = readFileSync(join(maps, 'grid_1.csv'), 'utf8').trim().split('\n').slice(1).map((row) => Number(row.split(',')[2]));
  assert.deepEqual(drawn.map((map) => map.values.length), [9, 4, 4]);
  assert.deepEqual(drawn[0].values.map(Number), results.map((x) => Number(x.toPrecision(3))));
  assert.equal(drawn[0].crosses, results.filter((x) => x < 1).length);
  assert.ok(drawn[0].line > 0 && drawn[1].line === 0, 'the line of factor 1 is where results are on both of its sides');
  assert.equal((await rows('Grid: three')).length, 8);
}

// ---- joints without a run: a slice in space and in the plane, made again from its folder; imported joints

{
  const out = join(folder, 'slice'), { status, stdout, stderr } = call('slice', join(source, 'docs/slicing.toml'), '--report', '--view', '--out', out);
  assert.equal(status, 0, stderr);
  const written = readFileSync(join(out, 'report.html'), 'utf8');
  assert.equal(readFileSync(report(out), 'utf8'), written, 'the page is made again');
  await open(join(out, 'report.html'));
  await picture('slice');
  // what the command prints is in the page
  for (const [set, quantity] of [['bedding, drawn', 'P32, area per volume'], ['cross, drawn', 'mean size of these'], ['cross, drawn', 'Fisher\'s constant']]) {
    const [, , stated, measured, error] = (await rows(set)).find((row) => row[0] === quantity);
    assert.ok(stdout.includes(`| ${stated} | ${measured} | ${error} |`), `${set}: ${stated} ${measured} ${error}`);
  }
  const [, , , , , smallest, largest] = await rows('Blocks');
  assert.ok(stdout.includes(`| ${smallest.join(' | ')} |`) || Math.abs(Number(smallest[1]) / 0.09967 - 1) < 5e-3, smallest.join());
  assert.ok(Math.abs(Number(largest[1]) / 52.41 - 1) < 5e-3, largest.join());
  assert.equal(await js("return document.querySelectorAll('figure[data-name=poles] [aria-label=dot] circle').length"), 47);
  assert.equal(await js("return document.querySelectorAll('.voussoir canvas').length > 0"), true, 'the blocks can be turned');
}
{
  const scene = `dimension = 2\ntitle = "plane <img src=x onerror=broken=1>"\ndomain = { box = { min = [0, 0], max = [10, 10] } }\ndensity = 2600\nstage = [{ name = "settle", kind = "settle" }]\n`
    + `joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n`
    + `joint_sets = [{ name = "left", dip = 30, dip_direction = 270, spacing = 1 }, { name = "right", dip = 75, dip_direction = 90, spacing = 1, arrangement = "equal" }]\n`;
  writeFileSync(join(folder, 'plane.toml'), scene);
  const out = join(folder, 'plane'), { status, stderr } = call('slice', join(folder, 'plane.toml'), '--report', '--out', out);
  assert.equal(status, 0, stderr);
  await open(join(out, 'report.html'));
  await picture('plane');
  assert.ok(await js("return document.querySelectorAll('img').length === 0 && document.querySelector('h1').textContent.includes('<img')"), 'a title is markup');
  assert.deepEqual((await rows('Orientations')).map((row) => row.slice(2)), [['30.0', 'left'], ['75.0', 'right']]);
  // the sectors of a trace that dips to the left rise to the right
  const sectors = await js(`const net = document.querySelector('figure[data-name=traces] svg[role=img]'), rim = [...net.querySelectorAll('[aria-label="line"] path')].map((p) => p.getBBox()).sort((a, b) => b.width - a.width)[0];
    return [...net.querySelectorAll('[aria-label="line"] path')].filter((p) => p.getAttribute('fill') === '#0072b2').map((p) => p.getBBox()).map((b) => [b.x + b.width / 2 - rim.x - rim.width / 2, rim.y + rim.height / 2 - b.y - b.height / 2]);`);
  assert.ok(sectors.length === 2 && sectors.every(([x, y]) => x * y > 0), JSON.stringify(sectors));
}
{
  // a thousand facets of two families
  const head = readFileSync(join(source, 'app/testing/import/facets.csv'), 'utf8').split('\n')[0];
  const facet = (k) => { const dip = k % 2 ? 40 + (k % 7) : 75, direction = k % 2 ? 130 : 220 + (k % 5), [d, a] = [dip, direction].map((x) => (x * Math.PI) / 180);
    return [k, k, 0, 0, k, 0, 0, Math.sin(d) * Math.sin(a), Math.sin(d) * Math.cos(a), Math.cos(d), 0.01, 1, 1, 1, 1, direction, dip, 1 + (k % 2), 0, ''].join(';') + ';'; };
  writeFileSync(join(folder, 'facets <b>.csv'), [head, ...Array.from({ length: 1000 }, (_, k) => facet(k))].join('\n'));
  const { status, stdout, stderr } = call('import', join(folder, 'facets <b>.csv'), '--as', 'facets', '--out', join(folder, 'imported.csv'));
  assert.equal(status, 0, stderr);
  await open(join(folder, 'imported_report.html'));
  await picture('imported');
  assert.equal(await js("return document.querySelector('h1').textContent"), 'Joints of facets <b>.csv');
  assert.equal(await js("return document.querySelectorAll('figure[data-name=poles] [aria-label=dot] circle').length"), 1000);
  const sets = await rows('Orientations'), printed = stdout.split('\n').filter((line) => /^family/.test(line)).map((line) => line.trim().split(/\s+/));
  assert.equal(sets.length, 2);
  sets.forEach(([name, count, mean, constant], k) => {
    const [dip, direction] = mean.split('/').map(Number);
    assert.deepEqual([name, count], printed[k].slice(0, 2));
    assert.ok(Math.abs(dip - printed[k][2]) <= 0.55 && Math.abs(direction - printed[k][3]) <= 0.55 && Math.abs(constant / printed[k][4] - 1) < 6e-3, `${mean} ${constant} ${printed[k]}`);
  });
  await state({ trend: 20, plunge: 10, largest: 5 });
  assert.ok((await rows('Orientations')).every((row) => row.length === 8));
  await browser.quiet(join(folder, 'imported_report.html'));
}

// ---- a phone: nothing is wider than the page

await browser.command('/window/rect', { width: 420, height: 900 });
for (const [name, file] of Object.entries({ phone: page, phone_tunnel: join(tunnel, 'report.html'), phone_directions: join(directions, 'report.html'), phone_maps: join(maps, 'report.html'), phone_slice: join(folder, 'slice', 'report.html'), phone_plane: join(folder, 'plane', 'report.html') })) {
  await open(file);
  await picture(name);
  assert.ok(await js('return document.documentElement.scrollWidth <= window.innerWidth'), `${name}: the page is wider than a phone`);
  const shrunk = await js("return [...document.querySelectorAll('figure svg[role=img]')].filter((svg) => svg.getBoundingClientRect().width < 0.95 * svg.getAttribute('width')).map((svg) => svg.closest('figure').dataset.name)");
  assert.deepEqual(shrunk, [], `${name}: figures whose letters shrink`);
  const cut = await js("return [...document.querySelectorAll('figure svg[role=img] text')].filter((t) => t.getBoundingClientRect().left < t.closest('figure').getBoundingClientRect().left - 1).map((t) => t.textContent)");
  assert.deepEqual(cut, [], `${name}: labels that are cut off`);
}

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
const foreign = join(folder, 'foreign');
mkdirSync(foreign);
for (const [words, pattern] of [['{"schema": "mine"}', /joints\.json' is no file of 'voussoir slice --report'/], ['[1, 2]', /is no file of/], ['{', /is damaged/]]) {
  writeFileSync(join(foreign, 'joints.json'), words);
  refused(['report', foreign], pattern);
}
assert.equal(report(slope), page, 'its own page is replaced');

await browser.close();
console.log('the reports are right');
