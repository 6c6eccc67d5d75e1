// Maps values to colours, with a legend to read them back: one table serves every picture of the page.
//
// The table runs through OKLab in equal steps of colour difference, from near black over violet, red and
// orange to pale yellow. Its lightness rises throughout, so that it works in grey and with colour-deficient
// sight (OKLab: Ottosson 2020).

const kLevels = 256;
// L, C and hue (degrees) of the posts of the path.
const kPosts = [[0.13, 0.02, 285], [0.28, 0.13, 287], [0.40, 0.165, 320], [0.53, 0.185, 5], [0.66, 0.175, 38],
  [0.78, 0.155, 68], [0.89, 0.135, 93], [0.97, 0.06, 105]];

function labOf([lightness, chroma, hue]) {
  const angle = (hue * Math.PI) / 180;
  return [lightness, chroma * Math.cos(angle), chroma * Math.sin(angle)];
}

function levelsOf([L, a, b]) {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3, m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3,
    s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s, -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s];
  return linear.map((x) => {
    const y = Math.min(1, Math.max(0, x));
    return Math.round(255 * (y <= 0.0031308 ? 12.92 * y : 1.055 * y ** (1 / 2.4) - 0.055));
  });
}

// Returns a smooth curve through the posts (Catmull-Rom), finely sampled.
function pathOf(posts) {
  const path = [], last = posts.length - 1, steps = 400;
  for (let i = 0; i < last; ++i) {
    const p = [i - 1, i, i + 1, i + 2].map((k) => posts[Math.min(last, Math.max(0, k))]);
    for (let step = 0; step < steps; ++step) {
      const t = step / steps;
      path.push([0, 1, 2].map((c) => 0.5 * (2 * p[1][c] + (p[2][c] - p[0][c]) * t +
        (2 * p[0][c] - 5 * p[1][c] + 4 * p[2][c] - p[3][c]) * t * t +
        (3 * p[1][c] - p[0][c] - 3 * p[2][c] + p[3][c]) * t * t * t)));
    }
  }
  path.push(posts[last]);
  return path;
}

function makeTable() {
  const path = pathOf(kPosts.map(labOf)), length = [0];
  for (let i = 1; i < path.length; ++i) length.push(length[i - 1] + Math.hypot(...path[i].map((x, c) => x - path[i - 1][c])));
  const table = new Uint8Array(3 * kLevels);
  for (let level = 0, at = 0; level < kLevels; ++level) {
    const want = (length[length.length - 1] * level) / (kLevels - 1);
    while (at < path.length - 1 && length[at] < want) ++at;
    table.set(levelsOf(path[at]), 3 * level);
  }
  return table;
}

export const kTable = makeTable();

// Holds the range and spacing of the colours.
export class ColourScale {
  constructor(min, max, isLog) {
    this.min = min;
    this.max = max;
    this.isLog = isLog;
  }

  // Returns 0..1; a value outside the range takes that of its end.
  share(value) {
    if (!(this.max > this.min)) return 0;
    const at = this.isLog
      ? (value > 0 ? Math.log(value / this.min) / Math.log(this.max / this.min) : 0)
      : (value - this.min) / (this.max - this.min);
    return Math.min(1, Math.max(0, at));
  }

  level(value) {
    return Math.round((kLevels - 1) * this.share(value));
  }

  // Returns red, green and blue, 0..255.
  colour(value) {
    const at = 3 * this.level(value);
    return [kTable[at], kTable[at + 1], kTable[at + 2]];
  }

  css(value) {
    return 'rgb(' + this.colour(value).join(',') + ')';
  }

  valueAt(share) {
    return this.isLog ? this.min * (this.max / this.min) ** share : this.min + share * (this.max - this.min);
  }

  // Returns round values to write beside the scale.
  ticks() {
    if (!(this.max > this.min)) return [this.min];
    if (!this.isLog) {
      const step = niceStep((this.max - this.min) / 5);
      const ticks = [];
      for (let k = Math.ceil(this.min / step); k * step <= this.max * (1 + 1e-9); ++k) ticks.push(k * step);
      return ticks;
    }
    const ticks = [];
    const decades = Math.log10(this.max / this.min);
    for (let e = Math.floor(Math.log10(this.min)); e <= Math.ceil(Math.log10(this.max)); ++e) {
      for (const m of decades > 3.5 ? [1] : [1, 2, 5]) {
        const value = m * 10 ** e;
        if (value >= this.min * (1 - 1e-9) && value <= this.max * (1 + 1e-9)) ticks.push(value);
      }
    }
    return ticks;
  }
}

export function niceStep(rough) {
  if (!(rough > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * [1, 2, 2.5, 5, 10].find((m) => m * power >= rough * (1 - 1e-9));
}

// Returns a range that holds nearly all values: `max` is a round number above their 99.5th percentile.
export function rangeOf(values, isLog) {
  const sorted = Float64Array.from(values).filter((v) => v > 0).sort();
  if (sorted.length === 0) return [isLog ? 0.1 : 0, 1];
  const high = sorted[Math.floor(0.995 * (sorted.length - 1))], low = sorted[Math.floor(0.01 * (sorted.length - 1))];
  const step = niceStep(high / 8), max = step * Math.ceil(high / step);
  if (!isLog) return [0, max];
  const power = 10 ** Math.floor(Math.log10(low));
  return [Math.max(power * Math.floor(low / power), max / 1e4), max];
}
