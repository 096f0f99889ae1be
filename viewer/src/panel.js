// The controls: plain form elements with labels, so that a keyboard reaches all of them. They change the look and call
// back; the viewer calls `refresh` when something else has changed it.
import { groupColour, digits } from './colours.js';
import { stageEnds } from './look.js';
import { BOLTS, LININGS } from './supports.js';

const VIEWS = { top: [-90, 90], north: [90, 0], east: [0, 0], south: [-90, 0], west: [180, 0] };

function node(name, properties = {}, ...children) {
  const element = document.createElement(name);
  const { dataset, ...plain } = properties;
  Object.assign(element, plain);
  Object.assign(element.dataset, dataset);
  element.append(...children);
  return element;
}

export class Panel {
  // `viewer`: run, look, choices, and what its `set` takes
  constructor(viewer) {
    this.viewer = viewer;
    this.inputs = {};
    const { run, supports } = viewer, ends = stageEnds(run), labelled = (list) => Object.entries(list).map(([key, { label }]) => [key, label]);
    this.plane = run.head.dimension === 2;
    this.element = node('form', { className: 'panel', autocomplete: 'off', onsubmit: (event) => event.preventDefault() });
    this.element.setAttribute('aria-label', 'controls');
    this.time = this.timeBar();
    this.element.append(
      this.slider('magnified', 'displacements', { min: 0, max: 3, step: 0.01 }, (v) => 10 ** v, (x) => Math.log10(x), (x) => `×${digits(x)}`),
      ...(ends.length ? [this.select('since', 'since', [['-1', 'start'], ...ends.map(([frame, name]) => [String(frame), `end of ${name}`])], Number)] : []),
      this.select('colour', 'colour', labelled(viewer.choices)),
      ...(supports.bolts ? [this.select('bolts', 'bolts', labelled(BOLTS).filter(([key]) => key !== 'use' || supports.uses))] : []),
      ...(supports.linings ? [this.select('lining', 'lining', labelled(LININGS))] : []),
      this.select('forces', 'forces', [['none', 'none'], ['arrows', 'arrows'], ['network', 'network']]),
      this.slider('forceSize', 'size of forces', { min: -1, max: 1, step: 0.02 }, (v) => 10 ** v, (x) => Math.log10(x), (x) => `×${digits(x)}`),
      ...(this.plane ? [] : this.section()),
      this.slider('exploded', 'exploded', { min: 0, max: 2, step: 0.02 }, (v) => v, (x) => x, (x) => `${Math.round(100 * x)} %`),
      this.groups(),
      ...(this.plane ? [] : [this.views()]),
      this.blockInput(),
      this.measureRow(),
      node('div', { className: 'buttons' },
        this.button('fit', 'whole model', () => viewer.fit()), this.button('save', 'save PNG', () => viewer.savePng()),
        this.button('keys', '?', () => (viewer.keys.hidden = !viewer.keys.hidden))),
      (this.info = node('div', { className: 'info' })),
    );
    this.info.setAttribute('aria-live', 'polite');
  }

  // a line above the controls
  tell(text) {
    const line = node('p', { className: 'told' }, text);
    line.setAttribute('role', 'status');
    this.element.prepend(line);
  }

  row(text, ...children) { return node('label', { className: 'row' }, node('span', {}, text), ...children); }

  slider(key, text, { min, max, step }, value, position, shown) {
    const input = node('input', { type: 'range', min, max, step, name: key });
    const output = node('output');
    input.oninput = () => this.viewer.set({ [key]: value(Number(input.value)) });
    this.inputs[key] = () => {
      const now = this.viewer.look[key];
      input.value = position(now);
      output.textContent = shown(now);
    };
    return this.row(text, input, output);
  }

  select(key, text, options, valueOf = (text) => text) {
    const input = node('select', { name: key }, ...options.map(([value, name]) => node('option', { value }, name)));
    input.onchange = () => this.viewer.set({ [key]: valueOf(input.value) });
    this.inputs[key] = () => (input.value = this.viewer.look[key]);
    return this.row(text, input);
  }

  check(key, text) {
    const input = node('input', { type: 'checkbox', name: key });
    input.onchange = () => this.viewer.set({ [key]: input.checked });
    this.inputs[key] = () => (input.checked = this.viewer.look[key]);
    return node('label', { className: 'check' }, input, node('span', {}, text));
  }

  button(name, text, onclick) { return node('button', { type: 'button', name, onclick }, text); }

