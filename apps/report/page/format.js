// Formats numbers with as many digits as their uncertainty justifies.

export const kTwoSided95 = 1.96;
export const kNone = 'not determined';

export const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

export function digits(value, significant = 4) {
  if (!isNumber(value)) return kNone;
  if (value === 0) return '0';
  const decimals = Math.max(0, Math.min(6, significant - 1 - Math.floor(Math.log10(Math.abs(value)))));
  return fixed(value, decimals);
}

// Writes a true minus sign, and none before zeros.
export function fixed(value, decimals) {
  if (!isNumber(value)) return kNone;
  let text = value.toFixed(decimals);
  if (Number(text) === 0) text = text.replace('-', '');
  return text.replace('-', '\u2212');
}

export function signed(value, decimals) {
  if (!isNumber(value)) return kNone;
  const text = fixed(value, decimals);
  return value > 0 && Number(text) !== 0 ? '+' + text : text;
}

// Returns the decimals that show two digits of an interval.
export function decimalsOf(half) {
  if (!isNumber(half) || half <= 0) return null;
  return Math.max(0, Math.min(6, 1 - Math.floor(Math.log10(half))));
}

// Writes "3592 ± 141", where the half width is that of 95 %.
export function plusMinus(value, sigma, significant = 4) {
  if (!isNumber(value)) return kNone;
  const half = kTwoSided95 * sigma;
  const decimals = decimalsOf(half);
  if (decimals === null) return digits(value, significant);
  return fixed(value, decimals) + ' \u00b1 ' + fixed(half, decimals);
}

// Writes the half width alone, or why there is none.
export function halfWidth(sigma, scale = 1) {
  if (sigma === null || sigma === undefined) return kNone;
  if (sigma === 0) return 'held';
  const half = kTwoSided95 * sigma * scale;
  return '\u00b1 ' + fixed(half, decimalsOf(half) ?? 0);
}

export function vector(v, decimals) {
  return v.map((x) => fixed(x, decimals)).join(', ');
}

export const seconds = (s) => (s < 0.095 ? fixed(1000 * s, 0) + ' ms' : fixed(s, s < 9.95 ? 2 : 1) + ' s');
