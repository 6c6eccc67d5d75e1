// Reads the data that the program wrote into the page, and decodes its columns of numbers
// (apps/report/report_room.h, report_places.h).

function bytesOf(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes.buffer;
}

export const floats = (text) => new Float32Array(bytesOf(text));
export const shorts = (text) => new Uint16Array(bytesOf(text));

// Decodes light at places: rows (place, luminaire), and the factor of their covariance with one row for each of
// `modes`.
function decodeLight(light) {
  return { total: floats(light.total), body: light.body ? floats(light.body) : null, modes: light.factor ? light.modes : 0,
    factor: light.factor ? floats(light.factor) : null };
}

function decodeRoom(room) {
  if (!room) return null;
  const kinds = shorts(room.facets.kinds), places = shorts(room.cells.places);
  const facetOf = new Uint32Array(room.cells.count);
  let cell = 0;
  room.cells.of_facet.forEach((count, facet) => { for (let i = 0; i < count; ++i) facetOf[cell++] = facet; });
  return { ...room, corners: floats(room.facets.corners), kinds, places, facetOf, count: room.cells.count,
    total: floats(room.total), direct: shorts(room.direct), body: room.body ? shorts(room.body) : null };
}

export function readData() {
  const data = JSON.parse(document.getElementById('report-data').textContent);
  data.room = decodeRoom(data.room);
  data.places.point_light = decodeLight(data.places.point_light);
  for (const plane of [...data.places.planes, ...data.places.surfaces]) plane.light = decodeLight(plane.light);
  for (const plane of data.places.planes) plane.fine.light = decodeLight(plane.fine.light);
  data.unit = data.is_absolute ? 'lx' : 'rel. units';
  data.fluxUnit = data.is_absolute ? 'lm' : 'rel. units';
  data.luminanceUnit = data.is_absolute ? 'cd/m\u00b2' : 'rel. units';
  return data;
}

// Returns the corners of a cell in world: four of a parallelogram, three of a triangle.
export function cellCorners(room, cell) {
  const f = room.facetOf[cell], at = 9 * f, c = room.corners;
  const triangle = room.kinds[4 * f] === 1, nu = room.kinds[4 * f + 2], nv = room.kinds[4 * f + 3];
  const i = room.places[3 * cell], j = room.places[3 * cell + 1], upper = room.places[3 * cell + 2] === 1;
  const point = (a, b) => [0, 1, 2].map((x) => c[at + x] + (a / nu) * c[at + 3 + x] + (b / nv) * c[at + 6 + x]);
  if (!triangle) return [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
  if (upper) return [point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
  return [point(i, j), point(i + 1, j), point(i, j + 1)];
}

export function facetNormal(room, facet) {
  const c = room.corners, at = 9 * facet;
  const u = [c[at + 3], c[at + 4], c[at + 5]], v = [c[at + 6], c[at + 7], c[at + 8]];
  const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(...n);
  return n.map((x) => x / length);
}
