// The panels and where they stand: a grid on a wide screen, one below the other on a phone.

import { h } from "./dom.js";
import { pictureButton } from "./download.js";

/** Return a panel: {element, body, tools, foot, title(text), say(text), show(there)}. */
export function panel(name, title, area) {
  const heading = h("h2", { class: "panel-title" }, title),
    tools = h("div", { class: "tools" }),
    empty = h("p", { class: "empty", hidden: true }),
    body = h("div", { class: "panel-body" }, empty),
    foot = h("div", { class: "foot" });
  const head = h("header", { class: "panel-head" }, heading, tools);
  const element = h("section", { class: `panel ${area}`, "aria-label": title, "data-panel": name }, head, body, foot);
  const made = {
    name,
    element,
    body,
    tools,
    foot,
    title(text) {
      if (heading.textContent === text) return;
      heading.textContent = text;
      element.setAttribute("aria-label", text);
    },
    /** Say in words why there is nothing to see; nothing where there is. */
    say(text) {
      empty.textContent = text;
      empty.hidden = !text;
    },
    show(there) {
      element.hidden = !there;
    },
  };
  return made;
}

/** Give a panel the button that hands out its picture. */
export function withPicture(made, picture) {
  made.element.querySelector(".panel-head").append(pictureButton(made, picture));
}

/** Build the page's frame into `root`. */
export function frame(root, title) {
  const actions = h("div", { class: "actions" });
  const status = h("div", { class: "status", role: "status" });
  const panels = {
    mechanism: panel("mechanism", "Mechanism", "large"),
    diagram: panel("diagram", "Diagram", "large"),
    locus: panel("locus", "Two parameters", "small"),
    spectrum: panel("spectrum", "Eigenvalues", "small"),
    motion: panel("motion", "Motion", "small"),
    tornado: panel("tornado", "Sensitivities", "small"),
    grid: panel("grid", "Map", "small"),
  };
  const player = h("div", { class: "player" });
  panels.mechanism.foot.append(player);
  const { mechanism, diagram, ...others } = panels;
  const side = h("aside", { class: "side", "aria-label": "Selection" });
  const bar = h(
    "header",
    { class: "bar-top" },
    h("h1", {}, h("span", { class: "brand" }, "mjcont"), h("span", { class: "model" }, title)),
    status,
    actions,
  );
  const small = h("div", { class: "row-small" }, ...Object.values(others).map((p) => p.element));
  const large = h("div", { class: "row-large" }, mechanism.element, diagram.element);
  root.classList.add("mjx");
  root.replaceChildren(bar, h("main", { class: "stage" }, h("div", { class: "panels" }, large, small), side));
  const arrange = () => {
    const shown = ["diagram", "locus", "motion", "grid", "tornado"]
      .map((n) => panels[n].element)
      .find((p) => !p.hidden);
    for (const { element } of Object.values(panels)) {
      const row = element === shown || element === mechanism.element ? large : small;
      if (element.parentElement !== row) row.append(element);
    }
    small.hidden = ![...small.children].some((p) => !p.hidden);
  };
  return { panels, side, player, actions, status, arrange };
}
