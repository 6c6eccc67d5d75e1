// Draws lines of equal value over a grid: marching squares, linear along the edges of cells.
//
// Saddles are split by the mean of their four corners. Cells that touch a point without a value draw nothing.
// Source: Lorensen and Cline (1987), "Marching cubes", in two dimensions.

// Segments of one cell as pairs of edges (0 lower, 1 right, 2 upper, 3 left), by the corners that are above the level.
const kSegments = { 1: [[3, 0]], 2: [[0, 1]], 3: [[3, 1]], 4: [[1, 2]], 6: [[0, 2]], 7: [[3, 2]], 8: [[2, 3]], 9: [[0, 2]], 11: [[1, 2]], 12: [[1, 3]], 13: [[0, 1]], 14: [[3, 0]] };

// Returns polylines of [i, j] in units of the grid. Values are values[j * nu + i]; NaN means none.
export function isolines(values, nu, nv, level) {
  const segments = [];
  for (let j = 0; j + 1 < nv; ++j) {
    for (let i = 0; i + 1 < nu; ++i) {
      const v = [values[j * nu + i], values[j * nu + i + 1], values[(j + 1) * nu + i + 1], values[(j + 1) * nu + i]];
      if (v.some(Number.isNaN)) continue;
      const kind = v.reduce((bits, x, k) => bits | (x >= level ? 1 << k : 0), 0);
      const on = (a, b) => (level - v[a]) / (v[b] - v[a]);
      const edge = [() => [i + on(0, 1), j], () => [i + 1, j + on(1, 2)], () => [i + on(3, 2), j + 1], () => [i, j + on(0, 3)]];
      let pairs = kSegments[kind] || [];
      if (kind === 5 || kind === 10) {
        const above = (v[0] + v[1] + v[2] + v[3]) / 4 >= level;
        pairs = (kind === 5) === above ? [[3, 2], [0, 1]] : [[3, 0], [1, 2]];
      }
      for (const [a, b] of pairs) segments.push([edge[a](), edge[b]()]);
    }
  }
  return joined(segments);
}

// Joins segments that share an end into one line.
function joined(segments) {
  const key = (p) => p.map((x) => x.toFixed(6)).join(','), ends = new Map();
  const add = (p, s) => ends.set(key(p), [...(ends.get(key(p)) || []), s]);
  segments.forEach((s, n) => { add(s[0], n); add(s[1], n); });
  const used = new Uint8Array(segments.length), lines = [];
  const extend = (line) => {
    for (;;) {
      const tail = line[line.length - 1], next = (ends.get(key(tail)) || []).find((n) => !used[n]);
      if (next === undefined) return;
      used[next] = 1;
      const [a, b] = segments[next];
      line.push(key(a) === key(tail) ? b : a);
    }
  };
  segments.forEach((s, n) => {
    if (used[n]) return;
    used[n] = 1;
    const line = [s[0], s[1]];
    extend(line);
    line.reverse();
    extend(line);
    lines.push(line);
  });
  return lines;
}
