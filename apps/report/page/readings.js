// Compares measured with predicted readings of the luxmeter.

import { h, svg, table } from './dom.js';
import { niceStep } from './colour_scale.js';
import { digits, fixed, isNumber, kNone, signed } from './format.js';

const kSize = 420, kMargin = 56;

const errorPercent = (r) => (isNumber(r.measured_lx) && isNumber(r.predicted_lx) && r.measured_lx > 0 ? 100 * (r.predicted_lx / r.measured_lx - 1) : null);

// Returns the colour of an error, as in the plan: below 2 %, below 5 %, beyond.
export function errorColour(percent) {
  if (!isNumber(percent)) return '#9aa0a6';
  const error = Math.abs(percent);
  return error < 2 ? '#2fae62' : error < 5 ? '#f0932b' : '#e53935';
}

function logTicks(low, high) {
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
    for (const m of [1, 2, 5]) if (m * 10 ** e >= low && m * 10 ** e <= high) ticks.push(m * 10 ** e);
  return ticks;
}

// Plots predicted over measured, both logarithmic, with the 95 % intervals of both; the diagonal is agreement.
function scatter(readings) {
  const shown = readings.filter((r) => isNumber(r.measured_lx) && isNumber(r.predicted_lx) && r.measured_lx > 0 && r.predicted_lx > 0);
  if (shown.length === 0) return null;
  const all = shown.flatMap((r) => [r.measured_lx, r.predicted_lx]);
  const low = Math.min(...all) / 1.3, high = Math.max(...all) * 1.3;
  const at = (v) => (Math.log(Math.min(high, Math.max(low, v)) / low) / Math.log(high / low)) * (kSize - kMargin - 14);
  const x = (v) => kMargin + at(v), y = (v) => kSize - kMargin - at(v) + 0;
  const ticks = logTicks(low, high);
  const grid = ticks.map((t) => [
    svg('line', { x1: x(t), x2: x(t), y1: y(low), y2: y(high), class: 'grid' }), svg('line', { x1: x(low), x2: x(high), y1: y(t), y2: y(t), class: 'grid' }),
    svg('text', { x: x(t), y: y(low) + 18, 'text-anchor': 'middle' }, digits(t, 1)), svg('text', { x: x(low) - 8, y: y(t) + 4, 'text-anchor': 'end' }, digits(t, 1))]);
  const dots = shown.map((r) => {
    const [a, b] = r.interval95_lx || [r.predicted_lx, r.predicted_lx], half = 1.96 * (r.measured_sigma_lx || 0), colour = errorColour(errorPercent(r));
    return svg('g', null,
      svg('line', { x1: x(r.measured_lx), x2: x(r.measured_lx), y1: y(a), y2: y(b), stroke: colour, 'stroke-width': 1.5 }),
      svg('line', { x1: x(r.measured_lx - half), x2: x(r.measured_lx + half), y1: y(r.predicted_lx), y2: y(r.predicted_lx), stroke: colour, 'stroke-width': 1.5 }),
      r.role === 'check'
        ? svg('circle', { cx: x(r.measured_lx), cy: y(r.predicted_lx), r: 3.6, fill: colour })
        : svg('rect', { x: x(r.measured_lx) - 4, y: y(r.predicted_lx) - 4, width: 8, height: 8, fill: 'none', stroke: colour, 'stroke-width': 2 }),
      svg('title', null, `${r.id} in ${r.state}: measured ${fixed(r.measured_lx, 2)} lx, predicted ${fixed(r.predicted_lx, 2)} lx`));
  });
  return svg('svg', { viewBox: `0 0 ${kSize} ${kSize}`, class: 'chart', role: 'img', 'aria-label': 'Predicted over measured illuminance' }, grid,
    svg('line', { x1: x(low), y1: y(low), x2: x(high), y2: y(high), class: 'agreement' }), dots,
    svg('text', { x: (x(low) + x(high)) / 2, y: kSize - 12, 'text-anchor': 'middle', class: 'axis' }, 'measured, lx'),
    svg('text', { transform: `translate(14 ${(y(low) + y(high)) / 2}) rotate(-90)`, 'text-anchor': 'middle', class: 'axis' }, 'predicted, lx'));
}

