// Draws the room in three dimensions: cells in false colours, and everything that was found in it.
//
// Only the fronts of surfaces are drawn, so that one looks into the room from outside. Colours are those of
// the table of colour_scale.js, unlit and without tone mapping: a pixel has exactly the colour of its value.

import * as THREE from 'three';
import { OrbitControls } from 'three-examples/controls/OrbitControls.js';
import { cellCorners } from './data.js';

const kYellow = 0xffd54a, kBlue = 0x4aa8ff, kGreen = 0x35c46a;

function cellGeometry(room) {
  const corners = Array.from({ length: room.count }, (_, c) => cellCorners(room, c));
  const vertices = corners.reduce((n, c) => n + c.length, 0);
  const position = new Float32Array(3 * vertices), colour = new Uint8Array(3 * vertices);
  const firstVertex = new Uint32Array(room.count + 1);
  const triangles = corners.reduce((n, c) => n + c.length - 2, 0);
  const index = new Uint32Array(3 * triangles), cellOfTriangle = new Uint32Array(triangles);
  let v = 0, t = 0;
  corners.forEach((cell, c) => {
    firstVertex[c] = v;
    for (let i = 2; i < cell.length; ++i, ++t) {
      index.set([v, v + i - 1, v + i], 3 * t);
      cellOfTriangle[t] = c;
    }
    for (const p of cell) position.set(p, 3 * v++);
  });
  firstVertex[room.count] = v;
  const geometry = new THREE.BufferGeometry();
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  geometry.setAttribute('position', new THREE.BufferAttribute(position, 3));
  geometry.setAttribute('color', new THREE.BufferAttribute(colour, 3, true));
  return { geometry, firstVertex, cellOfTriangle, corners };
}

// Returns the outlines of facets where no neighbour in the same plane continues them.
function edgeLines(room) {
  const positions = [], seen = new Map();
  const key = (p) => p.map((x) => Math.round(1000 * x)).join(',');
  for (let f = 0; f < room.facets.count; ++f) {
    const c = room.corners.subarray(9 * f, 9 * f + 9), triangle = room.kinds[4 * f] === 1;
    const at = (a, b) => [0, 1, 2].map((x) => c[x] + a * c[3 + x] + b * c[6 + x]);
    const corners = triangle ? [at(0, 0), at(1, 0), at(0, 1)] : [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
    corners.forEach((p, i) => {
      const q = corners[(i + 1) % corners.length], name = [key(p), key(q)].sort().join(';');
      seen.set(name, { count: (seen.get(name)?.count || 0) + 1, triangle, ends: [p, q] });
    });
  }
  // The diagonal of two triangles of one wall is not an edge of the room; rectangles share the edges of a box.
  for (const { count, triangle, ends } of seen.values()) if (!(triangle && count === 2)) positions.push(...ends[0], ...ends[1]);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(positions), 3));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: 0xffffff, transparent: true, opacity: 0.22 }));
}

const vec = (v) => new THREE.Vector3(v[0], v[1], v[2]);

function lines(points, colour) {
  const geometry = new THREE.BufferGeometry().setFromPoints(points.map(vec));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: colour }));
}

function luminaireShape(luminaire) {
  const along = vec(luminaire.along), across = vec(luminaire.across), normal = along.clone().cross(across);
  let geometry;
  if (luminaire.shape === 'rectangle') geometry = new THREE.PlaneBufferGeometry(luminaire.size_m[0], luminaire.size_m[1]);
  else if (luminaire.shape === 'disc') geometry = new THREE.CircleBufferGeometry(luminaire.size_m[0] / 2, 40);
  else geometry = new THREE.SphereBufferGeometry(luminaire.shape === 'sphere' ? luminaire.size_m[0] / 2 : 0.04, 24, 16);
  const material = new THREE.MeshBasicMaterial({ color: kYellow, side: THREE.DoubleSide });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(along, across, normal));
  mesh.position.copy(vec(luminaire.position_m));
  return mesh;
}

function aimArrow(luminaire) {
  return new THREE.ArrowHelper(vec(luminaire.aim).normalize(), vec(luminaire.position_m), 0.45, kYellow, 0.12, 0.07);
}

function frustum(camera, depth) {
  const tip = camera.position_m, points = [];
  const far = camera.corners.map((d) => tip.map((x, i) => x + (depth * d[i])));
  far.forEach((p, i) => {
    points.push(tip, p);
    if (far.length > 1) points.push(p, far[(i + 1) % far.length]);
  });
  const group = new THREE.Group();
  group.add(lines(points, kBlue));
  const dot = new THREE.Mesh(new THREE.SphereBufferGeometry(0.03, 12, 8), new THREE.MeshBasicMaterial({ color: kBlue }));
  dot.position.copy(vec(tip));
  group.add(dot);
  return group;
}

function tagSquare(tag) {
  const [a, b, c, d] = tag.corners_m;
  return lines([a, b, b, c, c, d, d, a, a, c], 0xffffff);
}