  // the distance is beside it, too, also for readers of the screen
  measureRow() {
    const { viewer } = this, button = this.button('measure', 'measure', () => viewer.toggleMeasure()), found = node('output');
    this.inputs.measure = () => {
      button.setAttribute('aria-pressed', viewer.measure.on);
      found.textContent = viewer.measure.text;
    };
    return node('div', { className: 'row' }, node('span', {}, 'distance'), button, found);
  }

  section() {
    const { run } = this.viewer, most = 200;
    const joints = run.head.joints.slice(0, most).map((joint, j) => [`joint ${j}`, joint.name]);
    return [
      this.select('section', 'section', [['none', 'none'], ['x', 'across x (east)'], ['y', 'across y (north)'], ['z', 'across z (up)'], ...joints]),
      this.slider('cutAt', 'its place', { min: 0, max: 1, step: 0.002 }, (v) => v, (x) => x, () => this.viewer.cutText()),
      this.check('cutOther', 'show the other side'),
    ];
  }

  timeBar() {
    const { run } = this.viewer;
    const input = node('input', { type: 'range', min: 0, max: run.frames.length - 1, step: 1, name: 'frame' });
    const play = this.button('play', '▶', () => this.viewer.play());
    const moment = node('output');
    input.setAttribute('aria-label', 'time');
    input.oninput = () => this.viewer.set({ frame: Number(input.value) });
    this.inputs.frame = () => {
      input.value = this.viewer.look.frame;
      moment.textContent = `${this.viewer.look.frame + 1} / ${run.frames.length}`;
      play.textContent = this.viewer.playing ? '❚❚' : '▶';
      play.setAttribute('aria-label', this.viewer.playing ? 'pause' : 'play');
    };
    return node('div', { className: 'time' }, play, input, moment);
  }

  // a set is shown or hidden by its box, and chosen by its name
  groups() {
    const { run, viewer } = { run: this.viewer.run, viewer: this.viewer };
    const list = node('fieldset', { className: 'groups' }, node('legend', {}, 'joint sets'));
    this.names = new Map();
    run.groups.forEach((group, g) => {
      if (!group.joints.length && g !== run.noJoint) return;
      const box = node('input', { type: 'checkbox', checked: true, name: `group ${g}` });
      box.setAttribute('aria-label', `show ${group.name}`);
      box.onchange = () => viewer.hide(g, !box.checked);
      const chip = node('i');
      chip.style.background = groupColour(run, g);
      const name = node('button', { type: 'button', className: 'name', dataset: { group: g }, onclick: () => viewer.choose(g) },
        chip, group.name);
      this.names.set(g, { box, name });
      list.append(node('div', { className: 'group' }, box, name));
    });
    list.append(this.check('showFixed', 'fixed blocks'), this.check('edges', 'edges'));
    this.inputs.groups = () => {
      for (const [g, { box, name }] of this.names) {
        box.checked = !viewer.look.hidden.has(g);
        name.setAttribute('aria-pressed', viewer.look.chosen === g);
      }
    };
    return list;
  }

  views() {
    const list = Object.entries(VIEWS).map(([name, [azimuth, height]]) =>
      this.button(`from ${name}`, name, () => this.viewer.lookFrom(azimuth, height)));
    const row = node('div', { className: 'buttons views' }, node('span', {}, 'from'), ...list);
    row.setAttribute('role', 'group');
    return row;
  }

  // the keyboard's equivalent of a click on a block: its number or name
  blockInput() {
    const input = node('input', { type: 'text', name: 'block', placeholder: 'number or name' });
    input.onchange = () => this.viewer.pickByName(input.value);
    this.inputs.block = () => {
      if (document.activeElement !== input) input.value = this.viewer.pickedName();
    };
    return this.row('block', input);
  }

  refresh() { for (const refresh of Object.values(this.inputs)) refresh(); }

  // a text, lines of [name, value], and a table
  showInfo({ title, text, lines, table } = {}) {
    this.info.replaceChildren();
    if (!title) return;
    this.info.append(node('h2', {}, title));
    if (text) this.info.append(node('p', {}, text));
    const list = node('dl');
    for (const [name, value] of lines) list.append(node('dt', {}, name), node('dd', {}, value));
    this.info.append(list);
    if (!table?.rows.length) return;
    const cells = (kind, row) => node('tr', {}, ...row.map((text) => node(kind, {}, text)));
    this.info.append(node('table', {}, node('thead', {}, cells('th', table.head)), node('tbody', {}, ...table.rows.map((row) => cells('td', row)))));
  }
}
