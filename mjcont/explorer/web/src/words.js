// Words and numbers as people read them: names with subscripts, units, digits.

const MINUS = "\u2212";

/** Return what a quantity is called, in one line: "θ ov", "gravity angle". */
export function plainName(quantity, name) {
  const parts = quantity?.label ?? [[name, "", ""]];
  return parts
    .map(([head, below, behind]) => `${head}${below ? `_${below.replaceAll(" ", "_")}` : ""}${behind}`)
    .join(" ");
}

/** Put a name into an HTML element, subscripts below. */
export function nameInto(element, quantity, name) {
  element.textContent = "";
  for (const [k, [head, below, behind]] of (quantity?.label ?? [[name, "", ""]]).entries()) {
    element.append((k ? " " : "") + head);
    if (below) {
      const sub = document.createElement("sub");
      sub.textContent = below;
      element.append(sub);
    }
    if (behind) element.append(behind);
  }
}

/** Put a name with its unit into an SVG text, subscripts below. */
export function nameIntoSvg(text, quantity, name, suffix = "") {
  text.textContent = "";
  const add = (words, below, back) => {
    const span = document.createElementNS("http://www.w3.org/2000/svg", "tspan");
    span.textContent = words;
    if (below) {
      span.setAttribute("dy", "0.28em");
      span.setAttribute("font-size", "0.75em");
    } else if (back) span.setAttribute("dy", "-0.21em");
    text.append(span);
  };
  let lowered = false;
  for (const [k, [head, below, behind]] of (quantity?.label ?? [[name, "", ""]]).entries()) {
    add((k ? " " : "") + head, false, lowered);
    lowered = false;
    if (below) {
      add(below, true, false);
      lowered = true;
    }
    if (behind) {
      add(behind, false, lowered);
      lowered = false;
    }
  }
  const unit = quantity?.unit ? ` [${quantity.unit}]` : "";
  if (unit + suffix) add(unit + suffix, false, lowered);
}

/** Return a number with so many digits that carry meaning; what rounding leaves of nothing is 0. */
export function digits(value, count = 6) {
  if (!Number.isFinite(value)) return value === Infinity ? "∞" : value === -Infinity ? `${MINUS}∞` : "–";
  if (Math.abs(value) < 1e-12) return "0";
  const size = Math.abs(value);
  const text = size >= 1e6 || size < 1e-4 ? exponent(value, count) : String(Number(value.toPrecision(count)));
  return text.replaceAll("-", MINUS);
}

function exponent(value, count) {
  const [head, power] = value.toExponential(count - 1).split("e");
  return `${Number(head)}e${Number(power)}`;
}

/** Return a value in SI as it is shown, with its unit. */
export function shown(value, quantity, count = 6) {
  const text = digits(value * (quantity?.scale ?? 1), count),
    unit = quantity?.unit ?? "";
  return unit === "°" ? `${text}°` : unit ? `${text} ${unit}` : text;
}

const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** Return the label of an axis's number; far powers of ten are written as such. */
export function tick(value) {
  const power = Math.round(Math.log10(Math.abs(value))),
    far = power >= 4 || power <= -3;
  if (!far || value === 0 || Math.abs(Math.abs(value) / 10 ** power - 1) > 1e-9) return digits(value, 4);
  const raised = [...String(Math.abs(power))].map((d) => RAISED[d]).join("");
  return `${value < 0 ? MINUS : ""}10${power < 0 ? "⁻" : ""}${raised}`;
}
