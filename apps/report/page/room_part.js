// Shows the room and its controls: quantity, scale, layers, value of a surface, predictions at the meter's
// points.

import { ColourScale, rangeOf } from './colour_scale.js';
import { h, replace, svg, table } from './dom.js';
import { FlatViews } from './flat_views.js';
import { digits, fixed, isNumber, kNone, plusMinus, vector } from './format.js';
import { lightWords } from './light_bar.js';
import { errorColour } from './readings.js';
import { RoomView } from './room_view.js';
import { legend } from './work_plane.js';

const kQuantities = { illuminance: 'Illuminance', luminance: 'Luminance' };

export class RoomPart {
  constructor(data, light) {
    Object.assign(this, { data, light, quantity: 'illuminance', isLog: false, range: null });
    this.stage = h('div', { class: 'stage' });
    this.legendPlace = h('div', { class: 'legend' });
    this.reading = h('div', { class: 'reading', 'aria-live': 'polite' });
    this.points = h('div', { class: 'points' });
    this.snapshot = h('img', { class: 'print-only snapshot', alt: 'The room in false colours' });
    this.flat = new FlatViews(data);
    try {
      this.view = new RoomView(data, this.stage);
    } catch (error) {
      this.view = null; console.warn(error);
      this.stage.remove();
    }
    const flats = h('details', { class: 'flats-fold', open: !this.view }, h('summary', null, 'Plan, ceiling and walls'), this.flat.element, h('p', { class: 'note' }, this.flat.caption));
    this.element = h('div', { class: 'room' }, h('p', { class: 'print-only' }, lightWords(data, light)),
      this.view ? null : h('p', { class: 'notice' }, 'This browser gives no WebGL: the room is shown as plan, ceiling and walls below; everything else works.'),
      h('div', { class: 'room-grid' + (this.view ? '' : ' flat-only') }, this.view ? h('div', { class: 'stage-column' }, this.stage, this.snapshot, this.legendPlace) : this.legendPlace, this.panel()), flats);
    this.showReading(null);
    if (this.view) this.connectView();
    light.onChange(() => this.update());
  }

  panel() {
    const radio = (value) => h('label', { class: 'check' }, h('input', { type: 'radio', name: 'quantity', value, checked: value === this.quantity, onchange: () => { this.quantity = value; this.range = null; this.update(); } }), ' ', kQuantities[value]);
    const bound = (i, name) => h('input', { type: 'number', step: 'any', 'aria-label': name, onchange: (e) => { const v = Number(e.target.value); if (Number.isFinite(v)) { this.range = [...(this.range || [this.scale.min, this.scale.max])]; this.range[i] = v; this.update(); } } });
    this.bounds = [bound(0, 'least'), bound(1, 'largest')];
    const log = h('input', { type: 'checkbox', onchange: (e) => { this.isLog = e.target.checked; this.range = null; this.update(); } });
    return h('div', { class: 'panel' }, h('fieldset', { class: 'no-print' }, h('legend', null, 'Colours'), radio('illuminance'), radio('luminance'),
      h('div', { class: 'line' }, this.bounds[0], ' to ', this.bounds[1], ' ', h('button', { type: 'button', onclick: () => { this.range = null; this.update(); } }, 'fit'),
        h('label', { class: 'check' }, log, ' logarithmic'))), this.view ? this.viewTools() : null, this.reading, this.points);
  }

  viewTools() {
    const { view, data } = this;
    const layer = (name, title, on = true) => {
      view.show(name, on);
      return h('label', { class: 'check' }, h('input', { type: 'checkbox', checked: on, onchange: (e) => view.show(name, e.target.checked) }), ' ', title);
    };
    const factor = h('select', { 'aria-label': 'Exaggeration of the ellipsoids', onchange: (e) => view.setExaggeration(Number(e.target.value)) }, [1, 5, 10, 20, 50].map((f) => h('option', { value: f, selected: f === 10 }, '\u00d7' + f)));
    view.setExaggeration(10);
    const from = (name, title) => h('button', { type: 'button', onclick: () => view.look(name) }, title);
    const views = data.cameras.length > 0 ? h('select', { 'aria-label': 'Stand where a camera stood', onchange: (e) => { if (e.target.value) view.look(e.target.value); } }, h('option', { value: '' }, 'camera \u2026'), data.cameras.map((c) => h('option', { value: c.view }, c.view))) : null;
    return [h('fieldset', { class: 'no-print' }, h('legend', null, 'Look'), h('div', { class: 'line' }, from('outside', 'from outside'), from('top', 'from above'), views)),
      h('fieldset', { class: 'no-print' }, h('legend', null, 'Show'), h('div', { class: 'layers' }, layer('luminaires', 'luminaires, aim'),
        view.layers.uncertainty.children.length > 0 ? [layer('uncertainty', 'their 95 % ellipsoids'), factor] : null,
        data.cameras.length > 0 ? layer('cameras', 'cameras') : null, data.tags.length > 0 ? layer('tags', 'tags') : null,
        data.places.points.length > 0 ? layer('points', 'luxmeter points') : null, layer('edges', 'edges')))];
  }

