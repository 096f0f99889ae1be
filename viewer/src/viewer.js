// One picture of a run, a function of `look`, which controls, keys and the page's address change.
import { Color, LineSegments, Mesh, Scene, Vector3, WebGLRenderer, WebGLRenderTarget, LineBasicMaterial, LinearSRGBColorSpace } from 'three';
import { Bodies } from './bodies.js';
import { bestAzimuth, Camera } from './camera.js';
import { choices, FACE } from './choices.js';
import { digits, EDGE, frictionByFace, groupColour, listColour, rgb, withUnit } from './colours.js';
import { START, TRIAL, nameOf } from './data.js';
import { boxOf, edgeGeometry, faceGeometry, findInner, listFaces, polygonNormal } from './geometry.js';
import { describe } from './info.js';
import { keyTable } from './keys.js';
import { firstFrame, initialLook, readAddress } from './look.js';
import { cutMaterial, edgeMaterial, faceMaterial, listedColours, listTexture, pickMaterial, pieceMaterial, sharedUniforms } from './materials.js';
import { Measure, pointUnder } from './measure.js';
import { Overlay } from './overlay.js';
import { Panel } from './panel.js';
import { addArrows, addJointEdges, addNetwork, largestBetween, largestForce, Pieces } from './pieces.js';
import { cutGeometry, cutParts } from './section.js';
import { Stereonet } from './stereonet.js';
import { addSupport, supportLegends, supportsOf } from './supports.js';

// pixels: of the network's widest line, at most; of blocks, below which their edges fade
const WIDEST = 16, FULL_EDGES = 14;

// m: width of a block of median volume
function typicalSize(run) {
  const volumes = run.shapes.map((shape) => shape.volume).sort((a, b) => a - b);
  return volumes[volumes.length >> 1] ** (1 / run.head.dimension);
}

