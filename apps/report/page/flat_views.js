// Draws the room without WebGL, and on paper: floor plan, ceiling and walls, each seen frontally, in the same
// colours.

import { cellCorners, facetNormal } from './data.js';
import { h } from './dom.js';
import { fixed } from './format.js';

// `right` and `up` are axes of the picture; `towards` is the direction of view.
const kViews = [
  { name: 'Floor and furniture, from above', right: [1, 0, 0], up: [0, 1, 0], towards: [0, 0, -1], isPlan: true },
  { name: 'Ceiling, from below', right: [1, 0, 0], up: [0, -1, 0], towards: [0, 0, 1] },
  { name: 'Looking along +y', right: [1, 0, 0], up: [0, 0, 1], towards: [0, 1, 0] },
  { name: 'Looking along \u2212y', right: [-1, 0, 0], up: [0, 0, 1], towards: [0, -1, 0] },
  { name: 'Looking along +x', right: [0, -1, 0], up: [0, 0, 1], towards: [1, 0, 0] },
  { name: 'Looking along \u2212x', right: [0, 1, 0], up: [0, 0, 1], towards: [-1, 0, 0] },
];

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// Returns the cells that face the eye, the farthest first.
function cellsOf(room, view) {
  const facing = Array.from({ length: room.facets.count }, (_, f) => dot(facetNormal(room, f), view.towards) < -0.3);
  const cells = [];
  for (let c = 0; c < room.count; ++c) {
    if (!facing[room.facetOf[c]]) continue;
    const corners = cellCorners(room, c);
    cells.push({ cell: c, depth: Math.max(...corners.map((p) => dot(p, view.towards))),
      points: corners.map((p) => [dot(p, view.right), dot(p, view.up)]) });
  }
  return cells.sort((a, b) => b.depth - a.depth);
}

class FlatView {
  constructor(data, view) {
    this.data = data;
    this.view = view;
    this.cells = cellsOf(data.room, view);
    const box = [[Infinity, Infinity], [-Infinity, -Infinity]];
    const { min_m: a, max_m: b } = data.room;
    for (const p of [a, b]) {
      const q = [dot(p, view.right), dot(p, view.up)];
      for (const i of [0, 1]) {
        box[0][i] = Math.min(box[0][i], q[i]);
        box[1][i] = Math.max(box[1][i], q[i]);
      }
    }
    this.box = box;
    this.size = [box[1][0] - box[0][0], box[1][1] - box[0][1]];
    this.canvas = h('canvas', { role: 'img', 'aria-label': view.name });
    this.element = h('figure', { class: 'flat' }, this.canvas, h('figcaption', null, view.name));
  }

  draw(values, scale, pixelsPerMetre, pointColours) {
    const canvas = this.canvas, s = pixelsPerMetre;
    canvas.width = Math.max(1, Math.round(this.size[0] * s));
    canvas.height = Math.max(1, Math.round(this.size[1] * s));
    const pen = canvas.getContext('2d'), at = ([x, y]) => [(x - this.box[0][0]) * s, (this.box[1][1] - y) * s];
    pen.fillStyle = '#14161a';
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.lineWidth = 0.8;
    for (const { cell, points } of this.cells) {
      pen.beginPath();
      points.forEach((p, i) => (i === 0 ? pen.moveTo(...at(p)) : pen.lineTo(...at(p))));
      pen.closePath();
      pen.fillStyle = pen.strokeStyle = scale.css(values[cell]);
      pen.fill();
      pen.stroke();
    }
    if (this.view.isPlan) this.drawFound(pen, at, s, pointColours);
  }

  drawFound(pen, at, s, pointColours) {
    const project = (p) => at([dot(p, this.view.right), dot(p, this.view.up)]);
    pen.font = `600 ${Math.max(11, 0.13 * s)}px system-ui, sans-serif`;
    pen.lineWidth = 2;
    for (const luminaire of this.data.luminaires) {
      const [x, y] = project(luminaire.position_m), half = luminaire.size_m.map((m) => Math.max(5, (m * s) / 2));
      pen.strokeStyle = '#ffd54a';
      pen.beginPath();
      if (luminaire.shape === 'rectangle') {
        const [a, b] = [luminaire.along, luminaire.across];
        [[1, 1], [-1, 1], [-1, -1], [1, -1]].forEach(([p, q], i) => {
          const corner = [x + p * half[0] * a[0] + q * half[1] * b[0], y - p * half[0] * a[1] - q * half[1] * b[1]];
          if (i === 0) pen.moveTo(...corner); else pen.lineTo(...corner);
        });
        pen.closePath();
      } else {
        pen.arc(x, y, half[0], 0, 2 * Math.PI);
      }
      pen.stroke();
      this.write(pen, luminaire.id, x + 6, y - 6, '#ffd54a');
    }
    this.data.places.points.forEach((point, i) => {
      const [x, y] = project(point.position_m);
      pen.fillStyle = pointColours[i];
      pen.strokeStyle = '#fff';
      pen.lineWidth = 1.5;
      pen.beginPath();
      pen.arc(x, y, Math.max(4, 0.05 * s), 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    });
  }

  write(pen, text, x, y, colour) {
    pen.save();
    pen.lineWidth = 3;
    pen.strokeStyle = 'rgba(0,0,0,0.7)';
    pen.strokeText(text, x, y);
    pen.fillStyle = colour;
    pen.fillText(text, x, y);
    pen.restore();
  }
}

export class FlatViews {
  constructor(data) {
    this.views = kViews.map((view) => new FlatView(data, view));
    // All views have one scale; a page is about 1100 pixels wide.
    this.pixelsPerMetre = Math.min(160, 1000 / Math.max(...this.views.map((v) => v.size[0])));
    const longest = Math.max(...this.views.map((v) => v.size[0]));
    this.element = h('div', { class: 'flats' }, this.views.map((v) => {
      v.element.style.flexBasis = `${(46 * v.size[0]) / longest}%`;
      return v.element;
    }));
    const size = data.room.max_m.map((x, i) => x - data.room.min_m[i]);
    this.caption = `The room is ${fixed(size[0], 2)} m \u00d7 ${fixed(size[1], 2)} m \u00d7 ${fixed(size[2], 2)} m; all views are to one scale.`;
  }

  draw(values, scale, pointColours) {
    for (const view of this.views) view.draw(values, scale, this.pixelsPerMetre, pointColours);
  }
}
