// What can be done from a row or a special point: each an operation of a session, a table of its study. No DOM here.

import { UNSTABLE, JUMPING } from "./data.js";

// kinds of points whose curve in one more parameter can be followed, and those at which orbits begin
const FOLLOWED = new Set(["LP", "HB", "BP", "CP", "BT", "LPC", "PD", "NS"]);
const ORBITS = new Set(["HB", "PD", "BPC"]);
// rad (or sizes of the model): how far beside a stable row a motion begins, so that there is one to see
const BESIDE = 0.05;
// actions whose tables name the curve
const NAMING = new Set(["locus", "cycles", "switch", "sensitivities", "barriers"]);
const WAYS = [
  ["up", "to the upper bound"],
  ["down", "to the lower bound"],
  ["loop", "up, and back down"],
  ["hoop", "down, and back up"],
];

/** Return the parameters of a document's sliders but those that vary along a curve, as [name, name] choices. */
export function others(document, curve) {
  return document.sliders
    .map((p) => p.name)
    .filter((n) => !(n in curve.free))
    .map((n) => [n, n]);
}

/**
 * Return what can be done at a row of a curve: [{id, label, table, fields, args(values), why}].
 *
 * `fields` are {name, label, kind: "choice" | "number", value, options, unit}; `bounded` gives `values` the `bounds` of
 * a parameter, null for the model's own; `why` says why it cannot be done now.
 */
export function actionsFor(document, curve, row, special) {
  if (!curve) return [ofModel(document)];
  if (!["branch", "locus", "loadpath", "orbits"].includes(curve.kind)) return [];
  const found = actionsOf(document, curve, row, special),
    why = "A study computes what it names: choose a curve that was computed here.";
  return named(document, curve) ? found : found.map((a) => (NAMING.has(a.id) || a.names ? { ...a, why } : a));
}

/** Whether the session's study has a table of a curve: not of one that was opened from a file. */
function named({ tables }, { id }) {
  return !tables || tables.includes(id) || tables.includes(id.replace(/_\d+$/, ""));
}

function actionsOf(document, curve, row, special) {
  const found = [],
    choices = others(document, curve),
    point = special ? `${curve.id}:${special.label}` : "";
  if (special && curve.kind !== "loadpath") found.push(...ofPoint(special, curve, choices, point));
  if (curve.kind !== "orbits" && curve.stability?.[row] !== JUMPING) found.push(...ofRow(curve, row, special, choices));
  if (curve.kind === "orbits") found.push(motionOf(curve, row));
  if (curve.kind === "branch" && Object.keys(curve.free).length === 1)
    found.push({
      id: "barriers",
      label: "Energy barriers along this branch",
      table: "barriers",
      fields: [],
      args: () => ({ branch: curve.id }),
    });
  if (curve.kind === "branch") found.push(ofModel(document));
  return found;
}

/** Return how a branch begins that begins at no other: at a pose of the model. */
function ofModel(document) {
  const names = document.sliders.map((p) => [p.name, p.name]),
    poses = [["", "the model's own"], ...(document.keyframes ?? []).map((n) => [n, n])];
  return {
    id: "begin",
    label: "Follow the rest near a pose",
    table: "branch",
    fields: [
      { ...second(names), label: "parameter" },
      { name: "keyframe", label: "pose", kind: "choice", value: "", options: poses },
    ],
    bounded: true,
    args: ({ parameter, keyframe, bounds }) => ({ parameter, bounds, keyframe: keyframe || null }),
  };
}

function second(choices) {
  return { name: "parameter", label: "second parameter", kind: "choice", value: choices[0]?.[0], options: choices };
}

function ofPoint(special, curve, choices, point) {
  const found = [],
    free = Object.keys(curve.free)[0];
  if (FOLLOWED.has(special.kind) && choices.length)
    found.push({
      id: "locus",
      label: curve.kind === "locus" ? "Follow in one more parameter" : "Follow in two parameters",
      table: "loci",
      fields: [second(choices)],
      args: ({ parameter }) => ({ point, parameter }),
    });
  if (ORBITS.has(special.kind) && curve.kind !== "locus")
    found.push({
      id: "cycles",
      label: "Follow the cycles that begin here",
      table: "cycles",
      fields: [],
      args: () => ({ point }),
    });
  if (special.kind === "BP" && curve.kind === "branch")
    found.push({
      id: "switch",
      label: "Follow the other branches",
      table: "diagrams",
      fields: [],
      args: () => ({ parameter: free, bounds: curve.free[free], from: [point] }),
    });
  if (FOLLOWED.has(special.kind) && curve.kind !== "orbits")
    found.push({
      id: "sensitivities",
      label: "What moves this point",
      table: "sensitivities",
      fields: [],
      args: () => ({ point }),
    });
  return found;
}

function ofRow(curve, row, special, choices) {
  const here = { curve: curve.id, row: curve.own ? curve.own[row] : row },
    free = Object.keys(curve.free);
  const unstable = curve.stability?.[row] === UNSTABLE,
    found = [];
  if (free.length) {
    const why = unstable && special?.kind !== "LP" ? "Nothing rests at an unstable row." : "";
    found.push({
      id: "path",
      label: "Let the load run from here",
      table: "paths",
      why,
      args: ({ parameter, way }) => ({ row: here, parameter, values: legs(curve.free[parameter], way) }),
      fields: [
        { name: "parameter", label: "load", kind: "choice", value: free[0], options: free.map((n) => [n, n]) },
        { name: "way", label: "way", kind: "choice", value: "loop", options: WAYS },
      ],
    });
  }
  found.push({
    id: "history",
    label: "Simulate from beside this row",
    table: "histories",
    fields: motion(unstable || Boolean(special) ? 0.01 : BESIDE),
    args: ({ duration, nudge }) => ({ row: here, duration, nudge: nudge || null }),
  });
  if (choices.length)
    found.push({
      id: "branch",
      label: "Vary another parameter",
      table: "branch",
      fields: [{ ...second(choices), label: "parameter" }],
      bounded: true,
      args: ({ parameter, bounds }) => ({ row: here, parameter, bounds }),
    });
  return found;
}

/** Return the fields of a motion, nudged along the mode that grows fastest or, where none does, the slowest. */
function motion(nudge) {
  return [
    { name: "duration", label: "duration", kind: "number", value: 10, unit: "s" },
    { name: "nudge", label: "nudge", kind: "number", value: nudge, unit: "rad" },
  ];
}

function motionOf(curve, row) {
  const label = curve.special.has(row) || row === 0 || row === curve.rows - 1;
  return {
    id: "history",
    label: "Simulate from this orbit",
    table: "histories",
    fields: [],
    names: true,
    args: () => ({ row: { curve: curve.id, row } }),
    why: label ? "" : "Choose a labelled orbit, the first or the last.",
  };
}

/** Return the values that a load passes, the first one aside. */
export function legs([low, high], way) {
  return { up: [high], down: [low], loop: [high, low], hoop: [low, high] }[way];
}
