// Sensitivities as a tornado: how far a point moves within each parameter's tolerance; a bar is a button.

import { h, select } from "./dom.js";
import { nameInto, plainName, shown } from "./words.js";

const MOST = 14;

export class Tornado {
  constructor(panel, store) {
    Object.assign(this, { panel, store, quantity: null, chosen: null });
    this.list = h("ol", { class: "tornado" });
    panel.body.append(this.list);
    for (const event of ["curves", "curve"]) store.on(event, () => this.draw());
    this.draw();
  }

  draw() {
    const every = this.store.curvesOf("sensitivities"),
      found = this.chosen && every.includes(this.chosen) ? this.chosen : every.at(-1);
    this.panel.show(Boolean(found));
    if (!found) return;
    const { quantities } = this.store;
    if (!found.quantities.includes(this.quantity)) this.quantity = found.quantities[0];
    this.panel.title(`What moves ${found.point || "the point"}`);
    this.panel.tools.replaceChildren(
      every.length > 1
        ? select(
            "Sensitivities of",
            every.map((c) => [c.id, c.point || c.name]),
            found.id,
            (id) => {
              this.chosen = every.find((c) => c.id === id);
              this.draw();
            },
          )
        : "",
      found.quantities.length > 1
        ? select(
            "What moves",
            found.quantities.map((n) => [n, plainName(quantities[n], n)]),
            this.quantity,
            (name) => {
              this.quantity = name;
              this.draw();
            },
          )
        : "",
    );
    const column = found.quantities.indexOf(this.quantity),
      width = found.quantities.length;
    const bars = found.parameters.map((name, i) => ({ name, change: found.changes[i * width + column] }));
    bars.sort((a, b) => Math.abs(b.change) - Math.abs(a.change));
    const largest = Math.abs(bars[0]?.change) || 1;
    this.list.replaceChildren(...bars.slice(0, MOST).map((bar) => this.bar(found, bar, largest)));
  }

  bar(found, { name, change }, largest) {
    const { quantities } = this.store,
      moved = quantities[this.quantity],
      tolerance = shown(found.tolerances[name], quantities[name], 3);
    const label = h("span", { class: "bar-name" }),
      part = (100 * Math.abs(change)) / largest;
    nameInto(label, quantities[name], name);
    label.append(h("small", {}, `+ ${tolerance}`));
    const fill = h("span", { class: `bar-fill ${change < 0 ? "minus" : "plus"}` });
    fill.style.width = `${Math.max(part / 2, 0.4)}%`;
    const words = `${change < 0 ? "\u2212" : change > 0 ? "+" : ""}${shown(Math.abs(change), moved, 3)}`;
    const [cause, effect] = [plainName(quantities[name], name), plainName(moved, this.quantity)];
    const text = `${cause} + ${tolerance} moves ${effect} by ${words}`;
    return h(
      "li",
      {},
      h(
        "button",
        {
          class: "bar",
          title: text,
          "aria-label": text,
          onclick: () => this.store.tell("parameter", { name, curve: found }),
        },
        label,
        h("span", { class: "bar-track" }, fill),
        h("span", { class: "bar-value" }, words),
      ),
    );
  }
}
