"""An increment that has not converged is visible in every file that is made of it, and a run that has converged is
marked by none.

converged.py PROGRAM FOLDER_OF_THE_DECK
"""

import base64
import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

PROGRAM, DECK = sys.argv[1], pathlib.Path(sys.argv[2]) / "unconverged.lua"
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_converged_"))
PER_INCREMENT = {"below", "above", "moved", "joint", "footprint", "force", "momentum", "loop", "energy", "convergence"}
OF_THE_MOTION = {"srs", "srs_band", "through", "field"}
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)


def dygita(*words, expected):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120, check=False)
    check(done.returncode == expected, f"dygita {' '.join(map(str, words))}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def columns(path):
    with open(path, newline="") as file:
        return next(csv.reader(file), [])


def marks(rows):
    return [int(row["converged"]) for row in rows]


def field_data(path, name):
    """A number of a frame's field data: VTK's base64 of a header and of what zlib has left."""
    text = re.search(rf'<DataArray[^>]*Name="{name}"[^>]*>\s*([^<\s]*)', path.read_text()).group(1)
    header = int.from_bytes(base64.b64decode(text[:8])[:4], "little")  # blocks
    bytes_of_header = 4 * (3 + header)
    characters = 4 * -(-bytes_of_header // 3)
    return int.from_bytes(zlib.decompress(base64.b64decode(text[characters:]))[:4], "little")


def run(name, solver, expected):
    output = dygita("run", DECK, "--quiet", "--solver", solver, "--out", FOLDER / name, expected=expected)
    return FOLDER / name / "unconverged" / "base", output


def every_table(folder, is_marked):
    """Each row of a table against time has the mark of its increment, any other table that of all it is made of."""
    increments = {}
    for row in table(folder / "convergence.csv"):
        increments.setdefault(row["step"], []).append(int(row["converged"]))
    check(is_marked == any(0 in of_step for of_step in increments.values()), f"{folder}: convergence.csv")
    found = {path.stem for path in folder.glob("*.csv")}
    check(PER_INCREMENT | OF_THE_MOTION | {"bolts", "element", "loop_cycles", "loop_backbone"} == found, f"tables: {sorted(found)}")
    for name in found:
        rows = table(folder / f"{name}.csv")
        check(columns(folder / f"{name}.csv")[-1:] == ["converged"], f"{name}.csv: no last column 'converged'")
        # Whether unconverged motions make a cycle is chance: rounding decides where eight iterations end.
        check(rows or name == "loop_cycles" and is_marked, f"{name}.csv: no rows")
        if name in PER_INCREMENT:
            of_step = {}
            for row in rows:
                of_step.setdefault(row["step"], []).append(int(row["converged"]))
            for step, own in of_step.items():  # a step's start may have a row of its own
                check(own[-len(increments[step]):] == increments[step], f"{name}.csv, {step}: {own} of {increments[step]}")
        elif name in OF_THE_MOTION | {"bolts"}:
            check(set(marks(rows)) == {0 if is_marked else 1}, f"{name}.csv: {marks(rows)}")
    first = increments["tighten"]
    check(set(marks(table(folder / "element.csv"))) == {int(all(first))}, "element.csv is not marked by the steps up to it")
    words = "NOT CONVERGED: 2 increments up to the end of step 'tighten'"
    for name in ("element.md", "element_mass.mtx", "element_stiffness.mtx"):
        check((words in (folder / name).read_text()) == is_marked, f"{name}: '{words}'")
    return increments


def every_frame(folder, increments):
    order = [mark for step in ("tighten", "there", "back", "again", "strike") for mark in increments[step]]
    frames = sorted((folder / "frames").glob("slab_*.vtu"))
    at = [0]  # increments of each step that have a frame: five, or all
    for step in increments:
        n, so_far = len(increments[step]), sum(len(increments[s]) for s in list(increments)[:list(increments).index(step)])
        kept = min(5, n)
        at += [so_far + i for i in range(1, n + 1) if i * kept // n != (i - 1) * kept // n]
    check(len(frames) == len(at), f"{len(frames)} frames, {len(at)} expected")
    for frame, n in zip(frames, at):
        for path in (frame, folder / "frames" / "interfaces" / frame.name.replace("slab", "interfaces")):
            check(field_data(path, "converged") == (order[n - 1] if n else 1), f"{path.name}: converged")
            check(field_data(path, "increments_not_converged") == order[:n].count(0), f"{path.name}: increments_not_converged")
    for path in (folder / "frames" / "field").glob("*.vtu"):
        check(field_data(path, "increments_not_converged") == order.count(0), f"{path.name}: increments_not_converged")


def everything_else(folder, is_marked, n):
    record = json.loads((folder / "run.json").read_text())
    check(all(o["converged"] != is_marked for o in record["outputs"]), f"run.json: {[(o['name'], o['converged']) for o in record['outputs']]}")
    scenes = json.loads((folder / "scenes.json").read_text())
    stress = [p for p in scenes["assembly"] if p["colour"] == "von_mises"]
    check(stress and all((p["missed"] > 0) == is_marked for p in stress), "pictures of stress")
    check(all((i["missed"] > 0) == is_marked for j in scenes["joints"] for i in j["instants"]), "maps of joints")
    check(all((f["missed"] > 0) == is_marked for f in json.loads((folder / "motion.json").read_text())["frames"]), "motion")
    check((f"NOT CONVERGED: {n} increments" in (folder / "view.py").read_text()) == is_marked, "view.py")
    page = (folder / "report.html").read_text()
    if not is_marked:
        check("NOT CONVERGED" not in page.split("<script>")[0] and 'class="missed"' not in page, "a report without reason")
        return
    for section in re.findall(r"<section>\n<h2>(.*?)</h2>(.*?)</section>", page, re.S):
        drawings = section[1].count("<figure>\n<svg")
        told = len(re.findall(r"NOT CONVERGED</text>\n</svg>", section[1]))
        if section[0] in ("Verdict", "Parts", "The assembly", "Convergence", "Cost", "What was computed"):
            continue
        check(f"NOT CONVERGED: {n} of 51 increments" in section[1].split("\n")[1], f"section '{section[0]}' does not say so")
        check(drawings == told, f"section '{section[0]}': {drawings} drawings, {told} say so")
        if section[0] in ("Histories", "Energy"):
            check(section[1].count('<rect class="missed"') >= drawings, f"section '{section[0]}': no red ranges")
    verdict = page.split("<h2>Verdict</h2>")[1].split("</section>")[0]
    check(verdict.count("; NOT CONVERGED</small>") == 4, "cards of specification, bolts, contacts and margin")


for name, solver, expected in (("short", "latin{ max_iterations = 8 }", 1), ("whole", "latin{}", 0)):
    run_folder, output = run(name, solver, expected)
    is_marked = expected == 1
    steps = every_table(run_folder, is_marked)
    missed = sum(of_step.count(0) for of_step in steps.values())
    every_frame(run_folder, steps)
    everything_else(run_folder, is_marked, missed)
    rows = table(run_folder / "moved.csv")
    check(f"rows of 'moved' that have not converged: {marks(rows).count(0)};" in output, output)
    check(output.count("spectrum: 0") == (0 if is_marked else 1), output)
    # A spectrum of the history by hand carries it on; so does the report made again.
    said = dygita("srs", run_folder / "above.csv", "--from", 25000, "--to", 200000, "--out", FOLDER / f"{name}.csv", expected=0)
    check(set(marks(table(FOLDER / f"{name}.csv"))) == {0 if is_marked else 1}, "dygita srs")
    check(("have NOT CONVERGED, and the spectrum depends on them" in said) == is_marked, said)
    page = (run_folder / "report.html").read_bytes()
    dygita("report", run_folder, expected=0)
    check((run_folder / "report.html").read_bytes() == page, "a report made again is another")
shutil.rmtree(FOLDER)
print("\n".join(failures) or "what has not converged is visible in every file")
sys.exit(1 if failures else 0)
