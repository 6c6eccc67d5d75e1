// Shows what is on: the state of the session and a slider for each luminaire, at the page's top while one
// scrolls.

import { h } from './dom.js';
import { fixed } from './format.js';

export function lightBar(data, light) {
  const select = h('select', { 'aria-label': 'State', onchange: (e) => {
    const state = data.states.find((s) => s.id === e.target.value);
    if (state) light.set(state.dimming);
  } }, h('option', { value: '' }, 'dimmed by hand'), data.states.map((s) => h('option', { value: s.id }, s.id)));
  const sliders = data.luminaires.map((l, k) => {
    const shown = h('output', null);
    const input = h('input', { type: 'range', min: 0, max: 100, step: 1, 'aria-label': 'Dimming of ' + l.id, 'data-luminaire': k,
      oninput: (e) => light.setOne(k, Number(e.target.value) / 100) });
    return { input, shown, element: h('label', { class: 'slider' }, h('span', { class: 'name' }, l.id), input, shown) };
  });
  light.onChange(() => {
    select.value = light.state ? light.state.id : '';
    sliders.forEach(({ input, shown }, k) => {
      input.value = Math.round(100 * light.dimming[k]);
      shown.textContent = fixed(100 * light.dimming[k], 0) + ' %';
    });
  });
  const all = h('details', { class: 'sliders', open: sliders.length <= 6 && window.innerWidth > 700 }, h('summary', null, 'Dim'), h('div', null, sliders.map((s) => s.element)));
  return h('div', { class: 'lightbar no-print' }, h('label', null, 'State ', select), all);
}

// Writes in words what is on, for paper.
export function lightWords(data, light) {
  const words = h('span', { class: 'light-words' });
  light.onChange(() => {
    const { state } = light;
    words.textContent = state ? `State ${state.id}` : 'Dimmed by hand: ' + data.luminaires.map((l, k) => `${l.id} ${fixed(100 * light.dimming[k], 0)} %`).join(', ');
  });
  return words;
}
