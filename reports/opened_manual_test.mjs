// node opened_manual_test.mjs MANUAL.html CASES: whether the blocks of a manual can be turned where it is read: posters
// first, a picture when one is clicked, through which the manual's own style lets the blocks be seen.
import assert from 'node:assert/strict';
import { Browser } from '../viewer/test/browser.mjs';

const [manual, cases] = process.argv.slice(2);
const browser = await Browser.open({ width: 1300, height: 900 });
const until = async (what, condition) => {
  for (let i = 0; i < 400; ++i) {
    if (await browser.js(`return ${condition}`)) return;
    await new Promise((done) => setTimeout(done, 50));
  }
  assert.fail(`no ${what}`);
};
const states = (wanted) => `[...document.querySelectorAll('.voussoir')].filter((e) => e.dataset.state === '${wanted}').length`;

await browser.go(manual);
await until('posters', `${states('poster')} === ${cases}`);
assert.equal(await browser.js("return document.querySelectorAll('canvas').length"), 0, 'nothing is drawn before a click');
await browser.js("document.querySelector('.voussoir .poster').click()");
await until('picture', `${states('ready')} === 1`);
assert.equal(await browser.js("return getComputedStyle(document.querySelector('.voussoir svg.overlay, .voussoir .overlay svg')).backgroundColor"),
  'rgba(0, 0, 0, 0)', 'what lies over the blocks lets them be seen');
// what the list of views says is what is seen
assert.equal(await browser.js('return window.voussoir.views[0].look.forces'), 'arrows');
const { console: said, requests } = await browser.logs();
assert.deepEqual(said, []);
assert.deepEqual(requests.filter((address) => !/^(data|blob|about):/.test(address) && !address.endsWith(manual)), []);
await browser.close();
process.exit(0);
