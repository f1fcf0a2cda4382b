"""The explorer's page in a headless browser, and what it logged and asked for."""

from __future__ import annotations

from dataclasses import dataclass, field

# software rendering: a machine of tests has no graphics card
GRAPHICS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
            "--disable-gpu-rasterization"]
NO_GRAPHICS = ["--no-sandbox", "--disable-gpu", "--disable-3d-apis"]


@dataclass
class Tab:
    """A page in the browser, what it logged, and what it asked for."""

    page: object
    console: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def __call__(self, script: str, argument: object = None) -> object:
        """Return what a script gives; `e` is the explorer."""
        return self.page.evaluate(f"(a) => {{ const e = document.getElementById('explorer').explorer; {script} }}",
                                  argument)

    def where(self, line: int, row: int) -> tuple[float, float]:
        """Return where a row of a line of the diagram is on the screen."""
        x, y = self("const d = e.plots.diagram, l = d.lines[a[0]], b = d.plot.svg.getBoundingClientRect();"
                    "return [b.left + l.px[a[1]], b.top + l.py[a[1]]];", [line, row])
        return x, y

    def selected(self) -> tuple[str, int]:
        """Return the curve and the row that are selected."""
        found = self("return [e.store.curve.id, e.store.row];")
        return found[0], found[1]

    def settle(self) -> None:
        """Wait until what was asked for has been drawn."""
        self.page.evaluate("() => new Promise((d) => requestAnimationFrame(() => requestAnimationFrame(d)))")
