// Builds the page: its parts in the order in which they are read.

import { cover } from './cover.js';
import { readData } from './data.js';
import { details, h, section } from './dom.js';
import { digits, fixed, isNumber, plusMinus } from './format.js';
import { glareTable } from './glare_table.js';
import { Light } from './light.js';
import { powerWords, roomLevels } from './levels.js';
import { lightBar, lightWords } from './light_bar.js';
import { paints } from './paints.js';
import { photoViews } from './photo_views.js';
import { dimensionedPlan } from './plan.js';
import { alikeInShape, polarCurve } from './polar_curve.js';
import { readingTable, readingsPart } from './readings.js';
import { choices, conditions, provenance, reflectances, speed } from './record.js';
import { RoomPart } from './room_part.js';
import { findings, schedule } from './schedule.js';
import { selfTest } from './self_test.js';
import { WorkPlane } from './work_plane.js';

const kBeside = 8;  // more luminaires than these stand below the plan
const kShortNames = { answer: 'Answer', readings: 'Readings', curves: 'Distribution', room: 'Room', planes: 'Work planes', levels: 'Walls', glare: 'Glare', photos: 'Photos',
  surfaces: 'Surfaces', table: 'Table', conditions: 'Conditions', choices: 'Choices', speed: 'Speed', provenance: 'Provenance' };

const card = (title, value, note) => h('div', { class: 'card' }, h('div', { class: 'card-title' }, title), h('div', { class: 'card-value' }, value), h('div', { class: 'card-note' }, note));

function cards(data, planes) {
  const lamps = data.result.luminaires, known = lamps.every((l) => isNumber(l.flux_lm)), s = data.result.summary;
  const worst = Math.max(...lamps.flatMap((l) => l.position_sigma_m.filter(isNumber)));
  const plane = planes[0] && planes[0].statistics.points > 0 ? planes[0] : null;
  return h('div', { class: 'cards' },
    card(lamps.length === 1 ? 'luminaire' : 'luminaires', lamps.length, isNumber(worst) && worst > 0 ? `places within \u00b1 ${fixed(1960 * worst, 1)} mm (95 %)` : ''),
    card('luminous flux in all', known ? [digits(lamps.reduce((sum, l) => sum + l.flux_lm, 0)), h('small', null, ' lm')] : 'relative', known ? 'all fully on' : 'no absolute scale'),
    s && s.readings_checked > 0 ? card('mean error of readings', [fixed(s.mean_abs_error_percent, 2), h('small', null, ' %')], `${s.readings_checked} that only check; largest ${fixed(s.max_abs_error_percent, 1)} %`) : card('readings that check', 'none', 'nothing tests the prediction'),
    plane ? card(`${plane.plane.id}, state ${data.state}`, [digits(plane.statistics.average, 3), h('small', null, ' ', data.unit)], `mean; U\u2080 ${digits(plane.statistics.uniformity, 2)}`) : null);
}

function build(data) {
  const light = new Light(data), planes = data.room ? data.places.planes.map((p) => new WorkPlane(data, light, p)) : [];
  const room = data.room ? new RoomPart(data, light) : null;
  const scaleNote = data.is_absolute ? null : h('p', { class: 'notice' }, 'This session has no absolute scale: all light in this report is in relative units, not in lx, lm or cd/m\u00b2. Shapes, ratios and uniformity stand.');
  const parts = [
    section('answer', 'The answer', null, cards(data, planes), scaleNote,
      h('div', { class: 'found' }, h('h2', { class: 'print-only' }, 'Luminaires'), h('div', { class: data.room ? 'plan-and-schedule' + (data.luminaires.length > kBeside ? ' many' : '') : null }, data.room ? dimensionedPlan(data) : null,
        h('div', { class: 'schedule-column' }, schedule(data), h('p', { class: 'note' }, 'Intervals hold 95 % (1.96 standard deviations). C0 is counted from +x.'))), findings(data))),
    section('readings', 'Measured against predicted', null, readingsPart(data)),
    section('curves', 'Light distribution', null, h('div', { class: 'polars' }, alikeInShape(data.luminaires).map((group) => polarCurve(group, data.is_absolute ? 'cd' : 'rel.')))),
    room ? section('room', 'The room', null, room.element) : section('room', 'The room', 'The session has no mesh: there is no room to draw.'),
    planes.length > 0 ? section('planes', 'Work planes', h('span', null, 'Illuminance over areas, by the grid of EN 12464-1. ', h('span', { class: 'print-only' }, lightWords(data, light))), planes.map((p) => p.element)) : null,
    data.room && data.places.surfaces.length > 0 ? section('levels', 'Walls, ceiling, cylindrical illuminance', null, roomLevels(data, light), powerWords(data, light, planes)) : null,
    data.room ? section('glare', 'Glare', 'Unified glare rating (CIE 117) of observers, from the luminaires\u2019 luminous openings as found and the background as predicted.', glareTable(data, light)) : null,
    section('photos', 'Photos and predictions', null, photoViews(data, light)),
    section('surfaces', 'Reflectances', null, paints(data), reflectances(data)),
    section('table', 'All readings', null, data.result.luxmeter.length > 0 ? details(`${data.result.luxmeter.length} readings`, readingTable(data)) : h('p', null, 'None.')),
    section('conditions', 'Measurement conditions', null, conditions(data)),
    section('choices', 'Choices and why', null, choices(data)),
    section('speed', 'Speed and accuracy of this run', null, speed(data)),
    section('provenance', 'Provenance', null, provenance(data)),
  ].filter(Boolean);
  const nav = h('nav', { class: 'no-print', 'aria-label': 'Parts of the report' }, parts.map((p) => h('a', { href: '#' + p.id }, kShortNames[p.id])));
  document.getElementById('page').append(cover(data), h('div', { class: 'bar no-print' }, nav, lightBar(data, light)), h('main', null, parts));
  return { data, light, room, planes };
}

// Opens all folded parts for printing.
function openForPrint() {
  let opened = [];
  window.addEventListener('beforeprint', () => {
    opened = [...document.querySelectorAll('details:not([open])')];
    for (const d of opened) d.open = true;
  });
  window.addEventListener('afterprint', () => { for (const d of opened) d.open = false; });
}

const page = build(readData());
openForPrint();
if (window.location.hash === '#selftest') selfTest(page);
