// The side: what the row is, its values, the special points, the parameters that are held, notes.

import { MARGINAL, STABILITY } from "./data.js";
import { h, select } from "./dom.js";
import { nameInto, shown } from "./words.js";

const MOST_BUTTONS = 6;

export class Readout {
  constructor(host, store) {
    Object.assign(this, { store });
    [this.head, this.where] = [h("span"), h("small")];
    this.title = h("h2", { class: "selection" }, this.head, this.where);
    this.badge = h("span", { class: "badge" });
    this.live = h("p", { class: "visually-hidden", "aria-live": "polite" });
    this.table = h("tbody");
    this.about = h("div", { class: "about", hidden: true });
    this.chips = h("div", { class: "chips", role: "group", "aria-label": "Special points" });
    this.held = h("details", { class: "held" });
    this.notes = h("details", { class: "notes" });
    this.curves = h("div", { class: "curves", role: "group", "aria-label": "Curves" });
    this.heading = h("div", { class: "heading" }, this.title, this.badge);
    const head = h(
      "thead",
      { class: "visually-hidden" },
      h("tr", {}, h("th", { scope: "col" }, "quantity"), h("th", { scope: "col" }, "value")),
    );
    this.values = h(
      "table",
      { class: "values" },
      h("caption", { class: "visually-hidden" }, "Values of the selected row"),
      head,
      this.table,
    );
    host.append(this.curves, this.heading, this.live, this.chips, this.about, this.values);
    this.after = [this.held, this.notes];
    for (const event of ["curves", "curve"]) store.on(event, () => this.begin());
    store.on("row", () => this.follow());
    this.begin();
  }

  begin() {
    const { curve, curves, quantities } = this.store;
    this.offerCurves(
      curves.filter((c) => c.rows),
      curve,
    );
    for (const part of [this.badge, this.held, this.notes, this.heading, this.values]) part.hidden = !curve;
    if (!curve) return;
    this.names = Object.keys(curve.columns).filter((n) => n !== "time" || curve.kind === "history");
    this.cells = this.names.map((name) => {
      const head = h("th", { scope: "row" }),
        cell = h("td");
      nameInto(head, quantities[name], name);
      return { cell, row: h("tr", {}, head, cell), name };
    });
    this.table.replaceChildren(...this.cells.map((c) => c.row));
    this.chips.replaceChildren(
      ...curve.specials
        .filter((p) => p.kind !== "EP")
        .map((p) =>
          h(
            "button",
            {
              class: "chip",
              "data-row": p.row,
              title: p.name,
              "aria-label": `${p.label}, ${p.name}`,
              onclick: () => this.store.select(curve, p.row),
            },
            p.label,
          ),
        ),
    );
    this.fillHeld(curve, quantities);
    this.fillNotes(curve);
    this.follow();
  }

  /** Offer the curves: a button each, or a list where they are many. */
  offerCurves(curves, now) {
    const go = (c) => this.store.select(c, c === now ? this.store.row : this.store.rowOf(c));
    const button = (c) =>
      h("button", { class: `curve-chip ${c.kind}`, "aria-pressed": String(c === now), onclick: () => go(c) }, c.name);
    const list = () =>
      select(
        "Curve",
        curves.map((c) => [c.id, c.name]),
        now?.id,
        (id) => go(curves.find((c) => c.id === id)),
      );
    this.curves.replaceChildren(
      ...(curves.length < 2 ? [] : curves.length > MOST_BUTTONS ? [list()] : curves.map(button)),
    );
  }

  fillHeld(curve, quantities) {
    const held = Object.entries(curve.fixed ?? {}).filter(([n]) => !curve.columns[n]);
    this.held.hidden = !held.length;
    const rows = held.map(([name, value]) => {
      const head = h("th", { scope: "row" }),
        slider = this.store.document.sliders.find((x) => x.name === name);
      nameInto(head, slider?.shown ?? quantities[name], name);
      return h("tr", {}, head, h("td", {}, value === null ? "–" : shown(value, slider?.shown ?? quantities[name])));
    });
    this.held.replaceChildren(
      h("summary", {}, `Held: ${held.length} ${held.length === 1 ? "parameter" : "parameters"}`),
      h("table", { class: "values" }, h("tbody", {}, ...rows)),
    );
  }

  fillNotes(curve) {
    const lines = [...curve.ends.map((e) => e.text), ...curve.notes].filter(Boolean);
    this.notes.hidden = !lines.length;
    this.notes.replaceChildren(h("summary", {}, "How it ends"), ...[...new Set(lines)].map((text) => h("p", {}, text)));
  }

  follow() {
    const { curve, row, quantities, special } = this.store;
    if (!curve) return;
    for (const { cell, name } of this.cells) {
      const text = shown(curve.columns[name][row], quantities[name]);
      if (cell.textContent !== text) cell.textContent = text;
    }
    const code = curve.stability?.[row],
      word = curve.stability ? STABILITY[code] : "";
    this.head.textContent = special ? `${special.label}, ${special.name}` : curve.name;
    this.where.textContent = `row ${row + 1} of ${curve.rows}${special ? `, ${curve.name}` : ""}`;
    this.badge.hidden = !word || (special && code === MARGINAL);
    this.badge.textContent = word;
    this.badge.className = `badge ${word}`;
    this.about.hidden = !special;
    if (special) this.about.textContent = special.facts;
    for (const chip of this.chips.children) chip.setAttribute("aria-pressed", String(Number(chip.dataset.row) === row));
    if (this.said !== special?.label) this.live.textContent = special ? `${special.label}, ${special.name}` : "";
    this.said = special?.label;
  }
}
