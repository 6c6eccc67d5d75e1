// Lists the luminaires that were found, each quantity with its 95 % interval.

import { h, table } from './dom.js';
import { digits, fixed, halfWidth, isNumber, kNone, plusMinus, vector } from './format.js';

const kShapes = { point: 'point', disc: 'disc', rectangle: 'rectangle', sphere: 'sphere' };
const kDistributions = { isotropic: 'isotropic', lambertian: 'Lambertian', cosine_power: 'cosine-power', table: 'table, estimated' };

const millimetres = (sigma) => {
  const half = 1960 * sigma;
  return isNumber(sigma) ? (sigma === 0 ? 'held' : '\u00b1 ' + fixed(half, half < 9.95 ? 1 : 0)) : kNone;
};

function position(result) {
  const sigma = result.position_sigma_m;
  return [h('div', null, vector(result.position_m, 3)),
    h('div', { class: 'interval' }, sigma.every((s) => s === 0) ? 'held' : sigma.map(millimetres).join(', ') + ' mm')];
}

function aim(result) {
  const [x, y, z] = result.aim, tilt = (Math.acos(Math.max(-1, Math.min(1, -z))) * 180) / Math.PI;
  const sigma = result.aim_sigma_deg;
  const interval = sigma ? (sigma.every(isNumber) ? sigma.map((s) => halfWidth(s)).join(', ') + '\u00b0' : kNone) : 'not estimated';
  const heading = result.heading && Math.abs(z) > 0.5
    ? h('div', { class: 'interval' }, 'C0 at ', fixed((Math.atan2(result.heading[1], result.heading[0]) * 180) / Math.PI, 1), '\u00b0',
      isNumber(result.heading_sigma_deg) ? ' ' + halfWidth(result.heading_sigma_deg) + '\u00b0' : '') : null;
  return [h('div', null, tilt < 0.05 ? 'straight down' : tilt > 179.95 ? 'straight up' : `${fixed(tilt, 1)}\u00b0 from down (${vector([x, y, z], 3)})`),
    h('div', { class: 'interval' }, interval), heading];
}

function flux(result, data) {
  if (isNumber(result.flux_lm)) {
    const sigma = result.flux_sigma_lm, share = isNumber(sigma) && result.flux_lm > 0 ? (196 * sigma) / result.flux_lm : null;
    return [h('div', null, digits(result.flux_lm)),
      h('div', { class: 'interval' }, halfWidth(sigma), share ? ` (${digits(share, 2)} %)` : '')];
  }
  if (isNumber(result.flux_relative)) return [h('div', null, digits(result.flux_relative), ' ', data.fluxUnit), h('div', { class: 'interval' }, 'lm ', kNone)];
  return kNone;
}

function distribution(result) {
  const name = kDistributions[result.photometry] || result.photometry;
  const exponent = isNumber(result.cosine_exponent) ? h('div', { class: 'interval' }, 'm = ', plusMinus(result.cosine_exponent, result.cosine_exponent_sigma, 3)) : null;
  return [h('div', null, name), exponent];
}

function opening(result) {
  const size = result.size_m.map((x) => digits(x, 3)).join(' \u00d7 ');
  return [h('div', null, kShapes[result.shape] || result.shape), size ? h('div', { class: 'interval' }, size + ' m') : null];
}

function colour(result) {
  if (!isNumber(result.cct_k)) return kNone;
  return [h('div', null, fixed(result.cct_k, 0)), h('div', { class: 'interval' }, halfWidth(result.cct_sigma_k), '; duv ', fixed(result.duv, 4))];
}

export function schedule(data) {
  const hasColours = data.result.luminaires.some((r) => isNumber(r.cct_k));
  return table([
    { title: 'Luminaire', text: true, of: (r) => r.id },
    { title: 'Luminous flux', unit: data.is_absolute ? 'lm' : '', of: (r) => flux(r, data) },
    { title: 'Position x, y, z', unit: 'm', of: position },
    { title: 'Aim', text: true, of: aim },
    { title: 'Distribution', text: true, of: distribution },
    { title: 'Luminous opening', text: true, of: opening },
    ...(hasColours ? [{ title: 'Colour temperature', unit: 'K', of: colour }] : []),
  ], data.result.luminaires, { class: 'schedule' });
}

// Lists what the data did not determine, and the remedy.
export function findings(data) {
  const { warnings, status } = data.result;
  const undetermined = data.places.undetermined;
  const because = data.result.status_because || [];
  const isCause = (w) => because.includes(w.code);
  const inOrder = [...warnings.filter(isCause), ...warnings.filter((w) => !isCause(w))];
  const items = inOrder.map((w) => h('li', null, h('div', { class: 'message' }, isCause(w) ? h('b', null, 'Undetermined: ') : null, w.message), h('div', { class: 'remedy' }, h('b', null, 'Remedy: '), w.remedy)));
  if (undetermined.length > 0)
    items.push(h('li', null, h('div', { class: 'message' }, 'Not determined by the data: ', undetermined.join(', '), '.'),
      h('div', { class: 'remedy' }, 'Values that depend on them have no interval in this report.')));
  if (data.places.left_out.length > 0)
    items.push(h('li', null, h('div', { class: 'message' }, 'Intervals over areas leave out the uncertainty of: ', data.places.left_out.join(', '), '.')));
  const whole = status === 'done';
  return h('div', { class: 'findings ' + (whole ? 'done' : 'undetermined') },
    h('h3', null, whole ? (items.length > 0 ? 'Everything asked for is determined; to look at:' : 'Everything asked for is determined.')
      : 'The data do not determine everything that was asked for'),
    items.length > 0 ? h('ul', null, items) : null);
}
