// node opened_manual_test.mjs MANUAL.html CASES PAGE.html: whether the blocks of a manual can be turned, in the single file and in
// a page of the folder, and whether the single file's search works: posters first, a picture when one is clicked, through which the manual's own style lets the blocks be seen.
import assert from 'node:assert/strict';
import { Browser } from '../viewer/test/browser.mjs';

const [manual, cases, page] = process.argv.slice(2);
const browser = await Browser.open({ width: 1300, height: 900 });
const states = (wanted) => `[...document.querySelectorAll('.voussoir')].filter((e) => e.dataset.state === '${wanted}').length`;

await browser.go(manual);
await browser.until('posters', `${states('poster')} === ${cases}`);
assert.equal(await browser.js("return document.querySelectorAll('canvas').length"), 0, 'nothing is drawn before a click');
await browser.js("document.querySelector('.voussoir .poster').click()");
await browser.until('picture', `${states('ready')} === 1`);
assert.equal(await browser.js("return getComputedStyle(document.querySelector('.voussoir svg.overlay, .voussoir .overlay svg')).backgroundColor"),
  'rgba(0, 0, 0, 0)', 'the layer over the blocks is transparent');
// the view shows the state that the list of views states
assert.equal(await browser.js('return window.voussoir.views[0].look.forces'), 'arrows');
await browser.js("const box = document.getElementById('find'); box.value = 'joint_properties.cohesion_slip_m'; box.dispatchEvent(new Event('input'));");
assert.equal(await browser.js("return document.querySelector('#found a').getAttribute('href')"), '#scene-keys-joint-properties-cohesion-slip-m');
await browser.quiet(manual);

await browser.go(page);
await browser.until('poster of the page', `${states('poster')} === 1`);
await browser.js("document.querySelector('.voussoir .poster').click()");
await browser.until('picture of the page', `${states('ready')} === 1`);
assert.deepEqual((await browser.logs()).console, [], `${page}: the console has errors`);
await browser.close();
process.exit(0);
