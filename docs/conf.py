"""How Sphinx builds the site: `make docs` runs it. The pages are docs/*.md, which the wheel ships as they are."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import docutils.nodes
from docutils.writers._html_base import HTMLTranslator

import mjcont
from mjcont.results.model import NOT_FOR_USERS

sys.path.insert(0, str(Path(__file__).parent))

project = "mjcont"
author = copyright = "mjcont developers"
release = version = mjcont.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_gallery.gen_gallery",
]
source_suffix = {".rst": "restructuredtext", ".md": "markdown"}
exclude_patterns = ["gallery/*", "images/README*"]
templates_path = ["_templates"]

myst_enable_extensions = ["dollarmath", "deflist"]
myst_fence_as_directive = ["math"]
myst_heading_anchors = 3

autosummary_generate = True
default_role = "code"
suppress_warnings = ["ref.python"]  # types of arguments are said in words, and words are names of several classes
autodoc_typehints = "none"  # docstrings say what arguments are, in words
autodoc_member_order = "bysource"
napoleon_google_docstring = False

sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "examples",
    "within_subsection_order": "FileNameSortKey",
    "filename_pattern": r"/plot_",
    "download_all_examples": False,
    "show_signature": False,
    "remove_config_comments": True,
    "matplotlib_animations": False,
    "min_reported_time": 15,
    "parallel": 2,
    "reset_modules": ("matplotlib",),
    "image_scrapers": ("figures.scrape",),
    "capture_repr": (),
}

html_theme = "furo"
html_title = f"mjcont {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False


def _plain(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Hand docstrings on as they are meant, before napoleon reads types into them.

    |s| is an absolute value, no substitution; a property's first line is a sentence, whatever colon it has; attributes
    are named with what they are, several at a time.
    """
    lines[:] = [line.replace("|", r"\|") for line in lines]
    if what == "property":
        lines.insert(0, "")
    if "Attributes" in lines[:-1]:
        begin = lines.index("Attributes")
        after = [i for i in range(begin + 2, len(lines) - 1) if lines[i + 1] and not lines[i + 1].strip("-")]
        end = after[0] if after else len(lines)
        lines[begin:end] = ["**Attributes**", "", *map(_entry, lines[begin + 2 : end]), ""]


def _entry(line: str) -> str:
    """Return a line of a section on attributes as one of a list."""
    name, colon, text = line.partition(" : ")
    if not line.strip() or line.startswith(" "):
        return f"  {line.strip()}".rstrip()
    return f"* ``{name}``: {text}" if colon else f"* {line}"


def _skipped(app: Any, what: str, name: str, thing: Any, skip: bool, options: Any) -> bool | None:
    """Leave out what numerics ask of a model and no user needs."""
    return True if name in NOT_FOR_USERS else None


# Formulas become MathML, which browsers draw without a script from elsewhere: docutils can, Sphinx does not ask it.


def _inline(translator: Any, node: docutils.nodes.math) -> None:
    translator.math_output, translator.math_options = "mathml", ""
    HTMLTranslator.visit_math(translator, node)


def _display(translator: Any, node: docutils.nodes.math_block) -> None:
    translator.math_output, translator.math_options = "mathml", ""
    HTMLTranslator.visit_math_block(translator, node)


def setup(app: Any) -> None:
    """Add what is above."""
    app.connect("autodoc-process-docstring", _plain, priority=400)
    app.connect("autodoc-skip-member", _skipped)
    app.add_html_math_renderer("docutils", (_inline, None), (_display, None))
    app.config.html_math_renderer = "docutils"
