// Tests the page itself (report.html#selftest), on the machine and in the browser where it is read.
//
// Results are written as JSON into an element of id "selftest". The test reads pixels back from the picture,
// moves sliders, clicks a surface, and compares numbers with those that the program wrote.

import { h } from './dom.js';
import { digits } from './format.js';
import { glare, statistics } from './light.js';

const frame = () => new Promise((done) => { setTimeout(done, 30); });

// Yields cells whose middle is visible from the view's place, together with the whole pixel that contains it.
function* visibleCells(view, wanted) {
  const step = Math.max(1, Math.floor(view.room.count / (24 * wanted)));
  let found = 0;
  for (let c = 0; c < view.room.count && found < wanted; c += step) {
    const [x, y] = view.placeOf(c);
    if (!(x > 4 && y > 4 && x < view.width - 4 && y < view.height - 4)) continue;
    const isCell = ([a, b]) => view.pick(x + a, y + b)?.cell === c;
    if (![[0, 0], [-1, -1], [1, -1], [-1, 1], [1, 1]].every(isCell)) continue;
    ++found;
    yield [c, x, y];
  }
}

function pixels(room) {
  const { view } = room, shown = Object.entries(view.layers).map(([name, layer]) => [name, layer.visible]);
  for (const [name] of shown) view.layers[name].visible = false;
  let compared = 0, wrong = 0, first = null;
  for (const from of ['outside', 'top', ...view.data.cameras.slice(0, 2).map((c) => c.view)]) {
    view.look(from);
    const cells = [...visibleCells(view, 60)], colours = view.pixelsAt(cells.map(([, x, y]) => [x, y]));
    cells.forEach(([c], i) => {
      const want = room.scale.colour(room.values[c]);
      ++compared;
      if (want.every((v, k) => v === colours[i][k])) return;
      ++wrong;
      first ||= { cell: c, value: room.values[c], want, got: colours[i] };
    });
  }
  for (const [name, visible] of shown) view.layers[name].visible = visible;
  view.look('outside');
  return { ok: compared >= 100 && wrong === 0, compared, wrong, first };
}

// Checks that moving sliders changes the values by the sum of the columns, which is computed here again.
async function sliders({ data, light }) {
  const inputs = [...document.querySelectorAll('.lightbar input[type=range]')];
  if (inputs.length !== data.luminaires.length || data.places.points.length === 0) return { ok: inputs.length === data.luminaires.length };
  const before = light.dimming.slice();
  inputs.forEach((input, k) => {
    input.value = 20 + ((37 * k) % 70);
    input.dispatchEvent(new Event('input'));
  });
  await frame();
  const lamps = inputs.length, columns = data.places.point_light.total;
  const want = data.places.points.map((_, i) => inputs.reduce((sum, input, k) => sum + (Number(input.value) / 100) * columns[i * lamps + k], 0));
  const written = [...document.querySelectorAll('.points tbody tr')].map((row) => Number(row.children[1].textContent.split(' ')[0]));
  const error = Math.max(...want.map((w, i) => Math.abs(written[i] - w) / Math.max(1, w)));
  light.set(before);
  return { ok: written.length === want.length && error < 0.02, largest_relative_difference: error };
}

async function click(room) {
  const { view } = room;
  const [[cell, x, y]] = [...visibleCells(view, 40)];
  const box = view.canvas.getBoundingClientRect(), at = { clientX: box.left + x, clientY: box.top + y, bubbles: true };
  view.canvas.dispatchEvent(new MouseEvent('pointerdown', at));
  view.canvas.dispatchEvent(new MouseEvent('pointerup', at));
  await frame();
  const text = document.querySelector('.reading').textContent;
  return { ok: text.includes(digits(room.total[cell])), text };
}

// Compares statistics and ratings in every state with those of the program.
function numbers({ data, light, planes }) {
  let largest = 0, compared = 0;
  const compare = (a, b) => { if (b !== null && b !== 0) { ++compared; largest = Math.max(largest, Math.abs(a / b - 1)); } };
  const before = light.dimming.slice();
  data.states.forEach((state, s) => {
    light.dimming = Float64Array.from(state.dimming);
    const surfaces = data.places.surfaces.map((plane) => ({ plane, counts: plane.kinds.map((kind) => kind === 0) }));
    for (const { plane, counts } of [...planes, ...surfaces]) {
      const own = statistics(light.places(plane.light), counts, data.places.relative_model_error), want = plane.statistics[s];
      for (const [a, b] of [['average', 'average_lx'], ['least', 'least_lx'], ['uniformity', 'uniformity'], ['averageSigma', 'average_sigma_lx'], ['leastSigma', 'least_sigma_lx'], ['uniformitySigma', 'uniformity_sigma']])
        compare(own[a], want[b]);
    }
    for (const observer of data.places.observers) {
      const own = glare(observer, light.dimming, light.taken());
      if (own.points && own.points.length === 0) compare(own.rating, observer.rating[s]);
    }
  });
  light.dimming = before;
  return { ok: largest < 1e-4, compared, largest_relative_difference: largest };
}

export async function selfTest(page) {
  const { room } = page, result = {};
  const run = async (name, check) => {
    try {
      result[name] = await check();
    } catch (error) {
      result[name] = { ok: false, error: String(error && error.stack) };
    }
  };
  await frame();
  result.webgl = { ok: Boolean(room?.view), cells: page.data.room?.count ?? 0 };
  if (room?.view) {
    await run('pixels', () => pixels(room));
    await run('click', () => click(room));
  }
  await run('sliders', () => sliders(page));
  await run('numbers', () => numbers(page));
  const requests = performance.getEntriesByType('resource').map((e) => e.name).filter((name) => !/^(data|blob):/.test(name));
  result.requests = { ok: requests.length === 0, requests };
  const odd = document.getElementById('page').textContent.match(/.{0,40}(NaN|undefined|Infinity|\[object).{0,20}/);
  result.words = { ok: !odd, odd: odd && odd[0] };
  result.injected = { ok: !('luxfitInjected' in window) && document.querySelectorAll('#page script').length === 0 };
  result.ok = Object.values(result).every((r) => r.ok);
  document.body.append(h('pre', { id: 'selftest' }, JSON.stringify(result)));
}
