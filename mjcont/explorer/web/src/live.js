// A live session: what can be done from here, sliders, how far a computation is, stop and undo.

import { actionsFor } from "./actions.js";
import { unpack } from "./data.js";
import { h, icon, select } from "./dom.js";
import { give } from "./download.js";
import { nameInto, shown } from "./words.js";

const STEPS = 200;
const DECADES = 1000;
// digits of a value that a slider gives
const ROUNDED = 3;

export class Live {
  constructor(made, store, transport) {
    Object.assign(this, { store, transport, sections: made.side, busy: 0, notes: "" });
    this.menu = h("section", { class: "menu", "aria-label": "From here" });
    this.sliders = h("details", { class: "sliders" });
    this.build(made);
    for (const event of ["curve", "row", "curves"]) store.on(event, () => this.offer());
    store.on("parameter", (found) => this.follow(found));
    transport.on("progress", (event) => this.progress(event));
    transport.on("curve", (event) => this.arrived(event));
    transport.on("state", (event) => this.state(event));
    transport.on("spectra", ({ id, eigenvalues }) => this.store.complete(id, eigenvalues));
    for (const event of ["failed", "ended", "close"])
      transport.on(event, (found) => this.say(found?.message || "The session has ended. What is shown stays.", true));
    this.offer();
    this.fillSliders();
  }

  build({ status, actions, side }) {
    this.words = h("span", { class: "words" });
    this.bar = h("progress", { max: 1, "aria-label": "How far the computation is", hidden: true });
    this.stop = h("button", { class: "stop", hidden: true, onclick: () => this.ask("cancel") }, icon("stop"), " Stop");
    this.undo = h("button", { class: "undo", disabled: true, onclick: () => this.back() }, icon("undo"), " Undo");
    status.append(this.bar, this.words, this.stop);
    actions.prepend(
      this.undo,
      h("button", { class: "take", onclick: () => this.take("toml", "study.toml", "text/plain") }, "study.toml"),
      h("button", { class: "take", onclick: () => this.take("page", "page.html", "text/html") }, "page.html"),
    );
    side.querySelector(".values").before(this.menu);
    side.querySelector(".held").before(this.sliders);
  }

  // -- what can be done -----------------------------------------------------------------------------------------

  offer() {
    const { document, curve, row, special } = this.store,
      found = actionsFor(document, curve, row, special);
    const key =
      found.map((a) => `${a.id}${a.label}${a.why ?? ""}`).join("|") + (curve?.id ?? "") + (special?.label ?? "");
    if (key === this.offered) return;
    this.offered = key;
    this.menu.hidden = !found.length;
    this.menu.replaceChildren(h("h3", {}, "From here"), ...found.map((action) => this.entry(action)));
  }

  entry(action) {
    const values = Object.fromEntries(action.fields.map((f) => [f.name, f.value]));
    // the row is that of the click, not the one for which the menu was made
    const run = () => {
      const { document, curve, row, special } = this.store,
        now = actionsFor(document, curve, row, special).find((a) => a.id === action.id);
      if (now && !now.why) this.add(now.table, now.args(values));
    };
    const [ends, show] = action.bounded ? this.bounds(values) : [[], () => undefined];
    const named = (f) => (f.kind === "choice" ? "" : h("span", {}, f.label));
    const button = h(
      "button",
      { class: "do", "data-action": action.id, disabled: Boolean(action.why), title: action.why || null, onclick: run },
      action.label,
    );
    const fields = action.fields.map((f) =>
      h("label", {}, named(f), this.field(f, values, show), f.unit ? h("span", { class: "unit" }, f.unit) : ""),
    );
    return h(
      "div",
      { class: `entry ${fields.length + ends.length > 1 ? "wide" : ""}` },
      button,
      ...fields,
      ...ends,
      action.why ? h("p", { class: "why" }, action.why) : "",
    );
  }

  /** Return fields for the ends of a branch, and what fits them to another parameter; empty ones are the model's. */
  bounds(values) {
    const given = ["", ""],
      unit = h("span", { class: "unit" });
    const slider = () => this.store.document.sliders.find((p) => p.name === values.parameter);
    const take = () => {
      const p = slider(),
        own = [p.lower, p.upper];
      values.bounds = given.every((v) => v === "")
        ? null
        : given.map((v, k) => (v === "" ? own[k] : Number(v) / p.shown.scale));
    };
    const inputs = ["low", "high"].map((word, k) => {
      const change = (e) => {
        given[k] = e.target.value;
        take();
      };
      return h("input", { type: "number", step: "any", "aria-label": word, onchange: change });
    });
    const show = () => {
      const p = slider();
      if (!p) return;
      for (const [k, input] of inputs.entries())
        input.placeholder = String(Number(([p.lower, p.upper][k] * p.shown.scale).toPrecision(3)));
      unit.textContent = p.shown.unit;
      take();
    };
    show();
    const ends = h("div", { class: "ends" }, h("label", {}, "low", inputs[0]), h("label", {}, "high", inputs[1], unit));
    return [[ends], show];
  }

  field(f, values, changed) {
    const take = (value) => {
      values[f.name] = value;
      changed();
    };
    if (f.kind === "choice") return select(f.label, f.options, f.value, take);
    return h("input", {
      type: "number",
      value: f.value,
      step: "any",
      "aria-label": f.label,
      onchange: (e) => take(Number(e.target.value)),
    });
  }

  async add(table, args) {
    const found = await this.ask("add", { table, args });
    if (!found) return;
    this.hold(found.sliders);
    const raws = [found.curve, ...(found.more ?? [])],
      made = raws.map((raw) => this.store.put(raw, found.quantities));
    const shownFirst = made.find((c) => c.rows);
    if (shownFirst) this.store.select(shownFirst, shownFirst.start ?? 0);
    if (shownFirst?.kind === "history" || shownFirst?.kind === "loadpath") this.store.tell("play");
  }

