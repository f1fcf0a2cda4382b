"""The report of `mjcont reproduce` and `mjcont report`, as Markdown and as a web page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING
from urllib.parse import quote

from mjcont.escapes import for_cell, for_page, for_terminal

if TYPE_CHECKING:
    from mjcont.reproduce import FigureResult, Finding

INTRODUCTION = (
    "The figures are those of Knowles, Krauskopf, Lowenberg, Neild and Thota, A Bifurcation Study of a Dynamic Model "
    "of a Landing Gear Mechanism. The text prints no parameters: ours were chosen so that its findings and ratios come "
    "out (docs/paper.md), so forces and angles are ours. Each claim of the text is checked against numbers computed "
    "here. Where one does not hold, the reason is given with it: the paper judges curves by eye where we measure a "
    "distance, and nothing but its spring and the retraction force holds our gear below overcentre, so that it has one "
    "fold near uplock where the paper has three."
)


def verdict(finding: Finding) -> str:
    """Return "holds" or "does not hold"."""
    return "holds" if finding.holds else "does not hold"


def _heading(results: Sequence[FigureResult], versions: Mapping[str, str]) -> tuple[str, str]:
    findings = [f for r in results for f in r.findings]
    studies = sum(isinstance(r.figure, str) for r in results)
    where = f"{len(results) - studies} figures" + (f" and {studies} extended studies" if studies else "")
    count = f"{sum(f.holds for f in findings)} of {len(findings)} findings hold in {where}"
    return "The paper's figures, drawn by mjcont", f"{count}. " + ", ".join(f"{k} {v}" for k, v in versions.items())


def markdown(results: Sequence[FigureResult], versions: Mapping[str, str]) -> str:
    """Return the report as Markdown."""
    title, summary = _heading(results, versions)
    lines = [f"# {title}", "", f"{summary}.", "", INTRODUCTION, ""]
    for r in results:
        lines += [f"## {for_cell(r.title)}", "", *([for_terminal(r.caption), ""] if r.caption else [])]
        if r.reason:
            lines += [f"**Failed**: {for_cell(r.reason)}", ""]
            continue
        lines += [f"![{for_cell(r.label.capitalize())}]({quote(r.image)})", ""]
        lines += ["| Claim | Computed | |", "|---|---|---|"]
        cells = [(f.claim, f.computed, verdict(f)) for f in r.findings]
        lines += ["| " + " | ".join(map(for_cell, row)) + " |" for row in cells] + [""]
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
        body += [f'<img src="{quote(r.image)}" alt="{for_page(r.label.capitalize())}">', "<table>"]
        body += ["<tr><th>Claim</th><th>Computed</th><th></th></tr>"]
        for f in r.findings:
            cells = f"<td>{for_page(f.claim)}</td><td>{for_page(f.computed)}</td>"
            body += [f'<tr>{cells}<td class="{"holds" if f.holds else "fails"}">{verdict(f)}</td></tr>']
        body += ["</table>"]
    head = f'<meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{title}</title>'
    lines = ["<!DOCTYPE html>", '<html lang="en">', f"<head>{head}<style>{_CSS}</style></head>", "<body>", *body]
    return "\n".join([*lines, "</body>", "</html>", ""])