// Plots the error of each reading, with the interval that should contain it.
function errorStrip(readings) {
  const names = [...new Set(readings.map((r) => r.state))];
  const shown = readings.filter((r) => isNumber(errorPercent(r)) && isNumber(r.z)).sort((a, b) => names.indexOf(a.state) - names.indexOf(b.state));
  if (shown.length === 0) return null;
  const width = 720, height = 220, left = 46, right = 8, top = 12, bottom = 40;
  const sigma = (r) => 100 * Math.hypot(r.measured_sigma_lx || 0, r.prediction_sigma_lx || 0) / r.measured_lx;
  const limit = Math.max(...shown.map((r) => Math.max(Math.abs(errorPercent(r)), 1.96 * sigma(r)))) * 1.08;
  const step = niceStep(limit / 3), y = (e) => top + ((limit - e) / (2 * limit)) * (height - top - bottom);
  const pitch = (width - left - right) / shown.length, x = (i) => left + (i + 0.5) * pitch;
  const places = [0, 1].find((d) => Number.isInteger(step * 10 ** d)) ?? 2, ticks = [];
  for (let t = -Math.floor(limit / step) * step; t <= limit; t += step) ticks.push(t);
  // A name that would overlap the one before it is left out; the point's own text has it.
  const states = [];
  let free = 0;
  shown.forEach((r, i) => {
    if (i > 0 && shown[i - 1].state === r.state) return;
    const fits = x(i) >= free;
    states.push([i, fits ? r.state : '']);
    if (fits) free = x(i) + 8 * (r.state.length + 1);
  });
  return svg('svg', { viewBox: `0 0 ${width} ${height}`, class: 'chart strip', role: 'img', 'aria-label': 'Error of every reading in percent' },
    ticks.map((t) => [svg('line', { x1: left, x2: width - right, y1: y(t), y2: y(t), class: t === 0 ? 'agreement' : 'grid' }), svg('text', { x: left - 6, y: y(t) + 4, 'text-anchor': 'end' }, signed(t, places))]),
    states.map(([i, name]) => [i > 0 ? svg('line', { x1: x(i) - pitch / 2, x2: x(i) - pitch / 2, y1: top, y2: height - bottom + 6, class: 'grid' }) : null,
      svg('text', { x: x(i) - pitch / 2 + 4, y: height - bottom + 18 }, name)]),
    shown.map((r, i) => svg('g', null,
      svg('line', { x1: x(i), x2: x(i), y1: y(1.96 * sigma(r)), y2: y(-1.96 * sigma(r)), class: 'band', 'stroke-width': Math.max(2, 0.55 * pitch) }),
      svg('circle', { cx: x(i), cy: y(errorPercent(r)), r: 3.4, fill: errorColour(errorPercent(r)) }),
      svg('title', null, `${r.id} in ${r.state}: ${signed(errorPercent(r), 2)} %, z = ${signed(r.z, 1)}`))),
    svg('text', { x: left, y: height - 6, class: 'axis' }, 'predicted less measured, % of measured; grey: where 95 % of them should lie; by state'));
}

export function summaryWords(data) {
  const s = data.result.summary;
  if (!s || s.readings_checked === 0) return 'No reading checks the prediction: none was left out of the fit and predicted.';
  const check = data.result.check, z = data.result.luxmeter.filter((r) => r.role === 'check' && isNumber(r.z)).map((r) => r.z);
  const rms = Math.sqrt(z.reduce((sum, v) => sum + v * v, 0) / Math.max(1, z.length));
  const beyond = check?.disagreements?.length || 0;
  return `${s.readings_checked} readings that took no part in the fit: mean error ${fixed(s.mean_abs_error_lx, 2)} lx, which is ` +
    `${fixed(s.mean_abs_error_percent, 2)} % of their mean; largest ${fixed(s.max_abs_error_percent, 1)} %. ` +
    `Root mean square z ${fixed(rms, 2)} (1 is what the intervals promise); ` +
    (beyond === 0 ? 'none disagrees beyond chance.' : `${beyond} disagree beyond chance, named below.`);
}

const interval = (r) => (r.interval95_lx ? `${fixed(r.interval95_lx[0], 1)} to ${fixed(r.interval95_lx[1], 1)}` : kNone);

export function readingTable(data) {
  return table([
    { title: 'Point', text: true, of: (r) => r.id },
    { title: 'State', text: true, of: (r) => r.state },
    { title: 'Measured', unit: 'lx', of: (r) => (isNumber(r.measured_lx) ? fixed(r.measured_lx, 1) : '\u2013') },
    { title: 'Predicted', unit: 'lx', of: (r) => (isNumber(r.predicted_lx) ? fixed(r.predicted_lx, 1) : kNone) },
    { title: '95 % interval', unit: 'lx', of: interval },
    { title: 'Error', unit: '%', of: (r) => (isNumber(errorPercent(r)) ? h('span', { style: { color: errorColour(errorPercent(r)), fontWeight: 600 } }, signed(errorPercent(r), 1)) : '\u2013') },
    { title: 'z', of: (r) => (isNumber(r.z) ? signed(r.z, 1) : '\u2013') },
    { title: 'Role', text: true, of: (r) => r.role },
  ], data.result.luxmeter);
}

function disagreements(data) {
  const list = data.result.check?.disagreements || [];
  if (list.length === 0) return null;
  return h('div', { class: 'findings undetermined' }, h('h3', null, 'Readings that disagree beyond chance'), h('ul', null, list.map((d) =>
    h('li', null, h('div', { class: 'message' }, [d.id || d.of, d.state].filter(Boolean).join(' in '), isNumber(d.z) ? `: z = ${signed(d.z, 1)}` : ''),
      h('div', { class: 'remedy' }, d.message || d.cause || d.because || '', ' ', d.remedy || '')))));
}

export function readingsPart(data) {
  if (data.result.luxmeter.length === 0) return h('p', null, 'The session has no luxmeter readings: nothing checks the prediction.');
  return h('div', null, h('p', { class: 'lead' }, summaryWords(data)),
    h('div', { class: 'charts' }, scatter(data.result.luxmeter), h('div', { class: 'scroll' }, errorStrip(data.result.luxmeter))), disagreements(data));
}
