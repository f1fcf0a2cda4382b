"""Make the README's moving picture of the explorer from a page in a headless browser: python docs/make_explorer.py.

Needs playwright and Chromium, as the browser tests do.
"""

import io
import shutil
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright

import mjcont as mc

OUT = Path(__file__).parent / "images" / "explorer.gif"
SIZE, SHOWN = (1180, 700), (826, 490)
FPS = 10
GRAPHICS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


def written(folder: Path) -> Path:
    """Write a page on a nose gear: its equilibria, the locus of a fold, a load that locks it."""
    gear = mc.Mechanism.from_xml("nose_gear")
    branch = mc.continue_equilibria(gear, "F_ret", (3e5, 8e5), {"F_ret": 4e5}, keyframe="uplock_above")
    locus = mc.continue_special(branch.point("LP1"), "F_ul", bounds=(-1000, 0))
    path = mc.load_path(gear, "F_ret", [3.2e5, 6.5e5], keyframe="uplock_above")
    return mc.to_html(folder / "page.html", branch, locus, path)


def steps(page) -> list[tuple[int, int]]:
    """Return curves and rows, one a picture: along the branch through its fold, the locus, and the load path."""
    rows = page.evaluate("() => explorer.explorer.store.curves.map((c) => c.rows)")
    spread = [(0, 0.1, 0.95, 24), (1, 0.0, 1.0, 12), (2, 0.0, 1.0, 40)]
    return [(k, int(r)) for k, a, b, n in spread for r in np.linspace(a, b, n) * (rows[k] - 1)]


def palette(shots: list[Image.Image]) -> Image.Image:
    """Return one palette for all pictures, so that nothing flickers: mostly the usual colours, and the rare ones."""
    some = Image.fromarray(np.concatenate([np.asarray(s) for s in shots[:: len(shots) // 4]]))
    usual, rare = (
        some.quantize(n, method=m).getpalette()[: 3 * n]
        for n, m in ((176, Image.Quantize.MEDIANCUT), (79, Image.Quantize.MAXCOVERAGE))
    )
    found = Image.new("P", (1, 1))
    found.putpalette(usual + rare)
    return found


def main() -> None:
    """Take the pictures and write the movie."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        program = shutil.which("chromium") or shutil.which("google-chrome")
        browser = playwright.chromium.launch(executable_path=program, args=GRAPHICS)
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]}, color_scheme="light")
        page.goto(written(Path(folder)).as_uri())
        page.wait_for_selector(".plot .line")
        page.select_option("select[aria-label='Vertical axis of the diagram']", "theta_ov")
        shots = []
        for curve, row in steps(page):
            page.evaluate("([k, r]) => { const s = explorer.explorer.store; s.select(s.curves[k], r) }", [curve, row])
            page.evaluate("() => new Promise((d) => requestAnimationFrame(() => requestAnimationFrame(d)))")
            image = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
            shots.append(image.resize(SHOWN, Image.Resampling.LANCZOS))
        browser.close()
    colours = palette(shots)
    first, *others = (s.quantize(palette=colours, dither=Image.Dither.NONE) for s in shots)
    first.save(OUT, save_all=True, append_images=others, loop=0, duration=1000 // FPS, optimize=True)
    print(f"{OUT}: {OUT.stat().st_size} bytes")


if __name__ == "__main__":
    main()
