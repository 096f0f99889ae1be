// The overlay of the picture, also in its PNG: title and time, legend with units, scale bar, directions, stereonet.
import { digits, groupColour, listColour, PRESSED, PULLED, rampColour, ROCK, withUnit } from './colours.js';
import { boltColour } from './supports.js';
import { label, shortened, svg } from './svg.js';

const MOST_ROWS = 12;
const css = (c) => `rgb(${c.map((x) => Math.round(255 * x)).join(',')})`;

export class Overlay {
  constructor(net) {
    this.net = net;
    this.element = svg('svg', { class: 'overlay', role: 'group', 'aria-label': 'stereonet, legend and scale' });
    this.drawn = svg('g', { 'pointer-events': 'none' });
    this.element.append(this.drawn, net.element);
  }

  // A stereonet that would cover the legend is left out.
  fitInto(width, height) {
    const { radius, poles } = this.net;
    this.scale = width < 560 || height < 460 ? 0.72 : 1;
    this.showsNet = poles !== undefined && width > 400 && height > 230 + 2 * radius * this.scale;
    this.net.element.setAttribute('visibility', this.showsNet ? 'visible' : 'hidden');
  }
  get netWidth() { return this.showsNet ? 2 * this.net.radius * this.scale + 30 : 0; }

  // `scene`: size of the picture, m a pixel, axes of the camera, title, moment, legend, forces
  draw(scene) {
    const { width, height } = scene, net = this.net.element;
    this.element.setAttribute('width', width);
    this.element.setAttribute('height', height);
    this.element.setAttribute('viewBox', `0 0 ${width} ${height}`);
    const left = 16, bottom = height - 16, right = width - 16, R = this.net.radius * this.scale;
    const fitting = (text, pixels) => shortened(text, Math.max(12, Math.floor((width - left - 230) / pixels)));
    net.setAttribute('transform', `translate(${right - R - 8} ${bottom - R - 4}) scale(${this.scale})`);
    this.drawn.replaceChildren(
      label(left, 26, fitting(scene.title, 8.2), { 'font-size': 15 }),
      label(left, 45, fitting(scene.moment, 6.6)),
      ...(scene.magnified !== 1 || scene.since ? [label(left, 62, fitting(`displacements ${scene.magnified !== 1 ? `×${digits(scene.magnified)} ` : ''}${scene.since}`, 6.6))] : []),
      this.scaleBar(left, bottom, scene.perPixel),
      this.directions(left + 36, bottom - 62, scene),
      this.legend(right, 16, scene),
      ...(scene.measured ? [this.measured(scene)] : []),
    );
  }

  scaleBar(x, y, perPixel) {
    const wanted = 130 * perPixel, power = 10 ** Math.floor(Math.log10(wanted));
    const size = [5, 2, 1].find((n) => n * power <= wanted) * power, pixels = size / perPixel;
    return svg('g', { class: 'scale' },
      svg('path', { d: `M${x} ${y - 7}V${y}H${x + pixels}V${y - 7}`, fill: 'none', stroke: '#ffffff', 'stroke-width': 5 }),
      svg('path', { d: `M${x} ${y - 7}V${y}H${x + pixels}V${y - 7}`, fill: 'none', stroke: '#202020', 'stroke-width': 2 }),
      label(x + pixels + 8, y + 1, withUnit(size, 'm')));
  }

  // east, north and up as the camera sees them; x and y in the plane
  directions(x, y, { axes, plane }) {
    const names = plane ? ['x', 'y'] : ['E', 'N', 'up'], group = svg('g', { class: 'directions' });
    names.forEach((name, k) => {
      const u = 34 * axes.right.getComponent(k), v = -34 * axes.up.getComponent(k), size = Math.hypot(u, v);
      if (size < 6) return;
      const strong = name === 'N' || plane, colour = strong ? '#202020' : '#808080';
      const [p, q] = [u / size, v / size];
      group.append(svg('line', { x1: x, y1: y, x2: x + u, y2: y + v, stroke: colour, 'stroke-width': strong ? 2 : 1.3 }),
        svg('polygon', { fill: colour,
          points: `${x + u + 5 * p},${y + v + 5 * q} ${x + u - 4 * q},${y + v + 4 * p} ${x + u + 4 * q},${y + v - 4 * p}` }),
        label(x + u + 13 * p, y + v + 13 * q + 4, name, { 'text-anchor': 'middle', fill: colour, 'font-size': 11 }));
    });
    return group;
  }

