// Small helpers to make elements.

const SVG = "http://www.w3.org/2000/svg";

/** Return an HTML element with attributes, listeners (`on...`) and children. */
export function h(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "class") element.className = value;
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(key, value);
  }
  element.append(...children.filter((c) => c !== null && c !== undefined));
  return element;
}

/** Return an SVG element with attributes. */
export function s(name, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** Return a select whose options are [value, label] pairs. */
export function select(label, options, chosen, change) {
  const element = h("select", { "aria-label": label, onchange: () => change(element.value) });
  for (const [value, text] of options) element.append(h("option", { value, selected: value === chosen }, text));
  return element;
}

// drawn in a square of 16, in the colour of the text
const ICONS = {
  take: "M8 2v8M4.5 6.8L8 10.3l3.5-3.5M2.5 13.5h11",
  all: "M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3",
  theme: "M8 2.5a5.5 5.5 0 1 0 0 11a5.5 5.5 0 1 0 0-11M8 2.5v11M10 4v8M12 5.8v4.4",
  play: "M5 3l8 5l-8 5z",
  pause: "M5.2 3v10M10.8 3v10",
  stop: "M4 4h8v8H4z",
  undo: "M6 3L3 6l3 3M3 6h6.5a3.5 3.5 0 0 1 0 7H6",
};

/** Return an icon. */
export function icon(name) {
  return s(
    "svg",
    { class: `glyph ${name}`, viewBox: "0 0 16 16", "aria-hidden": "true" },
    s("path", { d: ICONS[name] }),
  );
}
