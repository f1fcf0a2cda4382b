// Scales of axes: linear, logarithmic where positive values span decades, symmetric logarithm for eigenvalues.

import { scaleLinear, scaleLog, scaleSymlog } from "d3-scale";

const DECADES = 1000;

/** Return [low, high] of finite numbers in arrays; null if there are none. */
export function extentOf(arrays) {
  let low = Infinity,
    high = -Infinity;
  for (const array of arrays)
    for (let i = 0; i < array.length; i++) {
      const v = array[i];
      if (v < low) low = v;
      if (v > high && v < Infinity) high = v;
    }
  return low <= high ? [low, high] : null;
}

/** Return an extent with room around it; what does not vary gets room of its own size. */
export function padded([low, high], part = 0.05) {
  const span = high - low,
    size = Math.max(Math.abs(low), Math.abs(high)) || 1;
  const room = span > 1e-9 * size ? part * span : 0.1 * size;
  return [low - room, high + room];
}

/** Return a scale for an extent; `kind` is "linear", "log" where that fits, or "symlog" about the size `typical`. */
export function scaleFor(extent, range, kind, typical = 0) {
  const [low, high] = extent ?? [0, 1];
  if (kind === "symlog") {
    const largest = Math.max(Math.abs(low), Math.abs(high), 1e-9);
    const constant = 10 ** Math.floor(Math.log10(typical > 0 ? Math.min(typical, largest) : largest) - 1.5);
    const scale = scaleSymlog()
      .constant(constant)
      .domain(spread(low, high, constant))
      .range(range);
    scale.ticks = (count) => symlogTicks(scale.domain(), constant, count);
    return scale;
  }
  if (kind === "log" && low > 0 && high / low > DECADES) {
    const room = (high / low) ** 0.04;
    return scaleLog()
      .domain([low / room, high * room])
      .range(range);
  }
  return scaleLinear()
    .domain(padded([low, high]))
    .range(range);
}

function spread(low, high, constant) {
  const [a, b] = [low, high].map((v) => Math.asinh(v / constant / 2));
  const room = 0.08 * Math.max(b - a, 0.5);
  return [2 * constant * Math.sinh(a - room), 2 * constant * Math.sinh(b + room)];
}

function symlogTicks([low, high], constant, count) {
  const powers = [];
  for (let p = constant; p <= Math.max(Math.abs(low), Math.abs(high)); p *= 10) powers.push(p);
  const every = Math.max(1, Math.ceil((2 * powers.length + 1) / Math.max(3, count)));
  const kept = powers.filter((_, k) => (powers.length - 1 - k) % every === 0);
  return [...kept.map((p) => -p).reverse(), 0, ...kept].filter((v) => v >= low && v <= high);
}

/** Return ticks that are far enough apart for their numbers. */
export function ticksOf(scale, count) {
  const found = scale.ticks(count);
  if (found.length <= count + 3) return found;
  const every = Math.ceil(found.length / count);
  const powers = found.filter((v) => Number.isInteger(Math.round(Math.log10(Math.abs(v)) * 1e9) / 1e9));
  return powers.length >= 2 && powers.length <= count + 3 ? powers : found.filter((_, k) => k % every === 0);
}
