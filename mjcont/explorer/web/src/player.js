// Rows one after the other: a slider for the row, and a button that plays. Histories and orbits take their own time.

import { h, icon } from "./dom.js";
import { JUMPING } from "./data.js";
import { shown } from "./words.js";

const SECONDS = 6;
const FASTEST = 20;

export class Player {
  constructor(host, store) {
    Object.assign(this, { store, playing: false });
    this.button = h(
      "button",
      { class: "play", "aria-label": "Play", title: "Play (space)", onclick: () => this.toggle() },
      icon("play"),
    );
    this.slider = h("input", {
      type: "range",
      min: 0,
      step: 1,
      value: 0,
      class: "row-slider",
      "aria-label": "Row of the curve",
      oninput: () => {
        this.stop();
        store.select(store.curve, Number(this.slider.value), store.sample);
      },
    });
    this.says = h("span", { class: "says" });
    host.append(this.button, this.slider, this.says);
    for (const event of ["curve", "curves"]) store.on(event, () => this.begin());
    store.on("row", () => this.follow());
    this.begin();
  }

  begin() {
    const { curve } = this.store;
    this.slider.max = Math.max(0, (curve?.rows ?? 1) - 1);
    this.slider.disabled = this.button.disabled = !curve?.rows;
    this.follow();
  }

  follow() {
    const { curve, row, quantities } = this.store;
    if (!curve) return;
    this.slider.value = row;
    const name = curve.axes[0],
      column = curve.columns[name];
    const words = column ? shown(column[row], quantities[name], 4) : "";
    this.slider.setAttribute("aria-valuetext", `row ${row + 1} of ${curve.rows}, ${words}`);
    this.says.textContent = curve.stability?.[row] === JUMPING ? "jumping" : words;
  }

  toggle() {
    if (this.playing) this.stop();
    else this.play();
  }

  stop() {
    this.playing = false;
    this.show();
  }

  show() {
    this.button.replaceChildren(icon(this.playing ? "pause" : "play"));
    this.button.setAttribute("aria-label", this.playing ? "Pause" : "Play");
  }

  play() {
    const { store } = this,
      { curve } = store;
    if (!curve?.rows) return;
    this.playing = true;
    this.show();
    if (!curve.orbit && store.row >= curve.rows - 1) store.select(curve, 0);
    const step = curve.orbit
      ? this.ofOrbit(curve)
      : curve.kind === "history"
        ? this.ofHistory(curve)
        : this.ofRows(curve);
    const begun = performance.now();
    const tick = (now) => {
      if (!this.playing || store.curve !== curve) return this.stop();
      if (step((now - begun) / 1000) === false) return this.stop();
      return requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  /** Rows at an even pace; jumps of a load path are rows of their own. */
  ofRows(curve) {
    const first = this.store.row,
      pace = Math.max(curve.rows - 1, 1) / SECONDS;
    return (t) => {
      const row = first + Math.round(t * pace);
      this.store.select(curve, row);
      return row < curve.rows - 1;
    };
  }

  ofHistory(curve) {
    const times = curve.columns.time,
      from = times[this.store.row],
      pace = Math.max(1, times.at(-1) / FASTEST);
    let row = this.store.row;
    return (t) => {
      while (row < curve.rows - 1 && times[row] < from + pace * t) row++;
      this.store.select(curve, row);
      return row < curve.rows - 1;
    };
  }

  ofOrbit(curve) {
    const samples = Object.values(curve.orbit.columns)[0].shape[1],
      first = this.store.sample;
    return (t) => {
      const k = curve.orbit.period[0] > 0 ? Math.min(Math.max(curve.orbit.period[0], 1.2), 5) : 2;
      this.store.select(curve, this.store.row, (first + Math.round((t / k) * (samples - 1))) % (samples - 1));
    };
  }
}
