// Draws the dimensioned plan: floor and furniture from above, luminaires with their openings, the meter's points,
// and distances in metres from the walls.

import { h, svg } from './dom.js';
import { facetNormal } from './data.js';
import { fixed } from './format.js';

const kWidth = 420, kLeft = 46, kRight = 46, kTop = 42, kBottom = 52;
const kStackPx = 26;  // numbers closer than this would overlap

function facetCorners(room, facet) {
  const c = room.corners, at = 9 * facet, point = (a, b) => [0, 1, 2].map((i) => c[at + i] + a * c[at + 3 + i] + b * c[at + 6 + i]);
  return room.kinds[4 * facet] === 1 ? [point(0, 0), point(1, 0), point(0, 1)] : [point(0, 0), point(1, 0), point(1, 1), point(0, 1)];
}

// Returns the faces that look up, the lowest first, with the height of each.
export function upwardFaces(room) {
  const faces = [];
  for (let f = 0; f < room.facets.count; ++f) {
    if (facetNormal(room, f)[2] < 0.7) continue;
    const corners = facetCorners(room, f);
    faces.push({ corners, height: Math.max(...corners.map((p) => p[2])) });
  }
  return faces.sort((a, b) => a.height - b.height);
}

// Returns the edges that belong to one face of a height alone: outlines without the joints of triangles.
function outlines(faces) {
  const edges = new Map(), name = (p) => p.map((x) => Math.round(1000 * x)).join(' ');
  for (const { corners } of faces) corners.forEach((a, i) => {
    const b = corners[(i + 1) % corners.length], key = [name(a), name(b)].sort().join('|');
    edges.set(key, edges.has(key) ? null : [a, b]);
  });
  return [...edges.values()].filter(Boolean);
}

// Returns coordinates without those that differ by less than a centimetre.
function distinct(values) {
  return values.sort((a, b) => a - b).filter((v, i, all) => i === 0 || v - all[i - 1] > 0.01);
}

// Draws marks along an edge at distances from its wall; `place` turns a coordinate into pixels along the edge. Every
// second of crowded numbers moves outwards.
function ordinates(values, origin, place, mark) {
  let last = -Infinity, isOut = false;
  return distinct(values).map((v) => {
    const at = place(v);
    isOut = Math.abs(at - last) < kStackPx && !isOut;
    last = at;
    return mark(at, fixed(v - origin, 2), isOut ? 12 : 0);
  });
}

function luminaireMark(luminaire, at, scale) {
  const [x, y] = at(luminaire.position_m), half = luminaire.size_m.map((m) => Math.max(3, (m * scale) / 2)), { along: a, across: b } = luminaire;
  const corner = ([p, q]) => [x + p * half[0] * a[0] + q * half[1] * b[0], y - p * half[0] * a[1] - q * half[1] * b[1]].map((v) => v.toFixed(1)).join(',');
  return svg('g', { class: 'plan-luminaire' },
    luminaire.shape === 'rectangle' ? svg('polygon', { points: [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(corner).join(' ') }) : svg('circle', { cx: x, cy: y, r: half[0] || 4 }),
    svg('text', { x: x + (half[0] || 4) + 4, y: y + 4 }, luminaire.id));
}

export function dimensionedPlan(data) {
  const { room } = data, { min_m: low, max_m: high } = room, scale = (kWidth - kLeft - kRight) / (high[0] - low[0]);
  const height = (high[1] - low[1]) * scale, at = (p) => [kLeft + (p[0] - low[0]) * scale, kTop + (high[1] - p[1]) * scale];
  const [left, bottom] = at(low), [right, top] = at(high), faces = upwardFaces(room);
  const line = ([a, b]) => { const [x1, y1] = at(a), [x2, y2] = at(b); return svg('line', { x1, y1, x2, y2 }); };
  const lamps = data.luminaires.map((l) => l.position_m);
  const above = ordinates(lamps.map((p) => p[0]), low[0], (v) => at([v, 0])[0], (x, text, out) => [svg('line', { x1: x, x2: x, y1: top - 4, y2: top - 12 - out, class: 'tick' }),
    svg('text', { x, y: top - 15 - out, 'text-anchor': 'middle' }, text)]);
  const beside = ordinates(lamps.map((p) => p[1]), low[1], (v) => at([0, v])[1], (y, text, out) => [svg('line', { x1: right + 4, x2: right + 9, y1: y, y2: y, class: 'tick' }),
    svg('text', { x: right + 12, y: y + 4 - out / 2 }, text)]);
  const span = (x1, y1, x2, y2) => svg('path', { class: 'tick', fill: 'none', d: x1 === x2 ? `M${x1 - 4} ${y1}h8M${x1} ${y1}V${y2}M${x1 - 4} ${y2}h8` : `M${x1} ${y1 - 4}v8M${x1} ${y1}H${x2}M${x2} ${y1 - 4}v8` });
  const picture = svg('svg', { viewBox: `0 0 ${kWidth} ${(height + kTop + kBottom).toFixed(0)}`, class: 'chart plan', role: 'img', 'aria-label': 'Plan of the room with dimensions' },
    faces.map(({ corners, height: z }) => svg('polygon', { points: corners.map((p) => at(p).map((v) => v.toFixed(1)).join(',')).join(' '), class: z > low[2] + 0.05 ? 'plan-furniture' : 'plan-floor' })),
    svg('g', { class: 'plan-edge' }, outlines(faces.filter((f) => f.height > low[2] + 0.05)).map(line)), svg('g', { class: 'plan-wall' }, outlines(faces.filter((f) => f.height <= low[2] + 0.05)).map(line)),
    data.places.points.map((p) => { const [x, y] = at(p.position_m); return svg('path', { class: 'plan-point', d: `M${x - 4} ${y}h8M${x} ${y - 4}v8` }); }),
    data.luminaires.map((l) => luminaireMark(l, at, scale)), above, beside,
    span(left, bottom + 18, right, bottom + 18), svg('text', { x: (left + right) / 2, y: bottom + 34, 'text-anchor': 'middle', class: 'axis' }, fixed(high[0] - low[0], 2) + ' m'),
    span(left - 18, top, left - 18, bottom), svg('text', { transform: `translate(${left - 25} ${(top + bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle', class: 'axis' }, fixed(high[1] - low[1], 2) + ' m'));
  return h('figure', { class: 'plan-figure' }, picture, h('figcaption', null, `Plan, ${fixed(high[2] - low[2], 2)} m high. Places of luminaires in m from the left (x) and the lower wall (y)` +
    (data.places.points.length > 0 ? '; crosses: the meter\u2019s points.' : '.')));
}
