// Parallel projection, so that one scale holds for the entire picture. The eye orbits a target, z upwards; in the
// plane it looks straight down.
import { OrthographicCamera, Vector3 } from 'three';

const STEP = Math.PI / 36; // of a key
const degree = Math.PI / 180;

export class Camera {
  constructor(element, box, plane, changed) {
    Object.assign(this, { element, box, plane, changed });
    this.camera = new OrthographicCamera();
    this.target = new Vector3();
    this.pointers = new Map();
    this.look(plane ? -90 : -60, plane ? 90 : 24);
    this.fit(box);
    this.listen();
  }

  // direction to the eye, degrees from x (east) counter-clockwise, and above the horizontal
  look(azimuth, height) {
    this.azimuth = azimuth * degree;
    this.height = Math.max(-90, Math.min(90, height)) * degree;
  }

  axes() {
    const a = this.azimuth, h = this.height;
    const eye = new Vector3(Math.cos(h) * Math.cos(a), Math.cos(h) * Math.sin(a), Math.sin(h));
    const right = new Vector3(-Math.sin(a), Math.cos(a), 0);
    return { eye, right, up: new Vector3().crossVectors(eye, right) };
  }

  // an entire box, `times` as large, with a margin
  fit(box, times = 1) {
    const { right, up } = this.axes(), { low, high, centre } = box;
    const extent = (axis) => Math.abs(axis.x) * (high[0] - low[0]) + Math.abs(axis.y) * (high[1] - low[1]) + Math.abs(axis.z) * (high[2] - low[2]);
    const { clientWidth: w, clientHeight: h } = this.element, inset = this.inset ?? { left: 0, right: 0, top: 0, bottom: 0 };
    const wide = Math.max(80, w - inset.left - inset.right), tall = Math.max(80, h - inset.top - inset.bottom);
    this.perPixel = (1.06 * times * Math.max(extent(right) / wide, extent(up) / tall)) || 1;
    this.target.set(...centre);
    this.target.addScaledVector(right, ((inset.right - inset.left) / 2) * this.perPixel);
    this.target.addScaledVector(up, ((inset.top - inset.bottom) / 2) * this.perPixel);
    this.update();
  }

  update() {
    const { clientWidth: w, clientHeight: h } = this.element, { eye, up } = this.axes(), far = 20 * this.box.radius;
    const c = this.camera;
    c.left = (-w / 2) * this.perPixel;
    c.right = -c.left;
    c.top = (h / 2) * this.perPixel;
    c.bottom = -c.top;
    c.near = 0;
    c.far = 2 * far;
    c.up.copy(up);
    c.position.copy(this.target).addScaledVector(eye, far);
    c.lookAt(this.target);
    c.updateProjectionMatrix();
    c.updateMatrixWorld();
    this.changed();
  }

  // the line of sight through a pixel of the picture, from its upper left
  ray(x, y) {
    const { right, up, eye } = this.axes(), { clientWidth: w, clientHeight: h } = this.element;
    const from = this.target.clone().addScaledVector(right, (x - w / 2) * this.perPixel).addScaledVector(up, (h / 2 - y) * this.perPixel)
      .addScaledVector(eye, 20 * this.box.radius);
    return { from: from.toArray(), towards: eye.negate().toArray() };
  }

  turn(da, dh) {
    this.azimuth += da;
    this.height = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.height + dh));
    this.update();
  }

  pan(dx, dy) {
    const { right, up } = this.axes();
    this.target.addScaledVector(right, -dx * this.perPixel).addScaledVector(up, dy * this.perPixel);
    this.update();
  }

  // the point under (x, y), pixels from the middle, stays
  zoom(factor, x = 0, y = 0) {
    const before = this.perPixel, most = 100 * this.box.radius;
    this.perPixel = Math.min(most, Math.max(1e-9 * most, before * factor));
    const { right, up } = this.axes(), d = before - this.perPixel;
    this.target.addScaledVector(right, x * d).addScaledVector(up, -y * d);
    this.update();
  }

  listen() {
    const e = this.element;
    e.addEventListener('pointerdown', (event) => {
      e.setPointerCapture?.(event.pointerId);
      this.pointers.set(event.pointerId, event);
    });
    for (const gone of ['pointerup', 'pointercancel'])
      e.addEventListener(gone, (event) => this.pointers.delete(event.pointerId));
    e.addEventListener('pointermove', (event) => this.drag(event));
    e.addEventListener('contextmenu', (event) => event.preventDefault());
    e.addEventListener('wheel', (event) => {
      event.preventDefault();
      const box = e.getBoundingClientRect();
      this.zoom(Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) * 0.0015),
        event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2);
    }, { passive: false });
    e.addEventListener('keydown', (event) => this.key(event));
  }

  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
    this.pointers.set(event.pointerId, event);
    if (this.pointers.size === 2) {
      // two fingers: apart zooms, together moves
      const other = [...this.pointers.values()].find((p) => p.pointerId !== event.pointerId);
      const apart = (p) => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY) || 1;
      this.zoom(apart(before) / apart(event));
      this.pan(dx / 2, dy / 2);
    } else if (this.plane || event.shiftKey || event.buttons & 6) this.pan(dx, dy);
    else this.turn(-dx * 0.008, dy * 0.008);
  }

  key(event) {
    const side = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (side && (this.plane || event.shiftKey)) this.pan(-40 * side[0], 40 * side[1]);
    else if (side) this.turn(side[0] * STEP, side[1] * STEP);
    else if (event.key === '+' || event.key === '=') this.zoom(0.87);
    else if (event.key === '-') this.zoom(1.15);
    else return;
    event.preventDefault();
  }
}

// The direction from which the free faces of the free blocks are seen best: the side to which rock can move.
export function bestAzimuth(run, faces, normals, bodies) {
  const sum = [0, 0];
  faces.forEach((face, f) => {
    const shape = run.shapes[face.shape];
    if (face.joint >= 0 || !bodies.isShown(shape, 0) || bodies.isFixed(shape, run.frames.length - 1)) return;
    sum[0] += normals[f][0];
    sum[1] += normals[f][1];
  });
  const total = normals.reduce((t, n) => t + Math.hypot(...n), 0);
  if (Math.hypot(...sum) < 1e-3 * total) return -60;
  return Math.atan2(sum[1], sum[0]) / degree + 28;
}