  legend(x, y, { choice, legend, run, forces, supports }) {
    const group = svg('g', { class: 'legend' });
    let at = y + 12;
    const title = (text) => group.append(label(x, at, text, { 'text-anchor': 'end' }));
    if (legend) {
      title(choice.label);
      this.bar(group, x - 18, at + 10, choice, legend);
      at += 170;
    } else {
      const own = choice.legend?.();
      title(choice.label);
      if (own) {
        at += 16;
        group.append(label(x, at, own.note, { 'text-anchor': 'end', 'font-size': 11, fill: '#606060' }));
      }
      at = this.rows(group, x, at, own?.rows ?? rowsOf(run, choice), own ? 40 : 24) + 26;
    }
    for (const support of supports) {
      title(support.strip ?? support.measure);
      at = this.rows(group, x, support.strip ? this.strip(group, x, at, support) : this.length(group, x, at, support), support.rows, 40) + 26;
    }
    if (forces)
      for (const [text, colour] of [[forces.label, PRESSED], ...(forces.pulls ? [['pulling', PULLED]] : [])]) {
        group.append(svg('line', { x1: x - forces.pixels, x2: x, y1: at - 4, y2: at - 4, stroke: colour, 'stroke-width': forces.width }),
          label(x - forces.pixels - 6, at, text, { 'text-anchor': 'end' }));
        at += 18 + forces.width / 2;
      }
    return group;
  }

  // names with their colours; returns the last line
  rows(group, x, at, rows, most) {
    for (const [name, colour] of rows) {
      at += 18;
      group.append(svg('rect', { x: x - 14, y: at - 10, width: 14, height: 11, fill: colour, stroke: '#606060', 'stroke-width': 0.6 }),
        label(x - 20, at, shortened(name, most), { 'text-anchor': 'end' }));
    }
    return at;
  }

  // the colours of bolts, from 0
  strip(group, x, at, { high: [value, unit] }) {
    const wide = 90, steps = 45, text = withUnit(value, unit), left = x - wide - 8 - 7.5 * text.length;
    for (let i = 0; i < steps; ++i)
      group.append(svg('rect', { x: left + (i * wide) / steps, y: at + 8, width: wide / steps + 0.5, height: 11, fill: css(boltColour((i + 0.5) / steps)) }));
    group.append(svg('rect', { x: left, y: at + 8, width: wide, height: 11, fill: 'none', stroke: '#606060', 'stroke-width': 0.6 }),
      label(left - 5, at + 18, '0', { 'text-anchor': 'end' }), label(x, at + 18, text, { 'text-anchor': 'end' }));
    return at + 18;
  }

  // the length of a value in a diagram
  length(group, x, at, { value: [value, unit], pixels }) {
    group.append(svg('path', { d: `M${x} ${at + 9}v8M${x - pixels} ${at + 9}v8M${x} ${at + 13}h${-pixels}`, fill: 'none', stroke: '#202020', 'stroke-width': 1.5 }),
      label(x - pixels - 6, at + 17, withUnit(value, unit), { 'text-anchor': 'end' }));
    return at + 17;
  }

  // the line between two points with its length; before, the cross that Enter takes
  measured({ measured: { ends, text }, width, height }) {
    const group = svg('g', { class: 'measured' }), line = (d, stroke, wide) => group.append(svg('path', { d, fill: 'none', stroke, 'stroke-width': wide }));
    if (ends.length === 2) for (const [stroke, wide] of [['#ffffff', 5], ['#202020', 2]]) line(`M${ends.map((end) => end.join()).join('L')}`, stroke, wide);
    else for (const [stroke, wide] of [['#ffffff', 4], ['#202020', 1.5]]) line(`M${width / 2 - 9} ${height / 2}h18M${width / 2} ${height / 2 - 9}v18`, stroke, wide);
    for (const [cx, cy] of ends) group.append(svg('circle', { cx, cy, r: 4, fill: '#f0e442', stroke: '#202020', 'stroke-width': 1.5 }));
    if (text) group.append(label((ends[0][0] + ends[1][0]) / 2, Math.min(ends[0][1], ends[1][1]) - 10, text, { 'text-anchor': 'middle', 'font-size': 13 }));
    return group;
  }

  bar(group, x, y, choice, legend) {
    const tall = 130, steps = 65;
    for (let i = 0; i < steps; ++i)
      group.append(svg('rect', { x, y: y + (i * tall) / steps, width: 18, height: tall / steps + 0.5, fill: css(rampColour(1 - (i + 0.5) / steps)) }));
    group.append(svg('rect', { x, y, width: 18, height: tall, fill: 'none', stroke: '#606060' }));
    for (const t of legend.high > legend.low ? [0, 0.25, 0.5, 0.75, 1] : [0]) {
      const value = legend.logarithmic ? legend.low * (legend.high / legend.low) ** t : legend.low + t * (legend.high - legend.low);
      group.append(label(x - 6, y + (1 - t) * tall + 4, withUnit(value, choice.unit), { 'text-anchor': 'end' }));
    }
  }
}

function rowsOf(run, choice) {
  const rows = choice.label === 'joint properties'
    ? run.head.properties.map((p, i) => [p.name, listColour(i)])
    : run.groups.filter((group) => group.joints.length).map((group) => [group.name, groupColour(run, run.groups.indexOf(group))]);
  const shown = rows.slice(0, MOST_ROWS);
  if (rows.length > MOST_ROWS) shown.push([`and ${rows.length - MOST_ROWS} more`, 'none']);
  return [...shown, ['no joint', ROCK]];
}
