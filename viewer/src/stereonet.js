// Poles of the joints on the lower hemisphere in equal-area projection; in the plane their traces, as directions. A pole
// chooses its set, and a face that is picked rings its pole.
import { groupColour } from './colours.js';
import { onNet, planeOf, poleWith } from './report/net.js';
import { label, shortened, svg } from './svg.js';

const MOST_LABELS = 8, MOST_POLES = 2000;
const degrees = 180 / Math.PI;

const two = (x, n) => String(x).padStart(n, '0');
export function orientationText(joint, plane) {
  if (plane) {
    const [x, y] = joint.normal, trace = (Math.atan2(x, -y) * degrees + 360) % 180;
    return `trace at ${Math.round(trace)}°`;
  }
  const { dip, direction } = planeOf(poleWith(joint.normal));
  return `${two(Math.round(dip), 2)}°/${two(Math.round(direction) % 360, 3)}°`;
}

// of planes, whose normals have no sign
function meanNormal(normals) {
  const [first] = normals, sum = [0, 0, 0];
  for (const n of normals) {
    const sign = n[0] * first[0] + n[1] * first[1] + n[2] * first[2] < 0 ? -1 : 1;
    n.forEach((c, k) => (sum[k] += sign * c));
  }
  const size = Math.hypot(...sum) || 1;
  return sum.map((c) => c / size);
}

export class Stereonet {
  constructor(run, choose) {
    this.run = run;
    this.choose = choose;
    this.radius = 74;
    this.element = svg('g', { class: 'net' });
    this.plane = run.head.dimension === 2;
    if (run.head.joints.length) this.draw();
  }

  draw() {
    const R = this.radius, { run } = this;
    this.element.append(svg('circle', { r: R, fill: '#ffffff', 'fill-opacity': 0.9, stroke: '#606060' }));
    for (const [x, y] of [[0, 1], [1, 0], [0, -1], [-1, 0]])
      this.element.append(svg('line', { x1: x * R, y1: y * R, x2: x * (R - 5), y2: y * (R - 5), stroke: '#606060' }));
    this.element.append(svg('path', { d: 'M-3 0H3M0 -3V3', stroke: '#a0a0a0' }));
    if (!this.plane) this.element.append(label(0, -R - 5, 'N', { 'text-anchor': 'middle' }));
    this.circle = svg('polyline', { fill: 'none', 'stroke-width': 1.6 });
    this.element.append(this.circle);
    this.poles = new Map();
    // of very many joints at regular intervals, and the first of each set
    const every = Math.ceil(run.head.joints.length / MOST_POLES);
    run.head.joints.forEach((joint, j) => {
      if (j % every === 0 || run.groups[joint.group].joints[0] === j) this.addPole(joint, j);
    });
    this.ring = svg('circle', { r: 8.5, fill: 'none', stroke: '#202020', 'stroke-width': 2, visibility: 'hidden' });
    this.element.append(this.ring);
    this.nameGroups();
  }

  at(joint) {
    const [x, y] = this.plane ? [-joint.normal[1], joint.normal[0]] : onNet(poleWith(joint.normal));
    return [x * this.radius, -y * this.radius];
  }

  addPole(joint, j) {
    const [x, y] = this.at(joint), few = this.run.head.joints.length < 60;
    const colour = groupColour(this.run, joint.group);
    const pole = this.plane
      ? svg('line', { x1: -x, y1: -y, x2: x, y2: y, stroke: colour, 'stroke-width': few ? 4 : 1.5 })
      : svg('circle', { cx: x, cy: y, r: few ? 5 : 2.6, fill: colour, stroke: '#ffffff', 'stroke-width': few ? 1 : 0.4 });
    const group = this.run.groups[joint.group];
    pole.dataset.joint = j;
    pole.append(svg('title', {}, `${joint.name}, ${orientationText(joint, this.plane)}`));
    pole.classList.add('pole');
    // one stop of the tabulator for each set
    if (group.joints[0] === j) {
      pole.setAttribute('tabindex', 0);
      pole.setAttribute('role', 'button');
      pole.setAttribute('aria-label', `choose ${group.name}`);
      pole.addEventListener('keydown', (event) => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        this.choose(joint.group, j);
      });
    }
    pole.addEventListener('click', () => this.choose(joint.group, j));
    this.poles.set(j, pole);
    this.element.append(pole);
  }

  nameGroups() {
    const { joints } = this.run.head, groups = this.run.groups.filter((group) => group.joints.length && !joints[group.joints[0]].holds);
    if (groups.length > MOST_LABELS) return;
    const named = [];
    for (const group of groups) {
      const [x, y] = this.at({ normal: meanNormal(group.joints.map((j) => joints[j].normal)) });
      if (named.some(([u, v]) => Math.abs(u - x) < 30 && Math.abs(v - y) < 11)) continue;
      named.push([x, y]);
      const right = x < 20;
      this.element.append(label(x + (right ? 9 : -9), y + (this.plane ? 4 : 13), shortened(group.name, 14),
        { 'font-size': 11, 'text-anchor': right ? 'start' : 'end', 'pointer-events': 'none' }));
    }
  }

  // the chosen group, the joint of a face that is picked
  show(group, joint) {
    if (!this.poles) return;
    for (const [j, pole] of this.poles) {
      const own = this.run.head.joints[j].group;
      pole.setAttribute('opacity', group < 0 || own === group ? 1 : 0.25);
      pole.toggleAttribute('data-chosen', own === group);
    }
    const shown = joint >= 0 ? this.run.head.joints[joint] : null;
    this.ring.setAttribute('visibility', shown ? 'visible' : 'hidden');
    if (shown) {
      const [x, y] = this.at(shown);
      this.ring.setAttribute('cx', x);
      this.ring.setAttribute('cy', y);
    }
    this.showCircle(group, shown);
  }

  // the great circle of a joint that is picked, or of a set of one joint
  showCircle(group, joint) {
    const alone = group >= 0 && this.run.groups[group].joints.length === 1 ? this.run.head.joints[this.run.groups[group].joints[0]] : null;
    const of = this.plane ? null : joint ?? alone;
    this.circle.setAttribute('visibility', of ? 'visible' : 'hidden');
    if (!of) return;
    const [x, y, z] = of.normal, across = Math.hypot(x, y);
    const strike = across > 0 ? [-y / across, x / across, 0] : [1, 0, 0];
    // down the dip: normal to both
    const dip = [strike[1] * z, -strike[0] * z, strike[0] * y - strike[1] * x];
    const points = [];
    for (let i = 0; i <= 60; ++i) {
      const a = (i / 60) * Math.PI, sign = dip[2] > 0 ? -1 : 1;
      const [u, v] = onNet(strike.map((s, k) => s * Math.cos(a) + sign * dip[k] * Math.sin(a)).map((c, k) => (k === 2 ? Math.min(c, -1e-9) : c)));
      points.push(`${(u * this.radius).toFixed(1)},${(-v * this.radius).toFixed(1)}`);
    }
    this.circle.setAttribute('points', points.join(' '));
    this.circle.setAttribute('stroke', groupColour(this.run, of.group));
  }
}
