// Lists what EN 12464-1 asks of a room beside its work planes: illuminance of walls and ceiling, mean cylindrical
// illuminance; and the power that the light takes.

import { h, replace, table } from './dom.js';
import { digits, fixed, isNumber, plusMinus } from './format.js';
import { statistics, verdict } from './light.js';
import { upwardFaces } from './plan.js';
import { badge, maintenanceWords } from './work_plane.js';

const kKinds = { wall: '', ceiling: '', cylindrical: 'cylindrical, at 1.2 m: ' };
const kUniformity = 0.1;  // asked of walls, ceiling and cylindrical illuminance: EN 12464-1:2021, 4.2.3 and 4.6.2

// Returns the first verdict of the two that is not "met".
function judge(data, surface, s) {
  if (!data.is_absolute || !isNumber(surface.required_lx)) return null;
  const kept = data.maintenance_factor ?? 1, known = s.averageSigma !== null;
  const verdicts = [verdict(kept * s.average - surface.required_lx, known ? kept * s.averageSigma : null), verdict(s.uniformity - kUniformity, s.uniformitySigma)];
  return badge(verdicts.find((v) => v === 'missed') || verdicts.find((v) => v === 'open') || 'met');
}

export function roomLevels(data, light) {
  const body = h('div'), factor = data.maintenance_factor;
  const surfaces = data.places.surfaces.map((surface) => ({ surface, counts: surface.kinds.map((kind) => kind === 0) }));
  light.onChange(() => {
    const rows = surfaces.map(({ surface, counts }) => ({ surface, s: statistics(light.places(surface.light), counts, data.places.relative_model_error) })).filter((r) => r.s.points > 0);
    replace(body, table([
      { title: 'Surface', text: true, of: (r) => kKinds[r.surface.kind] + r.surface.id },
      { title: 'Mean found, 95 %', unit: data.unit, of: (r) => plusMinus(r.s.average, r.s.averageSigma ?? 0) },
      ...(factor ? [{ title: `Maintained (\u00d7 ${factor})`, unit: data.unit, of: (r) => plusMinus(factor * r.s.average, factor * (r.s.averageSigma ?? 0)) }] : []),
      { title: 'Asked', unit: 'lx', of: (r) => (isNumber(r.surface.required_lx) ? '\u2265 ' + r.surface.required_lx : '\u2013') },
      { title: 'U\u2080', of: (r) => plusMinus(r.s.uniformity, r.s.uniformitySigma ?? 0, 2) },
      { title: 'Points', of: (r) => r.s.points },
      { title: '', text: true, of: (r) => judge(data, r.surface, r.s) },
    ], rows, { class: 'levels' }), h('p', { class: 'note' }, `Asked: of the areas\u2019 task in EN 12464-1:2021 (the largest of all areas for walls and ceiling), with U\u2080 \u2265 ${kUniformity}. Doors and windows count as wall; points behind furniture do not. `, maintenanceWords(factor)));
  });
  return body;
}

function floorArea(room) {
  const faces = upwardFaces(room), lowest = faces.length > 0 ? faces[0].height : 0, cross = (a, b) => a[0] * b[1] - a[1] * b[0];
  const area = ({ corners: c }) => 0.5 * Math.abs(c.reduce((sum, p, i) => sum + cross(p, c[(i + 1) % c.length]), 0));
  return faces.filter((f) => f.height < lowest + 0.05).reduce((sum, f) => sum + area(f), 0);
}

// Says the power of the present light; null where the targets give no power.
export function powerWords(data, light, planes) {
  if (!data.power_w.some(isNumber)) return null;
  const words = h('p', { class: 'power' });
  light.onChange(() => {
    const on = data.luminaires.map((l, k) => k).filter((k) => light.dimming[k] > 0), unknown = on.filter((k) => !isNumber(data.power_w[k]));
    if (unknown.length > 0) {
      replace(words, 'Power: not known, because the targets give none for ', unknown.map((k) => data.luminaires[k].id).join(', '), '.');
      return;
    }
    const power = on.reduce((sum, k) => sum + light.dimming[k] * data.power_w[k], 0), area = floorArea(data.room), density = power / area;
    const s = planes.length > 0 ? planes[0].statistics : { points: 0 }, hasMean = data.is_absolute && s.points > 0 && s.average > 0;
    const per100 = hasMean ? (100 * density) / s.average : null;
    replace(words, h('b', null, `Power ${digits(power)} W`), `, ${digits(density, 3)} W/m\u00b2 of ${fixed(area, 1)} m\u00b2 floor`,
      hasMean ? `; ${plusMinus(per100, (per100 * (s.averageSigma ?? 0)) / s.average, 3)} W/m\u00b2 per 100 lx found on ${planes[0].plane.id} (95 %)` : '', on.some((k) => light.dimming[k] < 1) ? '. Power is taken as proportional to dimming.' : '.');
  });
  return words;
}