  connectView() {
    const { view, data } = this;
    for (const l of data.luminaires) view.addLabel(h('span', { class: 'lamp' }, l.id), l.position_m, 'luminaires');
    for (const c of data.cameras) view.addLabel(h('span', { class: 'cam' }, c.view), c.position_m, 'cameras');
    this.pointNames().forEach((name, i) => view.addLabel(h('span', { class: 'point' }, name), data.places.points[i].position_m, 'points'));
    view.onPick = (hit) => { this.picked = hit; view.select(hit ? hit.cell : null); this.showReading(hit); };
    let waiting = null;
    view.afterRender.push(() => {
      clearTimeout(waiting);
      waiting = setTimeout(() => this.takeSnapshot(), 400);
    });
    window.addEventListener('beforeprint', () => this.takeSnapshot());
  }

  takeSnapshot() {
    const listeners = this.view.afterRender;
    this.view.afterRender = [];
    this.snapshot.src = this.view.snapshot();
    this.view.afterRender = listeners;
  }

  pointNames() {
    const names = this.data.places.points.map(() => '');
    this.data.result.luxmeter.forEach((r, i) => { names[this.data.places.point_of_reading[i]] ||= r.id; });
    return names;
  }

  update() {
    const { total, direct } = this.light.cells(), { room } = this.data;
    Object.assign(this, { total, direct });
    const factor = (c) => (this.quantity === 'illuminance' ? 1 : room.albedo[room.kinds[4 * room.facetOf[c] + 1]] / Math.PI);
    this.values = Float64Array.from(total, (e, c) => e * factor(c));
    const [min, max] = this.range || rangeOf(this.values, this.isLog);
    this.scale = new ColourScale(this.isLog && !(min > 0) ? max / 1000 : min, max, this.isLog);
    this.bounds[0].value = Number(digits(this.scale.min, 3).replace('\u2212', '-'));
    this.bounds[1].value = Number(digits(this.scale.max, 3).replace('\u2212', '-'));
    const unit = this.quantity === 'illuminance' ? this.data.unit : this.data.luminanceUnit;
    replace(this.legendPlace, svg('svg', { viewBox: '0 0 640 56', class: 'chart' }, legend(this.scale, 8, 4, 624, `${kQuantities[this.quantity].toLowerCase()}, ${unit}`)));
    this.updatePoints();
    const colours = this.pointColours();
    this.flat.draw(this.values, this.scale, colours);
    if (this.view) {
      this.view.setValues(this.values, this.scale);
      this.view.setPointColours(colours);
      this.showReading(this.picked);
    }
  }

  // Colours the points by the readings of the present state, or by the worst of all states where the sliders match
  // none.
  pointColours() {
    const { data } = this, worst = data.places.points.map(() => null), { state } = this.light;
    data.result.luxmeter.forEach((r, i) => {
      if (!isNumber(r.measured_lx) || !isNumber(r.predicted_lx) || !(r.measured_lx > 0) || (state && r.state !== state.id)) return;
      const error = 100 * (r.predicted_lx / r.measured_lx - 1), p = data.places.point_of_reading[i];
      if (worst[p] === null || Math.abs(error) > Math.abs(worst[p])) worst[p] = error;
    });
    return worst.map(errorColour);
  }

  updatePoints() {
    const { data, light } = this, names = this.pointNames(), { state } = light;
    if (data.places.points.length === 0) return;
    const { value, factor, modes } = light.places(data.places.point_light);
    const rows = names.map((name, i) => {
      const own = factor ? Math.hypot(...factor.subarray(i * modes, (i + 1) * modes)) : null;
      const sigma = own === null ? null : Math.hypot(own, data.places.relative_model_error * value[i]);
      const reading = state && data.result.luxmeter.find((r, n) => data.places.point_of_reading[n] === i && r.state === state.id && isNumber(r.measured_lx));
      return { name, value: value[i], sigma, reading };
    });
    this.pointValues = value;
    replace(this.points, h('h4', null, 'At the meter\u2019s points now'), table([
      { title: 'Point', text: true, of: (r) => r.name },
      { title: 'Predicted, 95 %', unit: data.unit, of: (r) => plusMinus(r.value, r.sigma ?? 0) },
      { title: 'Measured', unit: data.unit, of: (r) => (r.reading ? fixed(r.reading.measured_lx, 1) : '\u2013') },
    ], rows));
  }

  showReading(hit) {
    if (!this.view) return;
    if (!hit) {
      replace(this.reading, h('p', { class: 'note no-print' }, 'Click a surface to read it.'));
      return;
    }
    const { room, result, unit, luminanceUnit } = this.data, { cell } = hit, material = room.kinds[4 * room.facetOf[cell] + 1];
    const albedo = room.albedo[material], e = this.total[cell], d = this.direct[cell], name = room.materials[material];
    const found = result.materials.find((m) => m.name === name);
    const row = (title, ...value) => h('tr', null, h('th', { scope: 'row', class: 'text' }, title), h('td', { class: 'number' }, value));
    replace(this.reading, h('h4', null, name, h('span', { class: 'interval' }, ` at ${vector(hit.point, 2)} m`)), h('table', { class: 'pairs' }, h('tbody', null,
      row('Illuminance', h('b', null, digits(e)), ' ', unit), row('direct', digits(d), ' ', unit), row('by reflection', digits(e - d), ' ', unit),
      row('Luminance', digits((albedo * e) / Math.PI), ' ', luminanceUnit),
      row('Reflectance', found && isNumber(found.albedo) ? plusMinus(found.albedo, found.sigma, 3) : [kNone, ` (${digits(albedo, 2)} in the model)`]))),
    room.merged > 1 ? h('p', { class: 'note' }, `mean over ${room.merged} \u00d7 ${room.merged} elements`) : null);
  }
}
