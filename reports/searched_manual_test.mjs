// node searched_manual_test.mjs FOLDER: whether the search of the manual's pages works from the disk: it finds a word, a key
// and an equation, and leads to them; no page is wider than a phone.
import assert from 'node:assert/strict';
import { Browser } from '../viewer/test/browser.mjs';

const [folder] = process.argv.slice(2);
const browser = await Browser.open({ width: 500, height: 800 });
const find = async (words) => {
  await browser.js(`const box = document.getElementById('find'); box.value = ${JSON.stringify(words)}; box.dispatchEvent(new Event('input'));`);
  await browser.until(`hits for ${words}`, "document.querySelectorAll('#found li').length > 0");
  return browser.js("return [...document.querySelectorAll('#found a')].map((link) => [link.textContent, link.getAttribute('href')])");
};
const narrow = async (page) => assert.equal(await browser.js('return document.documentElement.scrollWidth <= innerWidth'), true, `${page} is wider than its window`);

await browser.go(`${folder}/index.html`);
await narrow('index.html');
assert.equal(await browser.js('return window.voussoirManual === undefined'), true, 'the index is loaded when it is needed');
assert.deepEqual((await find('uplift drain'))[0], ['A dam foundation with uplift', 'docs-task-dam.html']);
assert.deepEqual((await find('joint_properties.cohesion_slip_m'))[0], ['Scene keys › joint_properties.cohesion_slip_m', 'scene-keys.html#scene-keys-joint-properties-cohesion-slip-m']);
assert.deepEqual(await find('zzzz'), []);
await find('uplift drain');
await browser.js("document.querySelector('#found a').click()");
await browser.until('the page', "location.pathname.endsWith('docs-task-dam.html')");
for (const page of ['wedge', 'equations', 'scene-keys', 'core-joint-laws', 'joint-stiffness', 'vaiont']) {
  await browser.go(`${folder}/${page}.html`);
  await narrow(page);
}
const { console: lines, requests } = await browser.logs();
assert.deepEqual(lines, []);
assert.deepEqual(requests.filter((url) => !/^(data:|blob:|about:)/.test(url) && !url.startsWith(`file://${encodeURI(folder)}/`)), []);
await browser.close();
process.exit(0);
