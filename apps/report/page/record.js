// Shows the basis of the numbers: reflectances, conditions, choices, speed, provenance.

import chart from 'fit_office.csv';
import { details, h, svg, table } from './dom.js';
import { digits, fixed, isNumber, kNone, plusMinus, seconds } from './format.js';

const kSources = { given: 'given by the session', estimated: 'estimated', undetermined: kNone, unseen: 'unseen: no photo shows it' };

export function reflectances(data) {
  return table([
    { title: '', text: true, of: (m) => h('span', { class: 'swatch', style: { background: swatch(m) } }) },
    { title: 'Material', text: true, of: (m) => m.name },
    { title: 'Reflectance, 95 %', of: (m) => (isNumber(m.albedo) ? plusMinus(m.albedo, m.sigma, 3) : kNone) },
    { title: 'Red, green, blue', of: (m) => (Array.isArray(m.albedo_rgb) && m.albedo_rgb.every(isNumber) ? m.albedo_rgb.map((x) => fixed(x, 2)).join(', ') : '\u2013') },
    { title: 'Source', text: true, of: (m) => (kSources[m.source] || m.source) + (m.by_indirect_light && isNumber(m.albedo) ? ', by indirect light' : '') },
  ], data.result.materials);
}

export function swatch(material) {
  const rgb = Array.isArray(material.albedo_rgb) && material.albedo_rgb.every(isNumber) ? material.albedo_rgb : [1, 1, 1].map((x) => x * (material.albedo ?? material.albedo_in_model));
  const level = (x) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
  return `rgb(${rgb.map((x) => level(Math.min(1, Math.max(0, x)))).join(',')})`;
}

const rows = (pairs) => h('table', { class: 'pairs' }, h('tbody', null, pairs.filter((p) => p).map(([name, value]) => h('tr', null, h('th', { scope: 'row', class: 'text' }, name), h('td', null, value)))));

export function conditions(data) {
  const c = data.conditions, views = new Set(c.photos.map((p) => p.view)), exposures = c.photos.map((p) => p.exposure_s).filter((s) => s > 0);
  const readings = data.result.luxmeter, roles = ['fit', 'scale', 'check'].map((r) => [r, readings.filter((x) => x.role === r).length]).filter(([, n]) => n > 0);
  const scale = readings.filter((r) => r.role === 'scale').map((r) => `${r.id}@${r.state}`);
  return rows([
    ['Photos', c.photos.length === 0 ? 'none: fitted to readings alone' : `${c.photos.length} of ${views.size} views in ${new Set(c.photos.map((p) => p.state)).size} states; exposures ${exposures.length > 0 ? seconds(Math.min(...exposures)) + ' to ' + seconds(Math.max(...exposures)) : 'as the files say'}`],
    ...c.cameras.map((k) => [`Camera ${k.id}`, `${k.size_px ? k.size_px.join(' \u00d7 ') + ' pixels, ' : ''}response ${k.response}, vignetting ${k.vignetting}`]),
    ['Views registered', `${data.result.views.length}` + (isNumber(data.result.reprojection_rms_px) && data.result.views.length > 0 ? `, reprojection ${digits(data.result.reprojection_rms_px, 2)} px` : '')],
    ['Tags', c.tags > 0 ? `${c.tags} surveyed, ${c.tag_family}` : 'none surveyed'],
    ['Luxmeter', readings.length === 0 ? 'no readings' : `${readings.length} readings at ${data.places.points.length} points (${roles.map(([r, n]) => `${n} ${r}`).join(', ')}); class ${c.meter_class || 'not given'}, response ${c.sensitivity}`],
    ['Absolute scale', data.is_absolute ? (scale.length > 0 ? 'from ' + scale.join(', ') : 'from readings, fluxes or camera that the session gives') : 'none: all light is relative'],
    ['Ambient light', isNumber(c.ambient_lx) ? `measured and subtracted, up to ${digits(c.ambient_lx)} lx` : 'none given'],
    ['States', h('ul', { class: 'plain' }, data.states.map((s) => h('li', null, h('b', null, s.id), ': ', data.luminaires.map((l, k) => (s.dimming[k] > 0 ? `${l.id} ${fixed(100 * s.dimming[k], 0)} %` : null)).filter(Boolean).join(', ') || 'all off')))],
    c.mesh ? ['Mesh', `${c.mesh} (unit ${c.unit})`] : c.room ? ['Room', c.room] : null,
    ['Model', `${data.result.model.patches} patches, ${data.result.model.elements} elements, ${data.result.model.observations} observations, ${data.result.model.parameters} parameters; model error ${digits(100 * data.result.model.relative_model_error, 2)} %`],
  ]);
}