export class RoomView {
  // Throws where the browser has no WebGL.
  constructor(data, container) {
    this.data = data;
    this.room = data.room;
    this.container = container;
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setClearColor(0x14161a, 1);
    this.canvas = this.renderer.domElement;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('tabindex', '0');
    this.canvas.setAttribute('aria-label', 'The room in false colours; drag to turn, wheel to come nearer, click to read a surface');
    container.append(this.canvas);
    this.camera = new THREE.PerspectiveCamera(42, 1, 0.05, Math.max(100, 10 * this.diagonal));
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.screenSpacePanning = true;
    this.controls.addEventListener('change', () => this.requestRender());
    this.labels = [];
    this.afterRender = [];
    this.layers = {};
    this.build();
    this.listen();
    this.look('outside');
  }

  build() {
    this.scene = new THREE.Scene();
    const cells = cellGeometry(this.room);
    Object.assign(this, { firstVertex: cells.firstVertex, cellOfTriangle: cells.cellOfTriangle, cellPoints: cells.corners });
    this.mesh = new THREE.Mesh(cells.geometry, new THREE.MeshBasicMaterial({ vertexColors: THREE.VertexColors, side: THREE.FrontSide }));
    this.scene.add(this.mesh);
    const { data } = this;
    this.addLayer('edges', [edgeLines(this.room)]);
    this.addLayer('luminaires', data.luminaires.flatMap((l) => [luminaireShape(l), aimArrow(l)]));
    this.addLayer('uncertainty', data.luminaires.map((l) => this.ellipsoid(l)).filter(Boolean));
    this.addLayer('cameras', data.cameras.map((c) => frustum(c, 0.45)));
    this.addLayer('tags', data.tags.map(tagSquare));
    this.pointMeshes = data.places.points.map((p) => {
      const dot = new THREE.Mesh(new THREE.SphereBufferGeometry(0.055, 16, 12), new THREE.MeshBasicMaterial({ color: kGreen }));
      dot.position.copy(vec(p.position_m));
      return dot;
    });
    this.addLayer('points', this.pointMeshes);
    this.selection = new THREE.LineLoop(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x00e5ff, depthTest: false }));
    this.selection.visible = false;
    this.selection.frustumCulled = false;
    this.scene.add(this.selection);
  }

  ellipsoid(luminaire) {
    if (!luminaire.ellipsoid) return null;
    const { semi_axes_m: semiAxes, axes } = luminaire.ellipsoid;
    const material = new THREE.MeshBasicMaterial({ color: 0xff5fa2, transparent: true, opacity: 0.45, depthWrite: false });
    const mesh = new THREE.Mesh(new THREE.SphereBufferGeometry(1, 24, 16), material);
    mesh.position.copy(vec(luminaire.position_m));
    mesh.setRotationFromMatrix(new THREE.Matrix4().makeBasis(...axes.map(vec)));
    mesh.userData.semiAxes = semiAxes.map((s) => Math.max(1e-5, s));
    mesh.scale.set(...mesh.userData.semiAxes);
    return mesh;
  }

  setExaggeration(factor) {
    for (const mesh of this.layers.uncertainty.children) mesh.scale.set(...mesh.userData.semiAxes.map((x) => factor * x));
    this.requestRender();
  }

  addLayer(name, objects) {
    const group = new THREE.Group();
    for (const object of objects) group.add(object);
    this.layers[name] = group;
    this.scene.add(group);
  }

  show(name, visible) {
    this.layers[name].visible = visible;
    this.requestRender();
  }

  addLabel(element, position, layer) {
    element.classList.add('label3d');
    this.container.append(element);
    this.labels.push({ element, position: vec(position), layer });
  }

  setValues(values, scale) {
    const attribute = this.mesh.geometry.getAttribute('color'), array = attribute.array;
    for (let c = 0; c < this.room.count; ++c) {
      const [r, g, b] = scale.colour(values[c]);
      for (let v = this.firstVertex[c]; v < this.firstVertex[c + 1]; ++v) {
        array[3 * v] = r;
        array[3 * v + 1] = g;
        array[3 * v + 2] = b;
      }
    }
    attribute.needsUpdate = true;
    this.requestRender();
  }

  setPointColours(colours) {
    this.pointMeshes.forEach((mesh, i) => mesh.material.color.set(colours[i]));
    this.requestRender();
  }

  get centre() {
    const { min_m: a, max_m: b } = this.room;
    return vec(a).add(vec(b)).multiplyScalar(0.5);
  }

  get diagonal() {
    return vec(this.room.max_m).distanceTo(vec(this.room.min_m));
  }

  // Looks from the nearest place from which the whole room is in the picture.
  lookAtWhole(direction) {
    const { min_m: a, max_m: b } = this.room;
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new THREE.Vector3(i & 1 ? a[0] : b[0], i & 2 ? a[1] : b[1], i & 4 ? a[2] : b[2]));
    const isInside = (p) => Math.max(Math.abs(p.x), Math.abs(p.y)) < 0.97 && p.z < 1;
    let near = 0, far = 8 * this.diagonal;
    for (let step = 0; step < 30; ++step) {
      const distance = 0.5 * (near + far);
      this.camera.position.copy(this.centre).addScaledVector(direction.clone().normalize(), distance);
      this.camera.lookAt(this.centre);
      this.camera.updateMatrixWorld();
      if (corners.every((c) => isInside(c.clone().project(this.camera)))) far = distance;
      else near = distance;
    }
  }

  // `from` is outside, top or the name of a view.
  look(from) {
    const view = this.data.cameras.find((c) => c.view === from);
    this.resize();
    this.controls.target.copy(this.centre);
    if (view) {
      this.camera.position.copy(vec(view.position_m));
      this.controls.target.copy(vec(view.position_m).add(vec(view.forward).multiplyScalar(0.15 * this.diagonal)));
    } else {
      this.lookAtWhole(from === 'top' ? new THREE.Vector3(0, -0.001, 1) : new THREE.Vector3(-0.42, -0.72, 0.62));
    }
    this.controls.update();
    this.camera.updateMatrixWorld();
    this.requestRender();
  }

  resize() {
    const width = Math.max(1, this.container.clientWidth), height = Math.max(1, this.container.clientHeight);
    if (width === this.width && height === this.height) return;
    Object.assign(this, { width, height });
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  requestRender() {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = null;
      this.render();
    });
  }

  render() {
    this.resize();
    this.renderer.render(this.scene, this.camera);
    for (const { element, position, layer } of this.labels) {
      const p = position.clone().project(this.camera);
      const visible = this.layers[layer].visible && p.z < 1 && Math.abs(p.x) < 1 && Math.abs(p.y) < 1;
      element.style.display = visible ? '' : 'none';
      element.style.transform = `translate(${(0.5 + 0.5 * p.x) * this.width}px, ${(0.5 - 0.5 * p.y) * this.height}px)`;
    }
    for (const listener of this.afterRender) listener();
  }

  // Returns the present picture, for the printed page.
  snapshot() {
    this.render();
    const copy = document.createElement('canvas'), pen = copy.getContext('2d'), ratio = this.renderer.getPixelRatio();
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    pen.drawImage(this.canvas, 0, 0);
    pen.font = `600 ${13 * ratio}px system-ui, sans-serif`;
    pen.lineWidth = 3 * ratio;
    pen.strokeStyle = '#000a';
    for (const { element, position } of this.labels) {
      if (element.style.display === 'none') continue;
      const p = position.clone().project(this.camera);
      const at = [((0.5 + 0.5 * p.x) * this.width + 7) * ratio, ((0.5 - 0.5 * p.y) * this.height - 6) * ratio];
      pen.fillStyle = getComputedStyle(element).color;
      pen.strokeText(element.textContent, ...at);
      pen.fillText(element.textContent, ...at);
    }
    return copy.toDataURL('image/jpeg', 0.92);
  }

  // Returns the cell and the point under a place of the canvas (CSS pixels).
  pick(x, y) {
    const pointer = new THREE.Vector2((2 * x) / this.width - 1, 1 - (2 * y) / this.height);
    const caster = new THREE.Raycaster();
    caster.setFromCamera(pointer, this.camera);
    const [hit] = caster.intersectObject(this.mesh);
    return hit ? { cell: this.cellOfTriangle[hit.faceIndex], point: hit.point.toArray() } : null;
  }

  select(cell) {
    this.selection.visible = cell !== null;
    if (cell !== null) this.selection.geometry.setFromPoints(this.cellPoints[cell].map(vec));
    this.requestRender();
  }

  listen() {
    let down = null;
    this.canvas.addEventListener('pointerdown', (e) => { down = [e.clientX, e.clientY]; });
    this.canvas.addEventListener('pointerup', (e) => {
      if (!down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 5) return;
      const box = this.canvas.getBoundingClientRect();
      this.onPick?.(this.pick(e.clientX - box.left, e.clientY - box.top));
    });
    if (window.ResizeObserver) new ResizeObserver(() => this.requestRender()).observe(this.container);
  }

  // Returns the colours drawn at places of the canvas (CSS pixels); draws and reads them in one step.
  pixelsAt(places) {
    this.renderer.render(this.scene, this.camera);
    const gl = this.renderer.getContext(), ratio = this.renderer.getPixelRatio(), pixel = new Uint8Array(4);
    const height = this.canvas.height;
    return places.map(([x, y]) => {
      gl.readPixels(Math.floor(x * ratio), height - 1 - Math.floor(y * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      return [pixel[0], pixel[1], pixel[2]];
    });
  }

  // Returns the place of a cell's middle on the canvas (CSS pixels).
  placeOf(cell) {
    const points = this.cellPoints[cell];
    const p = points.reduce((sum, q) => sum.add(vec(q)), new THREE.Vector3()).divideScalar(points.length).project(this.camera);
    return [(0.5 + 0.5 * p.x) * this.width, (0.5 - 0.5 * p.y) * this.height];
  }
}
