// Finds the figures of a page and shows them: immediately, or when their poster is clicked.
import style from './style.css';
import { inflate, readRun } from './data.js';
import { Viewer } from './viewer.js';

const MOST = 8; // simultaneous pictures: browsers refuse more than about 16 contexts
const views = [];

const message = (element, text) => {
  const line = document.createElement('p');
  line.className = 'message';
  line.textContent = text;
  element.append(line);
};

async function start(element, base64) {
  try {
    const run = readRun(await inflate(base64));
    // a page with one figure has its look in its address, a fragment in itself
    const look = atob(element.dataset.look) || location.hash.slice(1);
    const viewer = new Viewer(element, run, new URLSearchParams(look));
    views.push(viewer);
    if (views.length > MOST) views.shift().close();
    if (document.querySelectorAll('.voussoir').length === 1) document.title = run.head.title || 'Voussoir';
    element.dataset.state = 'ready';
    return viewer;
  } catch (error) {
    element.dataset.state = 'failed';
    message(element, `The blocks cannot be shown: ${error.message}`);
    throw error;
  }
}

function prepare(element, _, { length: count }) {
  const data = element.querySelector('script');
  const base64 = data.textContent, image = element.querySelector('img');
  data.remove();
  if (!image && count === 1) return start(element, base64);
  const button = document.createElement('button'), word = document.createElement('span');
  button.type = 'button';
  button.className = 'poster';
  word.textContent = 'turn the blocks';
  button.append(...(image ? [image] : []), word);
  const wait = () => {
    element.append(button);
    element.dataset.state = 'poster';
  };
  button.onclick = async () => {
    button.remove();
    (await start(element, base64)).closed = wait;
  };
  wait();
}

function begin() {
  const sheet = document.createElement('style');
  sheet.textContent = style;
  document.head.append(sheet);
  document.querySelectorAll('.voussoir').forEach(prepare);
}

window.voussoir = { views, start: (element) => prepare(element, 0, { length: 1 }) };
if (document.readyState === 'loading') document.addEventListener('DOMContentLoaded', begin);
else begin();
