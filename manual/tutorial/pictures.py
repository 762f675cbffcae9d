"""Draws the pictures of manual/tutorial/cad-to-verdict.md from decks/electronics_box.lua, with headless Chromium.

    python3 manual/tutorial/pictures.py [build/release/dygita] [folder of a run, to draw that one]

Writes manual/pictures/box_*.png.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECK = "decks/electronics_box.lua"
# Of each picture the section of the report, what of it is hidden, width and height.
SECTIONS = {
    "verdict": ("", "", 1120, 740),
    "assembly": ("The assembly", "figure:not(:nth-of-type(2)):not(:nth-of-type(6)) { display: none }", 1120, 720),
    "spectra": ("Shock response spectra", "figure:nth-of-type(n+2) { display: none }", 1120, 620),
    "bolts": ("Bolts", "details { display: none }", 1120, 640),
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


def main():
    program = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/dygita").resolve()
    pictures = ROOT / "manual/pictures"
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        subprocess.run([program, "check", DECK, "--picture", work / "box.svg"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        drawing = (work / "box.svg").read_text()
        width, height = (int(float(x)) for x in re.search(r'width="([\d.]+)" height="([\d.]+)"', drawing).groups())
        screenshot(work / "box.svg", pictures / "box_check.png", min(width, 1100), min(height, 960), work)
        run = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else work / "electronics_box/base"
        if len(sys.argv) <= 2:
            subprocess.run([program, "run", DECK, "--out", work, "--quiet", "--no-frames", "--no-state"], cwd=ROOT, check=True)
        report = (run / "report.html").read_text()
        for name, (title, hidden, width, height) in SECTIONS.items():
            (work / "part.html").write_text(part_of(report, title).replace("</style>", hidden + "</style>", 1))
            screenshot(work / "part.html", pictures / f"box_{name}.png", width, height, work)


main()
