// Shows photos beside what the fit predicts of them, and where they differ.

import { h } from './dom.js';
import { digits, fixed, isNumber, signed } from './format.js';

function residualLegend(limit) {
  return h('div', { class: 'residual-key' }, h('span', null, '\u2212' + limit + ' %'), h('span', { class: 'bar' }), h('span', null, '+' + limit + ' %'),
    h('span', { class: 'interval' }, 'photo less prediction; grey: nothing told (saturated, dark, a luminaire)'));
}

function compared(view, data) {
  const pose = data.result.views.find((r) => r.view === view.view);
  const picture = (uri, name) => h('figure', null, h('img', { src: uri, alt: name, loading: 'eager' }), h('figcaption', null, name));
  return h('article', { class: 'view' },
    h('h4', null, view.view, h('span', { class: 'interval' }, ` residual: median ${signed(view.median_percent, 1)} %, half within ${fixed(view.median_magnitude_percent, 1)} %, nine tenths within ${fixed(view.largest_tenth_percent, 1)} %`,
      pose ? `; reprojection ${digits(pose.reprojection_rms_px, 2)} px, camera \u00b1 ${pose.position_sigma_m.map((s) => (isNumber(s) ? fixed(1960 * s, 1) : '?')).join(', ')} mm` : '')),
    h('div', { class: 'triple' }, picture(view.photo, 'photo'), picture(view.predicted, 'predicted'), picture(view.residual, 'residual')));
}

// Shows one state at a time: that of the page if it was photographed, or the one chosen here.
export function photoViews(data, light) {
  const { states, limit_percent: limit } = data.views;
  if (states.length === 0) return h('p', null, data.result.views.length > 0 ? 'No registered view was photographed with a luminaire on.' : 'The session has no photos: it was fitted to readings alone.');
  const views = h('div', { class: 'views' }), shown = h('b');
  const show = (id) => {
    const state = states.find((s) => s.id === id);
    if (!state) return;
    select.value = shown.textContent = id;
    views.replaceChildren(...state.views.map((v) => compared(v, data)));
  };
  const select = h('select', { 'aria-label': 'State of the photos', onchange: (e) => show(e.target.value) }, states.map((s) => h('option', { value: s.id }, s.id)));
  show(states[0].id);
  show(data.state);
  light.onChange(() => light.state && show(light.state.id));
  return h('div', null, h('p', null, h('label', { class: 'no-print' }, 'State ', select), h('span', { class: 'print-only' }, 'State ', shown), ': photo and prediction share one exposure.'), residualLegend(limit),
    data.views.scale_is_of_fit ? null : h('p', { class: 'note' }, 'Without an absolute scale the photos are brought to the predictions by one common factor.'),
    views);
}
