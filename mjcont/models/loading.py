"""Reading MJCF into models that a Mechanism can own: sources, and the spec behind them."""

from __future__ import annotations

import re
from importlib import resources
from pathlib import Path
from typing import NamedTuple

import mujoco

from mjcont.errors import ModelError, did_you_mean
from mjcont.models import assets, sources
from mjcont.models.mjcf import exact_text
from mjcont.models.quiet import heard

_OTHER_FILES = re.compile(r"<(include|model)\b")
_NEEDS_FILES = re.compile(r"\bfile\w*\s*=")
_REFUSED = (ValueError, RuntimeError, MemoryError, mujoco.FatalError)  # what MuJoCo raises on models


class Loaded(NamedTuple):
    """A source as loaded: the model, XML that stands alone, notes, the spec, and the folder it has files in, if any."""

    model: mujoco.MjModel
    text: str
    notes: tuple[str, ...]
    spec: mujoco.MjSpec
    folder: Path | None


def shipped_folder(name: str) -> Path:
    """Return a folder that ships with mjcont: in the wheel, or beside the package in a checkout."""
    package = Path(str(resources.files("mjcont")))
    installed, beside = package / name, package.parent / name
    # a room of the package may have the folder's name, and a wheel's data lie in that room
    return beside if beside.is_dir() and (package.parent / "pyproject.toml").is_file() else installed


def models_folder() -> Path:
    """Return the folder of the models that ship with mjcont."""
    return shipped_folder("models_xml")


def shipped_models() -> list[str]:
    """Return the names of the models that ship with mjcont."""
    return sorted(p.stem for p in models_folder().glob("*.xml"))


def needs_files(text: str) -> bool:
    """Whether a model's text names other files."""
    return bool(_NEEDS_FILES.search(text) or _OTHER_FILES.search(text))


def located(source: str | Path) -> Path:
    """Return the file of a path or of a shipped model's name, whether there is one or not."""
    path = Path(source)
    if not path.is_file() and path.parent == Path() and not path.suffix:
        return models_folder() / f"{path.name}.xml"
    return path


def read_source(source: str | Path) -> tuple[str, Path | None]:
    """Return the XML text of a path, of a shipped model's name, or of text itself, and its folder."""
    if isinstance(source, str) and source.lstrip().startswith("<"):
        sources.look_at(source, None, "XML text")
        return source, None
    given: object = source
    if not isinstance(given, str | Path):
        kind = type(given).__name__
        more = ": Mechanism.from_model takes compiled models, from_spec an MjSpec" if "Mj" in kind else ""
        raise ModelError(f"a model is a path, XML text or a shipped model's name, got {kind}{more}")
    if isinstance(source, str) and not source.strip():
        raise ModelError("model '': expected a path, XML text, or the name of a model that ships with mjcont")
    path = located(source)
    if not path.is_file():
        shipped = ", ".join(shipped_models()) or "none"
        what = "is a folder, not a file" if Path(source).is_dir() else "no such file"
        hint = did_you_mean(Path(source).stem, shipped_models())
        raise ModelError(f"model '{source}': {what}.{hint} Models that ship with mjcont: {shipped}.")
    try:
        text, folder = path.read_text(encoding="utf-8"), path.resolve().parent
    except (UnicodeDecodeError, OSError) as error:
        raise ModelError(f"model '{source}' cannot be read as text: {error}") from error
    if not text.strip():
        raise ModelError(f"model '{source}': the file is empty")
    sources.look_at(text, folder, str(path))
    try:
        str(folder).encode()
    except UnicodeEncodeError as error:
        if _NEEDS_FILES.search(text):
            raise ModelError(f"model '{source}': MuJoCo reads further files in folders whose names are UTF-8 only: "
                             "move the model") from error
        return text, None
    return text, folder


def parse(text: str, folder: Path | None, label: str) -> mujoco.MjSpec:
    """Return the spec of an XML text; relative files are looked up in `folder`."""
    try:
        with heard():
            if folder is not None and _OTHER_FILES.search(text):
                return mujoco.MjSpec.from_file(label)
            spec = mujoco.MjSpec.from_string(text)
    except _REFUSED as error:
        raise ModelError(f"model {label}: MuJoCo rejects it: {_one_line(error)}") from error
    if folder is not None:
        spec.modelfiledir = str(folder)
    return spec


def compile_spec(spec: mujoco.MjSpec, notes: list[str] | None = None) -> mujoco.MjModel:
    """Compile a spec, turning MuJoCo's error into ours and adding what it warns of to `notes`."""
    told: list[str] = []
    try:
        with heard() as told:
            return spec.compile()
    except _REFUSED as error:
        raise ModelError(f"model '{spec.modelname}': MuJoCo cannot compile it: {_one_line(error)}") from error
    finally:
        if notes is not None:
            notes += (f"MuJoCo: {message}" for message in told)


def parse_present(text: str, folder: Path | None, label: str) -> tuple[mujoco.MjSpec, tuple[str, ...]]:
    """Return the spec of an XML text without what needs missing files, and what that means, a sentence each."""
    spec = parse(text, folder, label)
    return spec, assets.drop_missing(spec, (folder or Path()).resolve())


def files_read(source: str | Path) -> list[str]:
    """Return the files that a source reads, itself first, each with what is wrong with it, if anything."""
    text, folder = read_source(source)
    if folder is None:
        return []
    path = located(source)
    spec = parse(text, folder, str(path))
    included = sources.look_at(text, folder, str(path)) if _OTHER_FILES.search(text) else ()
    files = dict.fromkeys([path.resolve(), *included, *assets.files(spec, folder)])
    shown = [f.relative_to(folder) if f.is_relative_to(folder) else f for f in files]
    return [str(name) + ("" if file.is_file() else ": not there") for name, file in zip(shown, files, strict=True)]


def load(source: str | Path) -> Loaded:
    """Return the compiled model of a source, with the spec behind it.

    The XML is the text as written, or flattened where it needs other files; what needs a missing file is left out.
    """
    text, folder = read_source(source)
    spec = parse(text, folder, "XML text" if folder is None else str(located(source)))
    place = (folder or Path()).resolve()
    kept, dropped = assets.read_notes(spec), assets.drop_missing(spec, place)
    rewritten = assets.anchor_files(spec, place) or bool(dropped) or bool(_OTHER_FILES.search(text))
    told: list[str] = []
    model = compile_spec(spec, told)
    notes = tuple(dict.fromkeys((*kept, *dropped, *told)))
    if rewritten:
        assets.write_notes(spec, notes)
        text = exact_text(spec)
        spec, place = parse(text, None, "with everything it includes"), Path()
        model = compile_spec(spec)
    return Loaded(model, text, notes, spec, place if folder is not None and not rewritten else None)


def load_spec(spec: mujoco.MjSpec) -> Loaded:
    """Return what `load` does, of a copy of a spec."""
    own = spec.copy()
    own.modelfiledir = spec.modelfiledir
    dropped, told = assets.drop_missing(own, Path(spec.modelfiledir or ".").resolve()), list[str]()
    model = compile_spec(own, told)
    notes = tuple(dict.fromkeys((*assets.read_notes(own), *dropped, *told)))
    if dropped:
        assets.write_notes(own, notes)
    return Loaded(model, exact_text(own), notes, own.copy(), None)


def _one_line(error: Warning | Exception | str) -> str:
    return " ".join(str(error).split())
