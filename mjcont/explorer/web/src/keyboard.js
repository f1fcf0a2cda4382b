// Keys: arrows along the curve, space plays, n and p go to the next and the previous special point.

const STEPS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 25, PageDown: -25 };
const OWN = "input, select, textarea, summary, [contenteditable]";

/** Listen to keys of a page, or of a notebook's cell alone, unless an element has a use for them itself. */
export function listen(root, store, player) {
  root.tabIndex = -1;
  const whole = root.id === "explorer";
  (whole ? root.ownerDocument : root).addEventListener("keydown", (event) => {
    if (!root.isConnected || event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.(OWN)) return;
    if (event.target.closest?.("button") && (event.key === " " || event.key === "Enter")) return;
    const { curve, row } = store;
    if (!curve) return;
    if (event.key in STEPS) store.select(curve, row + STEPS[event.key] * (event.shiftKey ? 10 : 1), store.sample);
    else if (event.key === "Home") store.select(curve, 0);
    else if (event.key === "End") store.select(curve, curve.rows - 1);
    else if (event.key === " ") player.toggle();
    else if (event.key === "n" || event.key === "p") special(store, event.key === "n" ? 1 : -1);
    else return;
    if (event.key !== " ") player.stop();
    event.preventDefault();
    if (!whole) event.stopPropagation();
  });
}

function special(store, way) {
  const rows = store.curve.specials
    .filter((p) => p.kind !== "EP")
    .map((p) => p.row)
    .sort((a, b) => way * (a - b));
  const next = rows.find((r) => way * (r - store.row) > 0);
  if (next !== undefined) store.select(store.curve, next);
}
