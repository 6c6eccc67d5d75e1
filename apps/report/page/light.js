// Computes the light of any dimming: sums of the columns of single luminaires, less what the bodies of those that are
// on take from the light of the others (inverse/model/fitted_light.h).

export class Light {
  constructor(data) {
    this.data = data;
    this.dimming = Float64Array.from(data.states.find((s) => s.id === data.state).dimming);
    this.listeners = [];
  }

  onChange(listener) {
    this.listeners.push(listener);
    listener();
  }

  set(dimming) {
    this.dimming = Float64Array.from(dimming);
    for (const listener of this.listeners) listener();
  }

  setOne(luminaire, value) {
    const dimming = Float64Array.from(this.dimming);
    dimming[luminaire] = value;
    this.set(dimming);
  }

  // Returns the state of the session that the sliders match; null where they match none.
  get state() {
    const same = (s) => s.dimming.every((d, k) => Math.abs(d - this.dimming[k]) < 1e-9);
    return this.data.states.find(same) || null;
  }

  // Returns by luminaire what its body takes from the light of the others, while it is on; null where light adds.
  taken() {
    const incident = this.data.places.body_incident_lx;
    if (!incident) return null;
    return this.dimming.map((d, j) => (d > 0 ? incident[j].reduce((sum, e, k) => sum + e * this.dimming[k], 0) : 0));
  }

  // Returns the illuminance of all cells of the room, and its direct part.
  cells() {
    const room = this.data.room, n = room.count;
    const total = new Float64Array(n), direct = new Float64Array(n);
    this.dimming.forEach((d, k) => {
      if (d === 0) return;
      for (let c = 0; c < n; ++c) {
        const e = d * room.total[k * n + c];
        total[c] += e;
        direct[c] += e * room.direct[k * n + c] / 65535;
      }
    });
    (room.body ? this.taken() : []).forEach((t, j) => {
      for (let c = 0; t !== 0 && c < n; ++c) total[c] -= t * room.body_largest[j] * room.body[j * n + c] / 65535;
    });
    return { total, direct };
  }

  // Returns illuminance at places and, where it is known, the factor of its covariance (rows of `modes`).
  places(light) {
    const lamps = this.dimming.length, count = light.total.length / lamps, taken = light.body ? this.taken() : null;
    const value = new Float64Array(count), factor = light.factor ? new Float64Array(count * light.modes) : null;
    for (let i = 0; i < count; ++i) {
      for (let k = 0; k < lamps; ++k) {
        const d = this.dimming[k], row = i * lamps + k;
        value[i] += d * light.total[row];
        for (let m = 0; factor && m < light.modes; ++m) factor[i * light.modes + m] += d * light.factor[row * light.modes + m];
        if (taken) value[i] -= taken[k] * light.body[row];
      }
    }
    return { value, factor, modes: light.modes };
  }
}

// Returns mean, least value, uniformity and their sigmas, as forward/views/illuminance_plane.h does.
export function statistics(places, counts, model) {
  const { value, factor, modes } = places;
  const members = [...value.keys()].filter((i) => counts[i]);
  if (members.length === 0) return { points: 0 };
  let least = members[0], largest = members[0], sum = 0;
  for (const i of members) {
    sum += value[i];
    if (value[i] < value[least]) least = i;
    if (value[i] > value[largest]) largest = i;
  }
  const points = members.length, average = sum / points;
  const result = { points, average, least: value[least], largest: value[largest],
    uniformity: average > 0 ? value[least] / average : 0, diversity: value[largest] > 0 ? value[least] / value[largest] : 0,
    averageSigma: null, leastSigma: null, uniformitySigma: null };
  if (!factor) return result;
  const mean = new Float64Array(modes);
  for (const i of members) for (let m = 0; m < modes; ++m) mean[m] += factor[i * modes + m] / points;
  const row = (i) => factor.subarray(i * modes, (i + 1) * modes);
  result.averageSigma = Math.hypot(...mean, model * average);
  result.leastSigma = Math.hypot(...row(least), model * value[least]);
  const relative = Array.from(row(least), (s, m) => s / value[least] - mean[m] / average);
  result.uniformitySigma = value[least] > 0
    ? result.uniformity * Math.hypot(...relative, model * Math.sqrt(1 + 1 / points)) : 0;
  return result;
}

// Returns met | missed | open, at 95 % two-sided; null where there is no requirement.
export function verdict(margin, sigma) {
  if (!Number.isFinite(margin) || sigma === null) return 'open';
  if (Math.abs(margin) < 1.96 * sigma) return 'open';
  return margin >= 0 ? 'met' : 'missed';
}

// Returns the unified glare rating of an observer (forward/views/glare.h); null, with the reason, where it is
// undefined. Luminaires that are points are left out, since their luminous area is not known: the rating is then a
// lower bound. `taken`: Light.taken().
export function glare(observer, dimming, taken) {
  if (observer.is_inside) return { rating: null, reason: 'the eye would be inside a solid' };
  let sum = 0, indirect = 0;
  const points = [];
  for (let k = 0; k < dimming.length; ++k) {
    const source = observer.sources[k];
    if (dimming[k] > 0 && !source.is_defined) points.push(k);
    sum += dimming[k] * dimming[k] * source.sum;
    indirect += dimming[k] * observer.indirect_lx[k] - (taken ? taken[k] * observer.body[k] : 0);
  }
  if (!(indirect > 0)) return { rating: null, points, reason: 'no background light' };
  const background = indirect / Math.PI;
  if (sum > 0) return { rating: 8 * Math.log10(0.25 * sum / background), background, points, reason: '' };
  return { rating: null, background, points, reason: points.length > 0 ? 'luminous areas not known' : 'nothing glares' };
}
