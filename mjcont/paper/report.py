"""The report of `mjcont reproduce` and `mjcont report`, as Markdown and as a web page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from urllib.parse import quote

from mjcont.outside.escapes import for_cell, for_page, for_terminal
from mjcont.paper.findings import FigureResult, Finding

INTRODUCTION = (
    "The figures are those of Knowles, Krauskopf, Lowenberg, Neild and Thota, A Bifurcation Study of a Dynamic Model "
    "of a Landing Gear Mechanism. The text prints no parameters: ours were chosen so that its findings and ratios come "
    "out (docs/paper.md), so forces and angles are ours. Each claim of the text is checked against numbers computed "
    "here; where the text judges curves by eye, they are alike if they lie nowhere further apart than a line is wide. "
    "Two gears show Section IV, and a column says which one shows a claim. Nothing but its spring and the "
    "retraction force holds the first one, nose_gear, below overcentre: it has one fold near uplock where the paper "
    "has three. The gear that locks, nose_gear_locking, has the three, and stays locked while the retraction force "
    "falls to FP2. It costs locklinks of a tenth of a kilogram, a strut of 4.6 m, a crank of 12 mm, and elastic joints "
    "of 1e8 N/m where 1e6 N/m is enough for the first."
)


def verdict(finding: Finding) -> str:
    """Return "holds" or "does not hold"."""
    return "holds" if finding.holds else "does not hold"


def headline(results: Sequence[FigureResult]) -> str:
    """Return how many findings hold and what failed, whose findings nobody knows, as a clause."""
    drawn = [r for r in results if not r.reason]
    findings = [f for r in drawn for f in r.findings]
    studies = sum(isinstance(r.figure, str) for r in drawn)
    where = f"{len(drawn) - studies} figures" + (f" and {studies} extended studies" if studies else "")
    failed = [r.label for r in results if r.reason]
    rest = f"; {len(failed)} failed, with findings unknown: {', '.join(failed)}" if failed else ""
    return f"{sum(f.holds for f in findings)} of {len(findings)} findings hold in {where}{rest}"


def _heading(results: Sequence[FigureResult], versions: Mapping[str, str]) -> tuple[str, str]:
    made_with = ", ".join(f"{k} {v}" for k, v in versions.items())
    return "The paper's figures, drawn by mjcont", f"{headline(results)}. {made_with}"


def _table(findings: Sequence[Finding]) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows, with the model that shows a finding where a figure is drawn for several."""
    named = any(f.model for f in findings)
    heads = ["Claim", "Computed", *(["Model"] if named else []), ""]
    return heads, [[f.claim, f.computed, *([f.model] if named else []), verdict(f)] for f in findings]


def _pages(r: FigureResult) -> list[tuple[str, str]]:
    """Return what to call each interactive twin of a figure, and its file."""
    return [(f"{r.label}, {middle}" if (middle := page.partition(".")[2].removesuffix("html").strip(".")) else r.label,
             page) for page in r.pages]


def markdown(results: Sequence[FigureResult], versions: Mapping[str, str]) -> str:
    """Return the report as Markdown."""
    title, summary = _heading(results, versions)
    lines = [f"# {title}", "", f"{summary}.", "", INTRODUCTION, ""]
    for r in results:
        lines += [f"## {for_cell(r.title)}", "", *([for_terminal(r.caption), ""] if r.caption else [])]
        if r.reason:
            lines += [f"**Failed**: {for_cell(r.reason)}", ""]
            continue
        heads, rows = _table(r.findings)
        lines += [f"![{for_cell(r.label.capitalize())}]({quote(r.image)})", ""]
        links = ", ".join(f"[{for_cell(name)}]({quote(file)})" for name, file in _pages(r))
        lines += [f"To look at: {links}.", ""] if r.pages else []
        lines += ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
        lines += ["| " + " | ".join(map(for_cell, row)) + " |" for row in rows] + [""]
    return "\n".join(lines)


_CSS = """
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 60rem; margin: 2rem auto;
       padding: 0 1rem }
h1 { font-size: 1.6rem } h2 { font-size: 1.2rem; margin-top: 3rem }
.versions { color: #666; font-size: .9rem }
img { max-width: 100%; height: auto; display: block; margin: 1rem 0 }
table { border-collapse: collapse; width: 100%; font-size: .92rem }
th, td { text-align: left; vertical-align: top; padding: .45rem .6rem; border-bottom: 1px solid #ddd }
td:last-child { white-space: nowrap; font-weight: 600 }
.holds { color: #1a6b3c } .fails { color: #a8201a }
"""


def as_html(results: Sequence[FigureResult], versions: Mapping[str, str]) -> str:
    """Return the report as a page that stands beside its pictures."""
    title, summary = (for_page(t) for t in _heading(results, versions))
    body = [f"<h1>{title}</h1>", f'<p class="versions">{summary}.</p>', f"<p>{for_page(INTRODUCTION)}</p>"]
    for r in results:
        anchor = r.image.removesuffix(".png")
        body += [f'<h2 id="{for_page(anchor)}">{for_page(r.title)}</h2>']
        body += [f"<p>{for_page(r.caption)}</p>"] if r.caption else []
        if r.reason:
            body += [f'<p class="fails">Failed: {for_page(r.reason)}</p>']
            continue
        picture = f'<img src="{quote(r.image)}" alt="{for_page(r.label.capitalize())}">'
        links = ", ".join(f'<a href="{quote(file)}">{for_page(name)}</a>' for name, file in _pages(r))
        body += [f'<a href="{quote(r.pages[0])}">{picture}</a>' if r.pages else picture]
        body += [f"<p>To look at, with the mechanism beside its curves: {links}.</p>"] if r.pages else []
        body += ["<table>"]
        heads, rows = _table(r.findings)
        body += ["<tr>" + "".join(f"<th>{h}</th>" for h in heads) + "</tr>"]
        for f, row in zip(r.findings, rows, strict=True):
            cells = "".join(f"<td>{for_page(c)}</td>" for c in row[:-1])
            body += [f'<tr>{cells}<td class="{"holds" if f.holds else "fails"}">{row[-1]}</td></tr>']
        body += ["</table>"]
    head = f'<meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{title}</title>'
    lines = ["<!DOCTYPE html>", '<html lang="en">', f"<head>{head}<style>{_CSS}</style></head>", "<body>", *body]
    return "\n".join([*lines, "</body>", "</html>", ""])
