// Shows a work plane: its illuminance in false colours with lines of equal value, the values of the
// standard's grid, and its requirements.

import { ColourScale, niceStep, rangeOf } from './colour_scale.js';
import { h, replace, svg } from './dom.js';
import { digits, fixed, isNumber, plusMinus } from './format.js';
import { isolines } from './isolux.js';
import { statistics, verdict } from './light.js';

const kVerdicts = { met: 'met', missed: 'missed', open: 'not decided at 95 %' };
const length = (v) => Math.hypot(...v);

export const badge = (kind) => h('span', { class: 'badge ' + kind }, kVerdicts[kind]);

export const maintenanceWords = (factor) => (factor ? `Found: as the light is now. Maintained: ${factor} times that (the factor of the targets, taken as exact), which is held against the requirement.`
  : 'As found: no maintenance factor is applied.');

export class WorkPlane {
  constructor(data, light, plane) {
    Object.assign(this, { data, light, plane });
    this.counts = plane.kinds.map((kind) => kind === 0);
    this.fine = { nu: plane.count_u * plane.fine.refined, nv: plane.count_v * plane.fine.refined, light: plane.fine.light, kinds: plane.fine.kinds };
    this.asked = { average: plane.average_lx, uniformity: plane.uniformity };
    this.picture = h('div', { class: 'plane-picture' });
    this.numbers = h('div', { class: 'plane-numbers' });
    this.showsGrid = true;
    this.element = h('div', { class: 'plane' }, h('h3', null, plane.id), this.tools(), h('div', { class: 'plane-body' }, this.picture, this.numbers));
    light.onChange(() => this.update());
  }

  // Offers rows of the standard to choose from; both numbers can be overwritten.
  tools() {
    const number = (name, step, title) => h('input', { type: 'number', min: 0, step, value: this.asked[name] ?? '', title,
      oninput: (e) => { this.asked[name] = e.target.value === '' ? null : Number(e.target.value); this.task.value = ''; this.update(); } });
    const average = number('average', 10, 'required mean illuminance, lx'), uniformity = number('uniformity', 0.05, 'required uniformity U0');
    this.task = h('select', { onchange: (e) => {
      const task = this.data.tasks.find((t) => t.key === e.target.value);
      if (!task) return;
      this.asked = { average: task.average_lx, uniformity: task.uniformity };
      average.value = task.average_lx;
      uniformity.value = task.uniformity;
      this.update();
    } }, h('option', { value: '' }, 'own numbers'), this.data.tasks.map((t) => h('option', { value: t.key, selected: t.key === this.plane.task }, t.name)));
    const grid = h('input', { type: 'checkbox', checked: true, onchange: (e) => { this.showsGrid = e.target.checked; this.update(); } });
    return h('div', { class: 'tools no-print' }, h('label', null, 'Held against ', this.task), h('label', null, 'E\u0304m ', average, ' lx'),
      h('label', null, 'U\u2080 ', uniformity), h('label', { class: 'check' }, grid, ' values of the grid'));
  }

  update() {
    const places = this.light.places(this.plane.light), { kinds } = this.fine;
    const values = this.light.places(this.fine.light).value;
    for (let i = 0; i < values.length; ++i) if (kinds[i] !== 0) values[i] = NaN;
    this.statistics = statistics(places, this.counts, this.data.places.relative_model_error);
    replace(this.picture, this.draw(values, places.value));
    replace(this.numbers, this.table());
  }

