// Photos beside what the fit predicts of them, and where they differ.

import { h } from './dom.js';
import { digits, fixed, isNumber, signed } from './format.js';

function residualLegend(limit) {
  return h('div', { class: 'residual-key' }, h('span', null, '\u2212' + limit + ' %'), h('span', { class: 'bar' }), h('span', null, '+' + limit + ' %'),
    h('span', { class: 'interval' }, 'photo less prediction; grey: nothing told (saturated, dark, a luminaire)'));
}

export function photoViews(data) {
  const { views, state, limit_percent: limit } = data.views;
  if (views.length === 0) return h('p', null, data.result.views.length > 0 ? `No registered view was photographed in state ${state}.` : 'The session has no photos: it was fitted to readings alone.');
  const picture = (uri, name) => h('figure', null, h('img', { src: uri, alt: name, loading: 'eager' }), h('figcaption', null, name));
  return h('div', null, residualLegend(limit),
    data.views.scale_is_of_fit ? null : h('p', { class: 'note' }, 'Without an absolute scale the photos are brought to the predictions by one common factor.'),
    h('div', { class: 'views' }, views.map((v) => {
      const pose = data.result.views.find((r) => r.view === v.view);
      return h('article', { class: 'view' }, h('h4', null, v.view, h('span', { class: 'interval' }, ` residual: median ${signed(v.median_percent, 1)} %, half within ${fixed(v.median_magnitude_percent, 1)} %, nine tenths within ${fixed(v.largest_tenth_percent, 1)} %`,
        pose ? `; reprojection ${digits(pose.reprojection_rms_px, 2)} px, camera \u00b1 ${pose.position_sigma_m.map((s) => (isNumber(s) ? fixed(1960 * s, 1) : '?')).join(', ')} mm` : '')),
      h('div', { class: 'triple' }, picture(v.photo, 'photo'), picture(v.predicted, 'predicted'), picture(v.residual, 'residual')));
    })));
}
