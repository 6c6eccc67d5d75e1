// Draws polar light distribution curves: luminous intensity over gamma, in the planes C0-C180 and C90-C270.

import { niceStep } from './colour_scale.js';
import { h, svg } from './dom.js';
import { digits, isNumber } from './format.js';

const kSize = 300, kRadius = 118, kCentre = [150, 150];

// gamma = 0 points down; positive gamma to the right.
const place = (gammaDeg, share) => {
  const angle = (gammaDeg * Math.PI) / 180;
  return [kCentre[0] + share * kRadius * Math.sin(angle), kCentre[1] + share * kRadius * Math.cos(angle)];
};

function curve(values, top, attributes) {
  const step = 360 / (values.length - 1);
  const points = values.map((v, i) => place(-180 + i * step, v / top).map((x) => x.toFixed(1)).join(' '));
  return svg('path', { d: 'M' + points.join('L') + 'Z', fill: 'none', 'stroke-width': 2, ...attributes });
}

function web(top, step, unit) {
  const rings = [];
  for (let v = step; v <= top * 1.0001; v += step) {
    const r = (v / top) * kRadius;
    rings.push(svg('circle', { cx: kCentre[0], cy: kCentre[1], r, class: 'grid' }));
    rings.push(svg('text', { x: kCentre[0] + 3, y: kCentre[1] - r + 10, class: 'small' }, digits(v, 2), v + step > top * 1.0001 ? ' ' + unit : ''));
  }
  const spokes = [];
  for (let g = 0; g < 360; g += 30) {
    const [x, y] = place(g, 1), [tx, ty] = place(g, 1.1), shown = g > 180 ? 360 - g : g;
    spokes.push(svg('line', { x1: kCentre[0], y1: kCentre[1], x2: x, y2: y, class: 'grid' }));
    spokes.push(svg('text', { x: tx, y: ty + 4, 'text-anchor': 'middle', class: 'small' }, shown + '\u00b0'));
  }
  return [rings, spokes];
}

// Returns the gamma (degrees) beyond which an intensity stays below a value, linear between samples; null: none up to
// 180.
function halfAngle(values, value) {
  const last = values.length - 1, nadir = last / 2;
  let i = last;
  while (i >= nadir && values[i] < value) --i;
  if (i === last || i < nadir) return null;
  return -180 + ((i + (values[i] - value) / (values[i] - values[i + 1])) * 360) / last;
}

// Returns the luminaires whose curves differ by their flux alone, together.
export function alikeInShape(luminaires) {
  const shape = ({ curves }) => { const both = [...curves.c0, ...curves.c90], peak = Math.max(...both); return peak > 0 ? both.map((v) => v / peak) : null; };
  const groups = [];
  for (const luminaire of luminaires) {
    const own = luminaire.given ? null : shape(luminaire);
    const like = own && groups.find((g) => g.shape && g.shape.length === own.length && g.shape.every((v, i) => Math.abs(v - own[i]) < 0.005));
    if (like) like.luminaires.push(luminaire);
    else groups.push({ shape: own, luminaires: [luminaire] });
  }
  return groups.map((g) => g.luminaires);
}

// Draws one curve for luminaires that are alike in shape: the first one's.
export function polarCurve(group, unit) {
  const [luminaire] = group, { curves, given } = luminaire;
  const all = [...curves.c0, ...curves.c90, ...(given ? [...given.c0, ...given.c90] : [])];
  const highest = Math.max(...all);
  if (!(highest > 0)) return h('figure', { class: 'polar' }, h('figcaption', null, luminaire.id, ': no light'));
  const step = niceStep(highest / 4), top = step * Math.ceil(highest / step);
  const same = curves.c0.every((v, i) => Math.abs(v - curves.c90[i]) < 0.005 * highest);
  const key = [h('span', { class: 'key fitted0' }, same ? 'fitted, all C' : 'fitted C0\u2013C180')];
  if (!same) key.push(h('span', { class: 'key fitted90' }, 'fitted C90\u2013C270'));
  if (given) key.push(h('span', { class: 'key given' }, `given: ${given.file}, ${digits(given.flux_lm)} lm`));
  const peakOf = (l) => Math.max(...l.curves.c0, ...l.curves.c90), peak = peakOf(luminaire), peaks = group.map(peakOf);
  const shown = digits(Math.min(...peaks), 3) === digits(Math.max(...peaks), 3) ? digits(peak, 3) : `${digits(Math.min(...peaks), 3)} to ${digits(Math.max(...peaks), 3)}`;
  const half = halfAngle(curves.c0, 0.5 * peak);
  return h('figure', { class: 'polar' },
    svg('svg', { viewBox: `0 0 ${kSize} ${kSize}`, class: 'chart', role: 'img', 'aria-label': 'Polar curve of ' + luminaire.id }, web(top, step, unit),
      given ? [curve(given.c0, top, { class: 'given' }), curve(given.c90, top, { class: 'given' })] : null,
      same ? null : curve(curves.c90, top, { class: 'fitted90' }), curve(curves.c0, top, { class: 'fitted0' })),
    h('figcaption', null, h('b', null, group.map((l) => l.id).join(', ')), group.length > 1 ? `, drawn: ${luminaire.id}` : '', ' ', h('span', { class: 'interval' }, 'peak ', shown, ' ', unit,
      isNumber(half) ? `, half of it at ${Math.round(half)}\u00b0 in C0` : ''), h('div', { class: 'keys' }, key)));
}