  /** A bar of the tornado: follow its point in that parameter. */
  follow({ name, curve }) {
    if (curve.parent && curve.point) this.add("loci", { point: `${curve.parent}:${curve.point}`, parameter: name });
  }

  async back() {
    const document = await this.ask("undo");
    if (document) this.replace(document);
  }

  async reload() {
    const document = await this.ask("document");
    if (document) this.replace(document);
  }

  replace(document) {
    this.store.replace(document);
    this.offered = null;
    this.store.tell("curves");
    this.store.tell("curve");
    this.store.tell("row");
    this.fillSliders();
  }

  // -- sliders --------------------------------------------------------------------------------------------------

  /** Take other sliders: what varies along a curve has none. */
  hold(sliders) {
    if (!sliders) return;
    this.store.document.sliders = sliders;
    this.fillSliders();
  }

  fillSliders() {
    const { sliders } = this.store.document;
    this.sliders.hidden = !sliders.length;
    const open = this.sliders.open;
    this.sliders.replaceChildren(
      h("summary", {}, "Parameters"),
      ...sliders.filter((p) => !p.free).map((p) => this.slider(p)),
    );
    this.sliders.open = open;
  }

  slider(p) {
    const log = p.lower > 0 && p.upper / p.lower > DECADES,
      name = h("span", { class: "name" }),
      { scale, unit } = p.shown;
    const inUnit = (v) => String(Number((v * scale).toPrecision(6)));
    const give = async (value) => {
      const document = await this.ask("set", { name: p.name, value: Math.min(p.upper, Math.max(p.lower, value)) });
      if (document?.curves) this.replace(document);
      else if (document) await this.reload();
      else this.fillSliders();
    };
    const value = h("input", {
      type: "number",
      step: "any",
      value: inUnit(p.value),
      "aria-label": unit ? `${p.name} in ${unit}` : p.name,
      onchange: () => (value.value === "" ? this.fillSliders() : give(Number(value.value) / scale)),
    });
    const there = (v) =>
      log ? Math.log(v / p.lower) / Math.log(p.upper / p.lower) : (v - p.lower) / (p.upper - p.lower);
    const back = (t) => (log ? p.lower * (p.upper / p.lower) ** t : p.lower + t * (p.upper - p.lower));
    const round = (v) => Number((v * scale).toPrecision(ROUNDED)) / scale;
    nameInto(name, p.shown, p.name);
    const input = h("input", {
      type: "range",
      min: 0,
      max: STEPS,
      step: 1,
      value: Math.round(STEPS * Math.min(1, Math.max(0, there(p.value)))),
      "aria-label": p.name,
      "aria-valuetext": shown(p.value, p.shown, 4),
      oninput: () => {
        const now = round(back(input.value / STEPS));
        value.value = inUnit(now);
        input.setAttribute("aria-valuetext", shown(now, p.shown, 4));
      },
      onchange: () => give(round(back(input.value / STEPS))),
    });
    return h("div", { class: "slider" }, name, input, value, h("span", { class: "unit" }, unit));
  }

  // -- how it goes ----------------------------------------------------------------------------------------------

  async ask(op, args = {}) {
    const waits = op === "add" || op === "set" || op === "undo";
    if (waits && this.busy) return null;
    if (waits) this.working(1);
    try {
      const found = await this.transport.request(op, args);
      if (waits) this.say(this.notes);
      return found ?? {};
    } catch (error) {
      this.say(String(error.message ?? error), true);
      return null;
    } finally {
      if (waits) this.working(-1);
    }
  }

  working(change) {
    this.busy += change;
    this.bar.hidden = this.stop.hidden = !this.busy;
    this.bar.removeAttribute("value");
    this.menu.toggleAttribute("inert", this.busy > 0);
    this.sliders.toggleAttribute("inert", this.busy > 0);
    this.undo.disabled = this.busy > 0 || !this.store.canUndo;
    if (!this.busy) this.store.tell("partial", null);
  }

  progress({ what, name, share, done, seconds, found }) {
    if (!this.busy) this.working(0);
    if (Number.isFinite(share)) this.bar.value = share;
    const points = Object.entries(found ?? {})
      .map(([kind, n]) => `${n} ${kind}`)
      .join(", ");
    this.words.classList.remove("bad");
    this.words.textContent = [
      what || name,
      done ? `${Math.round(done)} points` : "",
      points,
      seconds ? `${seconds.toFixed(1)} s` : "",
    ]
      .filter(Boolean)
      .join(", ");
  }

  arrived({ curve, partial, quantities, sliders }) {
    this.hold(sliders);
    if (!partial) this.store.put(curve, quantities);
    else
      this.store.tell("partial", {
        id: curve.id,
        columns: Object.fromEntries(Object.entries(curve.columns).map(([n, c]) => [n, unpack(c)])),
      });
  }

  state({ can_undo: can, undo, running, notes, tables }) {
    this.store.document.tables = tables;
    this.offer();
    this.store.canUndo = can;
    this.undo.disabled = this.busy > 0 || !can;
    this.undo.title = undo ? `Undo ${undo}` : "";
    this.bar.hidden = this.stop.hidden = !running && !this.busy;
    this.notes = (notes ?? []).join(" ");
    if (!running && !this.busy && !this.words.classList.contains("bad")) this.say(this.notes);
  }

  say(text, bad = false) {
    this.words.textContent = text;
    this.words.classList.toggle("bad", bad);
  }

  async take(op, name, type) {
    const found = await this.ask(op);
    const text = typeof found === "string" ? found : (found?.[op] ?? found?.text ?? found?.html);
    if (text) give(name, text, type);
  }
}
