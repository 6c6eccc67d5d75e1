// Shows what the page is about: the job, the people and the meter ([report] of the session or the targets), and the
// state of the result. On paper it is the cover.

import { h } from './dom.js';

function meterWords({ meter, meter_serial: serial, meter_calibrated: calibrated }) {
  return [meter, serial ? `serial ${serial}` : '', calibrated ? `calibrated ${calibrated}` : ''].filter(Boolean).join(', ');
}

function detailList(data) {
  const { details } = data;
  const pairs = [['Client', details.client], ['Address', details.address], ['Author', details.author], ['Measured', details.date], ['Luxmeter', meterWords(details)]]
    .filter(([, value]) => value);
  return pairs.length > 0 ? h('dl', { class: 'details' }, pairs.map(([name, value]) => h('div', null, h('dt', null, name), h('dd', null, value)))) : null;
}

// Returns a photo for paper, where the session has any: the first of the state that the page shows.
function coverPhoto(data) {
  const { states } = data.views, state = states.find((s) => s.id === data.state) || states[0];
  return state && state.views.length > 0 ? h('img', { class: 'print-only cover-photo', src: state.views[0].photo, alt: 'Photo of view ' + state.views[0].view }) : null;
}

export function cover(data) {
  const whole = data.result.status === 'done';
  return h('header', null, h('div', { class: 'title' }, h('h1', null, data.details.title || data.session),
    h('p', null, 'Light as found in the room: luminaires, illuminance, reflectances. ', h('span', { class: 'nowrap' }, data.date), ', luxfit ', data.luxfit_version), detailList(data)),
  h('div', { class: 'actions' }, h('span', { class: 'status ' + (whole ? 'done' : 'undetermined') }, whole ? 'determined' : 'partly undetermined'),
    h('button', { type: 'button', class: 'no-print', onclick: () => window.print() }, 'Print or save as PDF')), coverPhoto(data));
}