  draw(values, gridValues) {
    const { plane } = this, lu = length(plane.edge_u_m), lv = length(plane.edge_v_m), { nu, nv } = this.fine;
    const width = 640, pitch = width / nu, height = (width * lv) / lu, foot = 74, left = 8, top = 8;
    const finite = Array.from(values).filter((v) => !Number.isNaN(v));
    if (finite.length === 0) return h('p', null, 'No point of this plane is in the open room.');
    const [, max] = rangeOf(finite, false), scale = new ColourScale(0, max, false);
    const rowHeight = height / nv, x = (i) => left + (i + 0.5) * pitch, y = (j) => top + height - (j + 0.5) * rowHeight;
    const cells = [];
    for (let j = 0; j < nv; ++j) for (let i = 0; i < nu; ++i) {
      const v = values[j * nu + i];
      cells.push(svg('rect', { x: (x(i) - pitch / 2).toFixed(2), y: (y(j) - rowHeight / 2).toFixed(2), width: (pitch + 0.4).toFixed(2), height: (rowHeight + 0.4).toFixed(2), fill: Number.isNaN(v) ? 'url(#hatch)' : scale.css(v) }));
    }
    const step = niceStep((Math.max(...finite) - Math.min(...finite)) / 6), lines = [], labels = [];
    for (let level = Math.ceil(Math.min(...finite) / step) * step; level <= Math.max(...finite); level += step) {
      for (const line of isolines(values, nu, nv, level)) {
        const d = 'M' + line.map(([i, j]) => `${x(i).toFixed(1)} ${y(j).toFixed(1)}`).join('L');
        lines.push(svg('path', { d, class: 'isolux-halo' }), svg('path', { d, class: 'isolux' }));
        const [i, j] = line[Math.floor(line.length / 2)];
        if (line.length > 4) labels.push(svg('text', { x: x(i), y: y(j) + 4, 'text-anchor': 'middle', class: 'isolux-label' }, digits(level, 3)));
      }
    }
    return svg('svg', { viewBox: `0 0 ${width + 2 * left} ${height + foot}`, class: 'chart plane-map', role: 'img', 'aria-label': 'Illuminance over ' + plane.id },
      svg('defs', null, svg('pattern', { id: 'hatch', width: 6, height: 6, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' }, svg('rect', { width: 6, height: 6, fill: '#9993' }), svg('line', { x1: 0, y1: 0, x2: 0, y2: 6, stroke: '#8888', 'stroke-width': 2 }))),
      cells, lines, this.showsGrid ? this.gridValues(gridValues, x, y, scale) : null, labels, legend(scale, left, top + height + 14, width, 'illuminance, ' + this.data.unit));
  }

  gridValues(values, x, y, scale) {
    const { count_u: nu, fine: { refined: r }, kinds } = this.plane, marks = [];
    values.forEach((v, k) => {
      if (kinds[k] !== 0) return;
      const i = (k % nu) * r + (r - 1) / 2, j = Math.floor(k / nu) * r + (r - 1) / 2;
      marks.push(svg('text', { x: x(i), y: y(j) + 4, 'text-anchor': 'middle', class: 'grid-value', fill: scale.share(v) > 0.55 ? '#000' : '#fff' }, digits(v, 3)));
    });
    return marks;
  }

  table() {
    const s = this.statistics, { unit } = this.data, absolute = this.data.is_absolute;
    if (s.points === 0) return h('p', null, 'No point counts.');
    const judge = (value, sigma, asked) => (isNumber(asked) ? badge(verdict(value - asked, sigma)) : null);
    // Requirements are on maintained illuminance; without a factor what was found stands for it.
    const factor = this.data.maintenance_factor, kept = factor ?? 1;
    const row = (name, value, maintained, asked, mark) => h('tr', null, h('th', { scope: 'row', class: 'text' }, name), h('td', { class: 'number' }, value),
      factor ? h('td', { class: 'number' }, maintained) : null, h('td', { class: 'number' }, asked), h('td', null, mark));
    const level = (value, sigma) => [sigma === undefined ? digits(value) : plusMinus(value, sigma), ' ', unit];
    const kinds = this.plane.kinds, inSolid = kinds.filter((k) => k === 1).length, outside = kinds.filter((k) => k === 2).length;
    const { plane } = this, pitch = [length(plane.edge_u_m) / plane.count_u, length(plane.edge_v_m) / plane.count_v];
    return [h('div', { class: 'scroll' }, h('table', { class: 'plane-table' }, h('thead', null, h('tr', null, ['', 'found, 95 %', factor ? `maintained (\u00d7 ${factor})` : null, 'asked', ''].filter((t) => t !== null).map((t) => h('th', null, t)))), h('tbody', null,
      row(['E', h('sub', null, 'avg')], level(s.average, s.averageSigma ?? 0), level(kept * s.average, kept * (s.averageSigma ?? 0)), isNumber(this.asked.average) ? `\u2265 ${this.asked.average} lx` : '\u2013', absolute ? judge(kept * s.average, s.averageSigma === null ? null : kept * s.averageSigma, this.asked.average) : null),
      row(['E', h('sub', null, 'min')], level(s.least, s.leastSigma ?? 0), level(kept * s.least, kept * (s.leastSigma ?? 0)), '', null),
      row(['E', h('sub', null, 'max')], level(s.largest), level(kept * s.largest), '', null),
      row(['U', h('sub', null, '0'), ' = E', h('sub', null, 'min'), '/E', h('sub', null, 'avg')], plusMinus(s.uniformity, s.uniformitySigma ?? 0, 3), '', isNumber(this.asked.uniformity) ? `\u2265 ${this.asked.uniformity}` : '\u2013', judge(s.uniformity, s.uniformitySigma, this.asked.uniformity)),
      row(['U', h('sub', null, 'd'), ' = E', h('sub', null, 'min'), '/E', h('sub', null, 'max')], digits(s.diversity, 3), '', '', null)))),
    h('p', { class: 'note' }, `${plane.count_u} \u00d7 ${plane.count_v} points, ${fixed(pitch[0], 2)} m \u00d7 ${fixed(pitch[1], 2)} m apart, over ${fixed(length(plane.edge_u_m), 2)} m \u00d7 ${fixed(length(plane.edge_v_m), 2)} m at z = ${fixed(plane.origin_m[2], 2)} m. ${s.points} of them count` +
      (inSolid > 0 ? `; ${inSolid} left out inside furniture` : '') + (outside > 0 ? `; ${outside} left out beyond the area` : '') + '. ' +
      (s.averageSigma === null ? 'Intervals are not determined. ' : '') + maintenanceWords(factor) + (absolute ? '' : ' Without an absolute scale only uniformity can be judged.'))];
  }
}

// Draws a bar of colours with its ticks.
export function legend(scale, x, y, width, words) {
  const steps = 128, bars = [];
  for (let i = 0; i < steps; ++i) bars.push(svg('rect', { x: x + (i * width) / steps, y, width: width / steps + 0.5, height: 12, fill: scale.css(scale.valueAt((i + 0.5) / steps)) }));
  return svg('g', null, bars, scale.ticks().map((t) => svg('g', null, svg('line', { x1: x + scale.share(t) * width, x2: x + scale.share(t) * width, y1: y + 12, y2: y + 17, class: 'tick' }),
    svg('text', { x: x + scale.share(t) * width, y: y + 31, 'text-anchor': scale.share(t) > 0.97 ? 'end' : scale.share(t) < 0.03 ? 'start' : 'middle' }, digits(t, 3)))),
    svg('text', { x: x + width / 2, y: y + 50, 'text-anchor': 'middle', class: 'axis' }, words));
}
