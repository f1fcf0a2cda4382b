// What can be taken along: the study, the page, the picture of each panel.

import { h, icon } from "./dom.js";

const KEPT = [
  "fill",
  "fill-opacity",
  "stroke",
  "stroke-width",
  "stroke-dasharray",
  "stroke-linecap",
  "stroke-linejoin",
  "stroke-opacity",
  "opacity",
  "font-family",
  "font-size",
  "font-weight",
  "text-anchor",
  "visibility",
];

/** Hand out a text as a file. */
export function give(name, text, type) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const link = h("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** Return an SVG element as a file of its own: its style is written into it. */
export function svgText(svg, marker = null) {
  const copy = svg.cloneNode(true),
    own = [svg, ...svg.querySelectorAll("*")],
    made = [copy, ...copy.querySelectorAll("*")];
  for (const [i, element] of own.entries()) {
    made[i].removeAttribute("class");
    if (!element.isConnected) continue;
    const style = getComputedStyle(element);
    for (const name of KEPT) {
      const value = style.getPropertyValue(name);
      if ((value && value !== "none") || name === "fill" || name === "stroke") made[i].setAttribute(name, value);
    }
    made[i].removeAttribute("style");
  }
  if (marker) copy.append(marker);
  const [, , width, height] = copy.getAttribute("viewBox").split(" ").map(Number);
  const scale = width < 50 ? 600 / Math.max(width, height) : 1;
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", Math.round(width * scale));
  copy.setAttribute("height", Math.round(height * scale));
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(copy)}\n`;
}

/** Return the button that hands out a panel's picture. */
export function pictureButton(panel, picture) {
  const label = `Save the picture of ${panel.element.getAttribute("aria-label").toLowerCase()} as SVG`;
  return h(
    "button",
    {
      class: "icon",
      title: "picture.svg",
      "aria-label": label,
      onclick: () => give(`${panel.name}.svg`, svgText(picture()), "image/svg+xml"),
    },
    icon("take"),
  );
}
