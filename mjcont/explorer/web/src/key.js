// The key below a diagram: what line styles and markers mean, of those that are there.

import { JUMPING, STABILITY } from "./data.js";
import { h, s } from "./dom.js";
import { markerPath } from "./symbols.js";

const STYLES = [
  ["stable", "stable"],
  ["unstable", "unstable"],
  ["loadpath", "load path"],
  ["loadpath jumping", "jump"],
  ["history moving", "motion"],
];

/** Return what stands below a diagram of lines and points. */
export function keyOf(lines, points) {
  const there = new Set();
  for (const { curve, runs } of lines) {
    if (curve.kind === "history") there.add("history moving");
    else if (curve.kind === "loadpath") there.add("loadpath");
    for (const { code } of runs) {
      if (code === JUMPING) there.add("loadpath jumping");
      else if (code !== null && curve.kind !== "loadpath") there.add(STABILITY[code]);
    }
  }
  const marks = new Map(points.filter((p) => p.name).map((p) => [p.kind, p.name]));
  return [
    ...STYLES.filter(([cls]) => there.has(cls)).map(([cls, word]) => entry(stroke(cls), word)),
    ...[...marks].map(([kind, name]) => entry(marker(kind), name)),
  ];
}

function entry(sign, word) {
  return h("span", { class: "key-entry" }, sign, word);
}

function stroke(cls) {
  return s(
    "svg",
    { class: "plot key-sign", viewBox: "0 0 26 10", "aria-hidden": "true" },
    s("path", { class: `line ${cls}`, d: "M1,5H25" }),
  );
}

function marker(kind) {
  return s(
    "svg",
    { class: "plot key-sign narrow", viewBox: "-7 -7 14 14", "aria-hidden": "true" },
    s("path", { class: "point", d: markerPath(kind) }),
  );
}
