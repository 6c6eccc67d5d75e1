// Lists the unified glare ratings of the observers under the present dimming.

import { h, replace, table } from './dom.js';
import { digits, fixed, isNumber, kNone, vector } from './format.js';
import { glare, verdict } from './light.js';
import { badge } from './work_plane.js';

// CIE 117 applies to sources between these solid angles, sr.
const kSmallest = 0.0003, kLargest = 0.1;

// Returns the rating's sigma from the flux's scale, common to sources and background: 8/ln 10 times its relative sigma.
function ratingSigma(data, dimming) {
  const shares = data.result.luminaires.filter((l, k) => dimming[k] > 0).map((l) => (isNumber(l.flux_sigma_lm) && l.flux_lm > 0 ? l.flux_sigma_lm / l.flux_lm : null));
  if (shares.length === 0 || shares.some((s) => s === null)) return null;
  return (8 / Math.LN10) * Math.max(...shares);
}

function notes(data, light, rated) {
  const points = data.luminaires.filter((l, k) => rated.some((r) => r.points && r.points.includes(k))).map((l) => l.id);
  const seen = rated.flatMap((r) => r.observer.sources.filter((s, k) => light.dimming[k] > 0 && s.sum > 0).map((s) => s.solid_angle_sr));
  return [points.length > 0 ? `${points.join(', ')}: fitted as points, so that their luminous areas and luminances are not known; ratings without them are lower bounds (\u2265), which can miss a limit but not meet it.` : null,
    seen.some((w) => w > kLargest) ? 'A source is seen larger than 0.1 sr, beyond what UGR is meant for: it is rated too mildly.' : null,
    seen.some((w) => w < kSmallest) ? 'A source is seen smaller than 0.0003 sr, beyond what UGR is meant for: it is rated too harshly.' : null].filter(Boolean);
}

// Compares a rating with its limit. A lower bound can show that a limit is missed, but not that it is met.
function judge({ observer, rating, points, reason }, sigma) {
  if (!isNumber(observer.ugr)) return null;
  if (reason === 'nothing glares') return badge('met');
  if (!isNumber(rating)) return badge('open');
  const kind = verdict(observer.ugr - rating, sigma);
  return badge(points.length > 0 && kind === 'met' ? 'open' : kind);
}

export function glareTable(data, light) {
  const body = h('div');
  const { observers } = data.places;
  if (observers.length === 0) return h('p', null, 'No observers: the scene has no floor, or the targets name none.');
  if (!data.is_absolute) return h('p', null, 'UGR is not determined: it needs luminances in cd/m\u00b2, and this session has no absolute scale.');
  light.onChange(() => {
    const sigma = ratingSigma(data, light.dimming);
    const rated = observers.map((o) => ({ observer: o, ...glare(o, light.dimming, light.taken()) }));
    replace(body, table([
      { title: 'Observer', text: true, of: (r) => r.observer.id },
      { title: 'Eye', unit: 'm', of: (r) => vector(r.observer.eye_m, 2) },
      { title: 'Background', unit: 'cd/m\u00b2', of: (r) => (isNumber(r.background) ? digits(r.background, 3) : '\u2013') },
      { title: 'Brightest source', unit: 'cd/m\u00b2', of: (r) => digits(Math.max(0, ...r.observer.sources.map((s, k) => light.dimming[k] * s.luminance_cd_m2)), 3) },
      { title: 'UGR', of: (r) => (isNumber(r.rating) ? h('b', null, r.points.length > 0 ? '\u2265 ' : '', fixed(r.rating, 1), isNumber(sigma) ? h('span', { class: 'interval' }, ' \u00b1 ', fixed(1.96 * sigma, 1)) : null) : r.reason || kNone) },
      { title: 'Limit', of: (r) => (isNumber(r.observer.ugr) ? fixed(r.observer.ugr, 0) : '\u2013') },
      { title: '', text: true, of: (r) => judge(r, sigma) },
    ], rated), notes(data, light, rated).map((n) => h('p', { class: 'note' }, n)));
  });
  return body;
}