// Returns choices of the same kind and outcome as one, with the luminaires that they are of.
function alike(list, ids) {
  const groups = new Map();
  for (const c of list) {
    const id = ids.find((l) => c.what.endsWith(' of ' + l));
    const key = id === undefined ? c : c.what.slice(0, -id.length) + '\n' + c.chosen;
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push({ ...c, id });
  }
  return [...groups.values()];
}

function choiceOfOne(c) {
  return h('div', null, h('dt', null, c.what, ': ', h('b', null, c.chosen)),
    h('dd', null, c.because, c.among.length > 1 ? details(`among ${c.among.length}`, c.among.join(', ')) : null));
}

function choiceOfSeveral(group) {
  const [first] = group;
  return h('div', null, h('dt', null, first.what.slice(0, -first.id.length), group.map((c) => c.id).join(', '), ': ', h('b', null, first.chosen)),
    h('dd', null, `of ${first.id}: `, first.because, details(`the other ${group.length - 1}`, h('dl', null, group.slice(1).map((c) => [h('dt', null, c.id), h('dd', null, c.because)])))));
}

export function choices(data) {
  const ids = data.luminaires.map((l) => l.id).sort((a, b) => b.length - a.length);
  return h('dl', { class: 'choices' }, alike(data.result.choices, ids).map((group) => (group.length > 1 ? choiceOfSeveral(group) : choiceOfOne(group[0]))));
}

// Stages of the run for the bar; stages within another have a bar of their own.
const kWhole = ['scene', 'linearize', 'register', 'observe', 'count', 'fit'], kWithinFit = ['guess', 'choose', 'refine', 'detail'];
const kHues = ['#4c78a8', '#f58518', '#54a24b', '#e45756', '#b279a2', '#72b7b2', '#9d755d'];

function stageBar(timing, names) {
  const parts = names.filter((n) => timing[n] > 0).map((n) => [n, timing[n]]), sum = parts.reduce((s, [, t]) => s + t, 0);
  let at = 0;
  return h('div', null, h('div', { class: 'stagebar' }, parts.map(([n, t], i) => { at += t; return h('span', { style: { flexGrow: t, background: kHues[i % kHues.length] }, title: `${n} ${seconds(t)}` }, t > 0.06 * sum ? n : ''); })),
    h('div', { class: 'keys' }, parts.map(([n, t], i) => h('span', { class: 'key', style: { '--key': '' } }, h('i', { style: { background: kHues[i % kHues.length] } }), `${n} ${seconds(t)}`))));
}

