"""Draws the pictures of manual/tutorial/cad-to-verdict.md from decks/electronics_box.lua and decks/instrument_unit.lua, with headless Chromium.

    python3 manual/tutorial/pictures.py [build/release/dygita] [folder of a run, to draw that one]

Writes manual/pictures/box_*.png and unit_*.png; of a folder those of its problem.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PICTURES = ROOT / "manual/pictures"
# Of each picture the section of the report, what of it is hidden, width and height.
BOX = {
    "verdict": ("", "", 1120, 740),
    "assembly": ("The assembly", "figure:not(:nth-of-type(2)):not(:nth-of-type(6)) { display: none }", 1120, 720),
    "spectra": ("Shock response spectra", "section > p { display: none }", 1120, 900),
    "bolts": ("Bolts", "details { display: none }", 1120, 640),
}
UNIT = {
    "verdict": ("", "h3, ul.warnings, details, .cards ~ .cards { display: none }", 1120, 640),
    "assembly": ("The assembly", "figure:nth-of-type(n+3) { display: none }", 1120, 680),
    "spectra": ("Shock response spectra", "section > p { display: none }", 1120, 520),
}


def screenshot(page, picture, width, height, work):
    subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--window-size={width},{height}",
                    f"--user-data-dir={work}/profile", f"--screenshot={picture}", f"file://{page}"], check=True, stderr=subprocess.DEVNULL)


def part_of(report, title):
    """The page with one section, and with its head if that is the verdict."""
    head, body = report.split("<body>", 1)
    above, rest = body.split("<section>", 1)
    sections = re.findall(r"<section>.*?</section>", "<section>" + rest, re.S)
    if not title:
        return head + "<body>" + above + sections[0] + "</body></html>"
    return head + "<body>" + next(s for s in sections if f"<h2>{title}" in s) + "</body></html>"


def draw_sections(run, prefix, sections, work):
    report = (run / "report.html").read_text()
    for name, (title, hidden, width, height) in sections.items():
        (work / "part.html").write_text(part_of(report, title).replace("</style>", hidden + "</style>", 1))
        screenshot(work / "part.html", PICTURES / f"{prefix}_{name}.png", width, height, work)


def draw_check(program, work):
    subprocess.run([program, "check", "decks/electronics_box.lua", "--picture", work / "box.svg"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    drawing = (work / "box.svg").read_text()
    width, height = (int(float(x)) for x in re.search(r'width="([\d.]+)" height="([\d.]+)"', drawing).groups())
    screenshot(work / "box.svg", PICTURES / "box_check.png", min(width, 1100), min(height, 960), work)


def main():
    program = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/dygita").resolve()
    given = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        for problem, prefix, sections in (("electronics_box", "box", BOX), ("instrument_unit", "unit", UNIT)):
            if given and given.parent.name != problem:
                continue
            if prefix == "box":
                draw_check(program, work)
            if not given:
                subprocess.run([program, "run", f"decks/{problem}.lua", "--out", work, "--quiet", "--no-frames", "--no-state"], cwd=ROOT, check=True)
            draw_sections(given or work / problem / "base", prefix, sections, work)


main()
