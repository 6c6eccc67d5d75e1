// Shows the surfaces of like paint of a scan without materials: a table, and a plan with their numbers.

import { h, svg, table } from './dom.js';
import { fixed, isNumber, plusMinus } from './format.js';
import { upwardFaces } from './plan.js';
import { swatch } from './record.js';

const kWidth = 300, kMargin = 16, kRadius = 9;

// Names the axis that a normal is nearest to.
function facing(normal) {
  if (normal === null) return 'several ways';
  const size = normal.map(Math.abs), k = size.indexOf(Math.max(...size)), isPositive = normal[k] > 0;
  return k === 2 ? (isPositive ? 'up' : 'down') : (isPositive ? '+' : '\u2212') + 'xy'[k];
}

// Returns places of the marks in pixels. A mark that would cover an earlier one moves to its right.
function places(surfaces, at) {
  const taken = [];
  return surfaces.map((s) => {
    let [x, y] = at(s.center_m);
    while (taken.some((t) => Math.hypot(t[0] - x, t[1] - y) < 2 * kRadius)) x += 2 * kRadius + 1;
    taken.push([x, y]);
    return [x, y];
  });
}

function plan(room, surfaces) {
  const { min_m: low, max_m: high } = room, scale = (kWidth - 2 * kMargin) / (high[0] - low[0]);
  const at = (p) => [kMargin + (p[0] - low[0]) * scale, kMargin + (high[1] - p[1]) * scale];
  const height = (high[1] - low[1]) * scale + 2 * kMargin, marked = surfaces.map((s, i) => ({ ...s, number: i + 1 })).filter((s) => s.normal !== null);
  const marks = places(marked, at).map(([x, y], i) => svg('g', null,
    svg('circle', { cx: x, cy: y, r: kRadius, fill: swatch(marked[i]), class: 'paint-mark' }),
    svg('text', { x, y: y + 4, 'text-anchor': 'middle', style: { fill: marked[i].albedo > 0.2 ? '#000' : '#fff' } }, marked[i].number)));
  const faces = upwardFaces(room).map(({ corners, height: z }) => svg('polygon', { points: corners.map((p) => at(p).map((v) => v.toFixed(1)).join(',')).join(' '), class: z > low[2] + 0.05 ? 'plan-furniture' : 'plan-floor' }));
  return h('figure', { class: 'plan-figure' }, svg('svg', { viewBox: `0 0 ${kWidth} ${height.toFixed(0)}`, class: 'chart plan', role: 'img', 'aria-label': 'Plan with the numbers of surfaces of like paint' }, faces, marks),
    h('figcaption', null, 'Plan: centres of the surfaces that face one way, by number.'));
}

// Returns nothing where the mesh has materials.
export function paints(data) {
  const { surfaces } = data.result;
  if (!surfaces) return null;
  return h('div', null, h('p', null, 'The mesh has no materials. Its surfaces of like paint, as far as photos show them, the largest first:'),
    h('div', { class: 'plan-and-schedule' }, data.room ? plan(data.room, surfaces) : null, table([
      { title: '', text: true, of: (s) => h('span', { class: 'swatch', style: { background: swatch(s) } }) },
      { title: 'Surface', text: true, of: (s) => s.name },
      { title: 'Reflectance, 95 %', of: (s) => plusMinus(s.albedo, s.sigma, 3) },
      { title: 'Red, green, blue', of: (s) => (Array.isArray(s.albedo_rgb) && s.albedo_rgb.every(isNumber) ? s.albedo_rgb.map((x) => fixed(x, 2)).join(', ') : '\u2013') },
      { title: 'Area', unit: 'm\u00b2', of: (s) => fixed(s.area_m2, 1) },
      { title: 'Centre', unit: 'm', of: (s) => s.center_m.map((x) => fixed(x, 2)).join(', ') },
      { title: 'Height', unit: 'm', of: (s) => s.height_m.map((x) => fixed(x, 2)).join(' to ') },
      { title: 'Faces', text: true, of: (s) => facing(s.normal) },
    ], surfaces)),
    h('p', null, 'The planes of the mesh, by which the light was fitted:'));
}