export class Viewer {
  constructor(element, run, address) {
    Object.assign(this, { element, run, plane: run.head.dimension === 2 });
    this.bodies = new Bodies(run);
    this.box = boxOf(run.shapes);
    this.box.radius ||= 1;
    this.bodies.centre = this.box.centre;
    findInner(run);
    this.faces = listFaces(run);
    this.normals = this.faces.map((face) => polygonNormal(run.shapes[face.shape].parts[face.part].points, face.corners));
    this.choices = choices(run, this.bodies);
    this.supports = supportsOf(run, largestForce(run));
    this.measure = new Measure(this);
    this.look = initialLook(run, this.supports);
    this.build();
    readAddress(this, address);
    this.update();
    this.fit();
    if (this.poster) this.writePoster(this.poster);
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.picture);
  }

  build() {
    const { run, element } = this;
    this.picture = document.createElement('div');
    this.picture.className = 'picture';
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setPixelRatio(window.devicePixelRatio || 1);
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'application');
    canvas.setAttribute('aria-label', 'blocks; arrow keys turn them, with shift they move them, + and - zoom');
    this.net = new Stereonet(run, (group) => this.choose(group));
    this.overlay = new Overlay(this.net);
    this.panel = new Panel(this);
    this.keys = keyTable();
    this.picture.append(canvas, this.overlay.element, this.keys);
    element.append(this.panel.element, this.picture, this.panel.time);
    this.blockSize = typicalSize(run);
    this.buildScene();
    this.camera = new Camera(canvas, this.box, this.plane, () => this.askDraw());
    if (!this.plane) this.camera.look(bestAzimuth(run, this.faces, this.normals, this.bodies), 24);
    this.listen(canvas);
    this.size();
  }

  buildScene() {
    const { run } = this;
    this.groups = listTexture(run.groups.length, { bytes: true });
    this.properties = listTexture(run.head.properties.length + 1, { bytes: true });
    run.head.properties.forEach((_, i) => this.properties.values.set([...rgb(listColour(i)).map((c) => 255 * c), 255], 4 * (i + 1)));
    this.properties.texture.needsUpdate = true;
    this.faceValues = listTexture(this.faces.length);
    this.uniforms = sharedUniforms(this.bodies, this.groups, this.properties, this.faceValues);
    this.uniforms.centre.value.set(...this.box.centre);
    const geometry = faceGeometry(run, this.faces);
    this.mesh = new Mesh(geometry, faceMaterial(this.uniforms));
    this.pickMesh = new Mesh(geometry, pickMaterial(this.uniforms));
    this.edges = new LineSegments(edgeGeometry(run), edgeMaterial(this.uniforms));
    this.cut = new Mesh(undefined, cutMaterial(this.uniforms));
    this.cutLines = new LineSegments(undefined, new LineBasicMaterial({ color: new Color().setRGB(...rgb(EDGE)) }));
    this.pieces = new Pieces(pieceMaterial(this.uniforms));
    this.scene = new Scene();
    this.scene.background = new Color(1, 1, 1);
    this.pickScene = new Scene();
    this.pickScene.background = new Color(0, 0, 0);
    this.pickScene.add(this.pickMesh);
    for (const object of [this.mesh, this.cut, this.cutLines, this.edges, this.pieces.mesh]) this.scene.add(object);
    for (const object of [this.mesh, this.pickMesh, this.cut, this.cutLines, this.edges]) object.frustumCulled = false;
    this.cut.visible = this.cutLines.visible = false;
  }

  // ---- changes of the look

  set(change) {
    Object.assign(this.look, change);
    this.update();
  }

  toggleMeasure(on) {
    this.measure.toggle(on);
    this.panel.refresh();
    this.askDraw();
  }

  hide(group, hidden) {
    if (hidden) this.look.hidden.add(group);
    else this.look.hidden.delete(group);
    this.update();
  }

  choose(group) { this.set({ chosen: this.look.chosen === group ? -1 : group }); }
  // the blocks fill the picture
  fit() {
    const { look, run, bodies } = this;
    const box = boxOf(run.shapes.filter((s) => bodies.isShown(s, look.frame) && (look.showFixed || !bodies.isFixed(s, look.frame))));
    if (run.shapes.length === 1) { // a single block may rotate freely
      box.low = box.centre.map((c) => c - box.radius);
      box.high = box.centre.map((c) => c + box.radius);
    }
    this.camera.fit(box.radius > 0 ? box : this.box, 1 + look.exploded);
  }
  lookFrom(azimuth, height) {
    this.camera.look(azimuth, height);
    this.fit();
  }

  play() {
    const { run, look } = this;
    if (this.playing) {
      clearInterval(this.playing);
      this.playing = 0;
    } else {
      // from the start, also from the first picture
      if ([firstFrame(run), run.frames.length - 1].includes(look.frame)) look.frame = 0;
      const pause = Math.min(500, Math.max(40, 6000 / run.frames.length));
      this.playing = setInterval(() => {
        if (look.frame + 1 >= run.frames.length) this.play();
        else this.set({ frame: look.frame + 1 });
      }, pause);
    }
    this.panel.refresh();
  }

  pick(shape, face = -1) { this.set({ shape, face }); }

  pickByName(text) {
    const wanted = text.trim(), { run, look } = this;
    const shown = (s) => this.bodies.isShown(s, look.frame);
    const found = run.shapes.findIndex((s) => shown(s) && (s.name === wanted || (wanted !== '' && String(s.body) === wanted)));
    this.pick(found);
  }

  pickedName() { return this.look.shape >= 0 ? nameOf(this.run, this.run.shapes[this.look.shape].body) : ''; }

  // ---- the picture

  update() {
    const { look, run, uniforms: u } = this, choice = this.choices[look.colour];
    if (this.bodies.since !== look.since) {
      this.bodies.setBase(look.since);
      this.choices.displacement.found = null;
    }
    this.legend = choice.range ? (choice.found ??= choice.range()) : null;
    choice.prepare?.(look.frame);
    if (choice.list) u.listed.value = listedColours(choice.list);
    this.bodies.setFrame(look.frame, choice.value ? (shape) => choice.value(shape, look.frame) : undefined);
    if (choice.mode === FACE) {
      frictionByFace(run, this.faces, look.frame, this.faceValues.values);
      this.faceValues.texture.needsUpdate = true;
    }
    run.groups.forEach((_, g) => {
      const alpha = look.hidden.has(g) ? 0 : g === run.noJoint ? 160 : 255;
      this.groups.values.set([...rgb(groupColour(run, g)).map((c) => 255 * c), alpha], 4 * g);
    });
    this.groups.texture.needsUpdate = true;
    u.magnified.value = look.magnified;
    u.exploded.value = look.exploded;
    u.mode.value = this.plane && choice.mode === FACE ? 0 : choice.mode;
    if (this.legend) Object.assign(u.low, { value: this.legend.low }), Object.assign(u.high, { value: this.legend.high });
    u.logarithmic.value = this.legend?.logarithmic ?? false;
    u.chosenGroup.value = this.plane ? -1 : look.chosen;
    u.picked.value = look.shape;
    u.showFixed.value = look.showFixed;
    // forces and bolts are inside of blocks
    const through = look.forces !== 'none' || run.frames[look.frame].support.count > 0;
    this.through = through;
    u.opacity.value = !through ? 1 : this.plane ? 0.5 : 0.28;
    this.mesh.material.depthWrite = !through;
    this.pieces.mesh.material.depthTest = !through;
    this.pieces.mesh.renderOrder = through ? 1 : 0;
    this.edges.visible = look.edges;
    this.updateCut(choice);
    this.updatePieces();
    this.net.show(look.chosen, look.face >= 0 ? this.faces[look.face].joint : -1);
    this.panel.refresh();
    this.panel.showInfo(look.shape >= 0 ? describe(this) : undefined);
    this.askDraw();
  }

  // unit normal and offset of the section; everything beyond is removed
  cutPlane() {
    const { look, box } = this, joint = look.section.match(/^joint (\d+)$/);
    const axis = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] }[look.section];
    const normal = joint ? this.run.head.joints[joint[1]].normal.slice() : axis;
    if (!normal) return null;
    const reach = normal.reduce((r, n, k) => r + 0.5 * Math.abs(n) * (box.high[k] - box.low[k]), 0);
    const middle = normal.reduce((r, n, k) => r + n * box.centre[k], 0);
    const stretched = reach * (1 + look.exploded);
    // a joint's own plane is in the middle of its slider
    const own = joint ? this.run.head.joints[joint[1]].offset : middle;
    const offset = own + (2 * look.cutAt - 1) * stretched * (joint ? 1 + Math.abs(own - middle) / reach : 1);
    return { normal, offset };
  }

  cutText() {
    const { look } = this, plane = this.cutPlane();
    if (!plane) return '';
    const k = 'xyz'.indexOf(look.section), { origin } = this.run.head;
    const place = k >= 0 ? plane.offset + origin[k] : 0;
    if (k >= 0) return `${look.section} = ${digits(Math.abs(place) < 1e-6 * this.box.radius ? 0 : place)} m`;
    const beyond = plane.offset - this.run.head.joints[look.section.slice(6)].offset;
    return Math.abs(beyond) < 1e-9 ? 'on the joint' : `${withUnit(Math.abs(beyond), 'm')} ${beyond > 0 ? 'above' : 'below'} it`;
  }

  updateCut(choice) {
    const { look, uniforms: u } = this, plane = this.cutPlane();
    this.cut.visible = this.cutLines.visible = plane !== null;
    if (!plane) return void u.cut.value.set(0, 0, 0, 1);
    const sign = look.cutOther ? -1 : 1, n = plane.normal;
    u.cut.value.set(...n.map((c) => sign * c), sign * plane.offset + 1e-6 * this.box.radius);
    const scene = { run: this.run, bodies: this.bodies, look, frame: look.frame, showFixed: look.showFixed };
    this.cutPolygons = cutParts(scene, n, plane.offset);
    const { faces, lines } = cutGeometry(this.cutPolygons, { ...scene, choice, legend: this.legend });
    this.cut.geometry.dispose();
    this.cutLines.geometry.dispose();
    this.cut.geometry = faces;
    this.cutLines.geometry = lines;
  }

  updatePieces() {
    const { look, run, pieces } = this;
    const scene = { run, bodies: this.bodies, look, frame: look.frame, faces: this.faces };
    pieces.clear();
    if (this.plane) {
      const colours = { choice: look.colour, values: this.faceValues.values, legend: this.legend };
      addJointEdges(pieces, { ...scene, colours, hidden: look.hidden, chosenGroup: look.chosen, showFixed: look.showFixed });
    }
    addSupport(pieces, run, look, this.supports);
    if (look.forces === 'arrows')
      addArrows(pieces, { ...scene, reach: 0.3 * this.box.radius * look.forceSize, picked: look.shape >= 0 ? run.shapes[look.shape] : null });
    if (look.forces === 'network') addNetwork(pieces, scene);
    pieces.show();
  }

  forcesLegend() {
    const { look, run, camera } = this;
    if (look.forces === 'none') return null;
    const network = look.forces === 'network', most = (this.most ??= {})[look.forces] ??= network ? largestBetween(run) : largestForce(run);
    if (most === 0) return { label: 'no forces', pixels: 0, width: 0 };
    const pulls = run.frames[look.frame].contacts.normal.some((n) => n < 0);
    if (network) return { label: withUnit(most, 'N'), pixels: 40, width: 1 + this.uniforms.widest.value, pulls };
    const reach = (0.3 * this.box.radius * look.forceSize) / camera.perPixel, scale = Math.min(1, 80 / reach);
    return { label: withUnit(most * scale, 'N'), pixels: reach * scale, width: 3, pulls };
  }

  // the stage at whose end displacements begin to count; empty: at the start
  sinceText() {
    const { run, look } = this;
    return look.since < 0 ? '' : `after stage ${run.head.stages[run.frames[look.since].stage]}`;
  }

  moment() {
    const { run, look } = this, frame = run.frames[look.frame], stage = run.head.stages[frame.stage] ?? '';
    if (frame.kind === START) return run.verdicts?.moment ?? 'at the start';
    if (frame.kind === TRIAL) return `stage ${stage}, trial ${frame.trial}, taken back`;
    return `stage ${stage}, t = ${digits(frame.time)} s`;
  }

  askDraw() {
    if (this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.draw();
    });
  }

  draw() {
    const { camera } = this, { right, up, eye } = camera.axes();
    this.uniforms.light.value.copy(eye).addScaledVector(up, 0.7).addScaledVector(right, -0.5).normalize();
    const block = this.blockSize / camera.perPixel;
    this.uniforms.widest.value = Math.min(WIDEST, 0.6 * block) * this.look.forceSize;
    this.edges.material.uniforms.edgeOpacity.value = Math.min(1, Math.max(0.12, block / FULL_EDGES)) * (this.through ? 0.6 : 1);
    this.renderer.render(this.scene, camera.camera);
    const { clientWidth: width, clientHeight: height } = this.picture;
    this.overlay.draw({ width, height, perPixel: camera.perPixel, axes: { right, up },
      plane: this.plane, title: this.run.head.title || '', moment: this.moment(), magnified: this.look.magnified, since: this.sinceText(),
      choice: this.choices[this.look.colour], legend: this.legend, run: this.run, forces: this.forcesLegend(),
      supports: supportLegends(this.run, this.look, this.supports, camera.perPixel), measured: this.measure.drawn });
  }

  size() {
    const { clientWidth: width, clientHeight: height } = this.picture;
    this.renderer.setSize(width, height, false);
    const ratio = this.renderer.getPixelRatio();
    this.uniforms.viewport.value.set(width, height);
    this.pickTarget?.dispose();
    this.pickTarget = new WebGLRenderTarget(Math.max(1, width * ratio), Math.max(1, height * ratio));
    // room for the overlay
    this.overlay.fitInto(width, height);
    if (this.camera) this.camera.inset = { left: 16, right: width > 400 ? Math.max(120, this.overlay.netWidth) : 8, top: 70, bottom: 56 };
    this.camera?.update();
  }

  resize() {
    this.size();
    this.draw();
  }

  // ---- picking

  listen(canvas) {
    let down = null;
    canvas.addEventListener('pointerdown', (event) => (down = [event.clientX, event.clientY]));
    canvas.addEventListener('pointerup', (event) => {
      if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 3) return;
      const box = canvas.getBoundingClientRect(), pixel = [event.clientX - box.left, event.clientY - box.top];
      if (this.measure.on) return this.measureAt(...pixel);
      const face = this.faceAt(...pixel);
      this.pick(face >= 0 ? this.faces[face].shape : -1, face);
    });
    this.picture.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.key === 'Escape') {
        this.toggleMeasure(false);
        this.set({ shape: -1, face: -1, chosen: -1 });
      } else if (event.key === 'm') this.toggleMeasure();
      else if (event.key === 'Enter' && this.measure.on && event.target === canvas) this.measureAt(canvas.clientWidth / 2, canvas.clientHeight / 2);
      else if (event.key === ' ' && event.target === canvas) this.play();
      else if (event.key === 'Home' && event.target === canvas) this.fit();
      else if (event.key === '?') this.keys.hidden = !this.keys.hidden;
      else return;
      event.preventDefault();
    });
  }

  measureAt(x, y) {
    this.measure.add(pointUnder(this, x, y));
    this.panel.refresh();
    this.askDraw();
  }

  // number of the face under a pixel of the picture, -1: none
  faceAt(x, y) {
    const { renderer, pickTarget } = this, ratio = renderer.getPixelRatio(), pixel = new Uint8Array(4);
    renderer.setRenderTarget(pickTarget);
    renderer.render(this.pickScene, this.camera.camera);
    renderer.readRenderTargetPixels(pickTarget, Math.floor(x * ratio), Math.floor(pickTarget.height - y * ratio), 1, 1, pixel);
    renderer.setRenderTarget(null);
    return pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
  }

  // ---- for others

  // positions of the corners of a body in a frame, world coordinates, m; as drawn
  positions(body, frame, magnified = 1) {
    const shape = this.run.shapes.find((s) => s.body === body && this.bodies.isShown(s, frame)), out = [0, 0, 0];
    const look = { magnified, exploded: 0 }, origin = [...this.run.head.origin, 0];
    return shape?.parts.map(({ points }) => Array.from({ length: points.length / 3 }, (_, i) =>
      this.bodies.place(shape, frame, ...points.subarray(3 * i, 3 * i + 3), look, out).map((c, k) => c + origin[k])));
  }

  // pixels of a point in model coordinates, from the picture's upper left
  project(point) {
    const p = new Vector3(...point).project(this.camera.camera), { clientWidth: w, clientHeight: h } = this.picture;
    return [((p.x + 1) / 2) * w, ((1 - p.y) / 2) * h];
  }

  // blocks and overlay
  async drawn() {
    const { picture, renderer } = this, ratio = renderer.getPixelRatio();
    this.draw();
    const canvas = document.createElement('canvas'), context = canvas.getContext('2d');
    canvas.width = renderer.domElement.width;
    canvas.height = renderer.domElement.height;
    context.drawImage(renderer.domElement, 0, 0);
    const image = new Image(), text = new XMLSerializer().serializeToString(this.overlay.element);
    image.src = URL.createObjectURL(new Blob([text], { type: 'image/svg+xml' }));
    await image.decode();
    context.scale(ratio, ratio);
    context.drawImage(image, 0, 0, picture.clientWidth, picture.clientHeight);
    URL.revokeObjectURL(image.src);
    return canvas;
  }

  async png() {
    const canvas = await this.drawn();
    return new Promise((done) => canvas.toBlob(done, 'image/png'));
  }

  // for poster.mjs, which reads it from the document
  async writePoster(type) {
    this.element.dataset.picture = (await this.drawn()).toDataURL(type, 1); // WebP without loss
  }

  async savePng() {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(await this.png());
    link.download = `${(this.run.head.title || 'blocks').replace(/[^\p{L}\p{N}]+/gu, '_').slice(0, 60)}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    this.saved = link.download;
  }

  close() {
    if (this.playing) this.play();
    this.observer.disconnect();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.element.replaceChildren();
    this.closed?.();
  }
}
