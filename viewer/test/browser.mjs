// Headless Chromium by chromedriver's WebDriver, with software WebGL; uses only node's own library.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { accessSync, constants } from 'node:fs';
import { delimiter, join } from 'node:path';

export function found(program) {
  for (const folder of (process.env.PATH ?? '').split(delimiter)) {
    try {
      accessSync(join(folder, program), constants.X_OK);
      return join(folder, program);
    } catch { /* in the next one */ }
  }
  return null;
}

const ELEMENT = 'element-6066-11e4-a52e-4f735466cecf';
const options = (binary, width, height) => ({
  binary,
  args: ['--headless=new', '--no-sandbox', '--disable-gpu-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    // the page around the picture is painted without WebGL's software, which took most of the time of a load
    '--disable-gpu-rasterization', '--disable-gpu-compositing',
    '--hide-scrollbars', '--force-device-scale-factor=0.7', `--window-size=${width},${height}`, '--disable-dev-shm-usage'],
});

async function startDriver() {
  const child = spawn(found('chromedriver'), ['--port=0'], { stdio: ['ignore', 'pipe', 'ignore'] });
  process.on('exit', () => child.kill());
  let text = '';
  for await (const part of child.stdout) {
    text += part;
    const port = text.match(/successfully on port (\d+)/);
    if (port) {
      child.stdout.resume();
      return { child, address: `http://127.0.0.1:${port[1]}` };
    }
  }
  throw new Error(`chromedriver did not start: ${text}`);
}

export class Browser {
  static async open({ width = 1200, height = 760 } = {}) {
    const browser = new Browser();
    Object.assign(browser, await startDriver());
    const session = await browser.ask('POST', '/session', { capabilities: { alwaysMatch: {
      browserName: 'chrome', 'goog:chromeOptions': options(found('chromium'), width, height),
      'goog:loggingPrefs': { browser: 'ALL', performance: 'ALL' }, timeouts: { script: 120000, pageLoad: 120000 } } } });
    browser.path = `/session/${session.sessionId}`;
    return browser;
  }

  async ask(method, path, body) {
    const answer = await fetch(this.address + path, { method, ...(body && { body: JSON.stringify(body) }) });
    const { value } = await answer.json();
    if (value?.error) throw new Error(`${value.error}: ${value.message}`);
    return value;
  }
  command(path, body = {}) { return this.ask('POST', this.path + path, body); }

  async go(file, hash = '') {
    await this.logs();
    await this.command('/url', { url: 'about:blank' });
    await this.command('/url', { url: `file://${encodeURI(file)}${hash}` });
  }
  // waits for a promise too
  js(script, ...args) { return this.command('/execute/sync', { script, args }); }
  async find(css) { return (await this.command('/element', { using: 'css selector', value: css }))[ELEMENT]; }
  async click(css) { return this.command(`/element/${await this.find(css)}/click`); }
  async type(css, keys) { return this.command(`/element/${await this.find(css)}/value`, { text: keys }); }
  async png() { return Buffer.from(await this.ask('GET', `${this.path}/screenshot`), 'base64'); }

  // a mouse: presses at the first point and releases at the last
  mouse(points, keys = []) {
    const move = ([x, y]) => ({ type: 'pointerMove', duration: 30, x: Math.round(x), y: Math.round(y), origin: 'viewport' });
    const actions = [move(points[0]), { type: 'pointerDown', button: 0 }, ...points.slice(1).map(move), { type: 'pointerUp', button: 0 }];
    return this.command('/actions', { actions: [{ type: 'pointer', id: 'mouse', actions }, ...keys] });
  }

  async log(type) { return this.command('/se/log', { type }); }
  // the console's lines, and the requests, since last time
  async logs() {
    const consoleLines = (await this.log('browser')).filter((line) => line.level === 'SEVERE' || line.source === 'javascript');
    const requests = (await this.log('performance')).map((line) => JSON.parse(line.message).message)
      .filter((message) => message.method === 'Network.requestWillBeSent').map((message) => message.params.request.url);
    return { console: consoleLines.map((line) => line.message), requests };
  }

  // waits for an expression to hold in the page, 10 s at most
  async until(what, text) {
    for (let i = 0; i < 400; ++i, await new Promise((done) => setTimeout(done, 25))) if (await this.js(`return ${text}`)) return;
    assert.fail(`${what}: never came`);
  }

  // the page has requested only itself, and its console is empty
  async quiet(file) {
    const { console: lines, requests } = await this.logs();
    assert.deepEqual(lines, [], `${file}: the console has errors`);
    const outside = requests.filter((url) => !/^(data:|blob:|about:)/.test(url) && !url.split('#')[0].endsWith(encodeURI(file)));
    assert.deepEqual(outside, [], `${file}: it requests more than itself`);
  }

  async close() {
    await this.ask('DELETE', this.path).catch(() => {});
    this.child.kill();
  }
}