// Places the run on the axes of docs/charts/fit_office.csv: error of the readings over time of the fit.
function speedChart(data) {
  const lines = chart.trim().split('\n').map((l) => l.split(',')), column = (name) => lines[0].indexOf(name);
  const known = lines.slice(1).map((l) => [Number(l[column('processor_time_s')]), Number(l[column('lux_percent')])]).filter(([t, e]) => t > 0 && e > 0);
  const run = [data.result.timing_s.fit, data.result.summary?.mean_abs_error_percent], hasRun = run.every((v) => isNumber(v) && v > 0);
  const all = hasRun ? [...known, run] : known, width = 460, height = 250, left = 46, bottom = 42, top = 12, right = 12;
  const range = (i) => [Math.min(...all.map((p) => p[i])) / 1.4, Math.max(...all.map((p) => p[i])) * 1.4];
  const [[x0, x1], [y0, y1]] = [range(0), range(1)];
  const x = (v) => left + (Math.log(v / x0) / Math.log(x1 / x0)) * (width - left - right), y = (v) => height - bottom - (Math.log(v / y0) / Math.log(y1 / y0)) * (height - bottom - top);
  const ticks = (a, b) => { const t = []; for (let e = -3; e < 5; ++e) for (const m of [1, 2, 5]) if (m * 10 ** e >= a && m * 10 ** e <= b) t.push(m * 10 ** e); return t; };
  return svg('svg', { viewBox: `0 0 ${width} ${height}`, class: 'chart speed', role: 'img', 'aria-label': 'Error of the readings over time of the fit' },
    ticks(x0, x1).map((t) => [svg('line', { x1: x(t), x2: x(t), y1: top, y2: height - bottom, class: 'grid' }), svg('text', { x: x(t), y: height - bottom + 16, 'text-anchor': 'middle' }, digits(t, 1))]),
    ticks(y0, y1).map((t) => [svg('line', { x1: left, x2: width - right, y1: y(t), y2: y(t), class: 'grid' }), svg('text', { x: left - 6, y: y(t) + 4, 'text-anchor': 'end' }, digits(t, 1))]),
    known.map(([t, e]) => svg('circle', { cx: x(t), cy: y(e), r: 3, class: 'known' })),
    hasRun ? svg('g', null, svg('circle', { cx: x(run[0]), cy: y(run[1]), r: 6, class: 'this-run' }), svg('text', { x: x(run[0]) + (x(run[0]) > 0.7 * width ? -10 : 10), y: y(run[1]) - 8, 'text-anchor': x(run[0]) > 0.7 * width ? 'end' : 'start', class: 'axis' }, 'this run')) : null,
    svg('text', { x: (left + width) / 2, y: height - 8, 'text-anchor': 'middle', class: 'axis' }, 'time of the fit, s'),
    svg('text', { transform: `translate(12 ${height / 2 - 10}) rotate(-90)`, 'text-anchor': 'middle', class: 'axis' }, 'mean error of readings, %'));
}

export function speed(data) {
  const t = data.result.timing_s;
  return h('div', null, h('p', null, h('b', null, seconds(t.total)), ' from photos to this result; of that, ', seconds(t.fit ?? 0), ' for the fit itself.'),
    stageBar(t, kWhole), h('p', { class: 'note' }, 'Within the fit:'), stageBar(t, kWithinFit),
    h('figure', null, speedChart(data), h('figcaption', null, 'Dots: the fixture\u2019s office fitted with more and fewer elements, views, states, rays and finer and coarser meshes (docs/charts/fit_office.csv; processor time of that machine). Ring: this run.')));
}

export function provenance(data) {
  const inputs = Object.entries(data.result.inputs || {});
  return h('div', null, rows([['Session', data.result.session_file || data.session], ['Made by', `luxfit ${data.result.luxfit_version}`], ['Command', h('code', null, data.result.command || '\u2013')],
    ['Report', h('code', null, data.command || '\u2013')], ['Report written', data.date], ['Targets', data.targets.path || 'default: the floor against EN 12464-1:2021, writing, typing, reading']]),
    details(`${inputs.length} input files with their hashes (XXH3, 128 bit)`, h('div', { class: 'scroll' }, h('table', { class: 'hashes' }, h('tbody', null, inputs.map(([file, hash]) => h('tr', null, h('td', null, file), h('td', null, h('code', null, hash)))))))),
    h('div', { class: 'no-print' }, details('The targets as a file to edit (luxfit report OUT --targets FILE)', h('pre', null, data.targets.toml))));
}
