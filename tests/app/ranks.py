"""dygita under mpirun: every table and every frame has the bits of one process; errors are said once; what ranks cannot share is refused.

ranks.py PROGRAM MPIRUN FOLDER_OF_THE_DECKS [--ranks N] [--part bits|iterated|continued|refused]
"""

import argparse
import base64
import csv
import hashlib
import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree
import zlib

asked = argparse.ArgumentParser()
asked.add_argument("program")
asked.add_argument("mpirun")
asked.add_argument("folder", type=pathlib.Path)
asked.add_argument("--ranks", type=int, nargs="*", default=[2])
asked.add_argument("--part", choices=["bits", "iterated", "continued", "refused"], help="alone; else all one after the other")
asked = asked.parse_args()
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_ranks_"))
PARTS = "state.dygita.parts"
failures = []


def under_mpi(ranks):
    return [asked.mpirun, "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []


def dygita(ranks, *words, expected, says=(), never=(), setting=None):
    start = under_mpi(ranks)
    environment = {**os.environ, "OMP_NUM_THREADS": "1", **(setting or {})}
    done = subprocess.run([*start, asked.program, *map(str, words)], capture_output=True, text=True, timeout=280, check=False, env=environment)
    said = done.stdout + done.stderr
    wrong = [text for text in says if said.count(text) != 1] + [f"not: {text}" for text in never if text in said]
    if done.returncode != expected or wrong:
        failures.append(f"{ranks} ranks: dygita {' '.join(map(str, words))}: exit {done.returncode}, expected {expected}; {wrong}\n{said}")
    return said


def contents(run):
    # The state has seconds in its header, records and pages tell times.
    told_apart = {"run.json", "report.html", "state.dygita", "view.py"}
    found = {str(p.relative_to(run)): p.read_bytes() for p in sorted(run.rglob("*"))
             if p.is_file() and p.name not in told_apart and p.parent.name != PARTS}
    if ".dygita-files" in found:    # the state of several ranks is in parts
        found[".dygita-files"] = b"".join(line for line in found[".dygita-files"].splitlines(True) if not line.startswith(PARTS.encode()))
    return {name: hashlib.sha256(data).hexdigest() for name, data in found.items()}


def arrays(file):
    """Arrays of a .vtu (name: bytes of each tuple), and its cells as (type, points of each)."""
    def decode(array):
        text = array.text.strip()
        n_blocks = int.from_bytes(base64.b64decode(text[:8])[:4], "little")
        if n_blocks == 0:
            return b""
        width = 4 * -(-4 * (3 + n_blocks) // 3)    # characters of the header, by itself
        sizes = struct.unpack(f"<{3 + n_blocks}I", base64.b64decode(text[:width])[:4 * (3 + n_blocks)])[3:]
        data, at, whole = base64.b64decode(text[width:]), 0, b""
        for size in sizes:
            whole += zlib.decompress(data[at:at + size])
            at += size
        return whole

    def tuples(array):
        size = {"Float64": 8, "Float32": 4, "Int64": 8, "UInt8": 1}[array.get("type")] * int(array.get("NumberOfComponents", 1))
        data = decode(array)
        return [data[i:i + size] for i in range(0, len(data), size)]

    piece = xml.etree.ElementTree.parse(file).getroot().find("UnstructuredGrid/Piece")
    points = {array.get("Name"): tuples(array) for array in piece.findall("PointData/DataArray")}
    places = tuples(piece.find("Points/DataArray"))
    cells = {array.get("Name"): tuples(array) for array in piece.findall("Cells/DataArray")}
    corners = [places[int.from_bytes(node, "little")] for node in cells["connectivity"]]
    ends = [0] + [int.from_bytes(end, "little") for end in cells["offsets"]]
    return places, points, [(kind, *corners[a:b]) for kind, a, b in zip(cells["types"], ends, ends[1:])]


def difference_of_pieces(whole, listed):
    """What the files that a .pvtu lists have otherwise than the .vtu of one process: every cell once, at each point the same bits."""
    places, fields, cells = arrays(whole)
    of_place = {place: {name: field[i] for name, field in fields.items()} for i, place in enumerate(places)}
    seen, seen_cells = set(), []
    pieces = xml.etree.ElementTree.parse(listed).getroot().findall("PUnstructuredGrid/Piece")
    for piece in pieces:
        own, own_fields, own_cells = arrays(listed.parent / piece.get("Source"))
        seen.update(own)
        seen_cells += own_cells
        for name, field in own_fields.items():
            if any(value != of_place[place].get(name) for place, value in zip(own, field)):
                return f"{name} in {piece.get('Source')}"
    if len(pieces) < 2 or seen != set(places) or sorted(seen_cells) != sorted(cells):
        return f"{len(pieces)} pieces have {len(seen)} of {len(places)} points, {len(seen_cells)} of {len(cells)} cells"
    return ""


def put_together(alone, shared, run_alone, run):
    """Takes what ranks write in pieces out of both contents; returns how it differs."""
    wrong = []
    for listed in sorted(run.rglob("*.pvtu")):
        name = str(listed.relative_to(run))
        whole = name.replace(".pvtu", ".vtu")
        for file in [name, *(n for n in shared if n.startswith(name.replace(".pvtu", "_rank_")))]:
            shared.pop(file)
        if alone.pop(whole, None) is None or (difference := difference_of_pieces(run_alone / whole, listed)):
            wrong.append(f"{name}: {difference}")
        pvd = f"{run.parent.name}.pvd"
        if (run / pvd).read_text().replace(".pvtu", ".vtu") != (run_alone / pvd).read_text():
            wrong.append(pvd)
        for names_files in pvd, ".dygita-files":
            alone.pop(names_files, None), shared.pop(names_files, None)
    return wrong


def numbers(run):
    """What run.json says of the answer: figures but those of what the ranks have each, warnings, bolts, outputs."""
    record = json.loads((run / "run.json").read_text())
    own = ("memory", "substitutions", "share another's", "[MB]")
    figures = {name: value for name, value in record["figures"].items() if not any(word in name for word in own)}
    record["warnings"] = [text for text in record["warnings"] if not text.startswith("identical substructures are on several MPI ranks")]
    return figures | {key: record.get(key) for key in ("verdict", "warnings", "bolts", "outputs", "iterations")}


def same(name, alone, shared):
    told = numbers(alone), numbers(shared)
    folders = alone, shared
    alone, shared = contents(alone), contents(shared)
    n_files = len(alone)
    differ = put_together(alone, shared, *folders)
    differ += [file for file in {**alone, **shared} if alone.get(file) != shared.get(file)]
    differ += [f"run.json: {key}" for key, value in told[0].items() if value != told[1].get(key)]
    if differ or n_files < 3:
        failures.append(f"{name}: other bits than those of one process: {sorted(differ)}, of {sorted(alone)}")


def compare(name, deck, problem, *words, cases=("base",), most=1000, also=()):
    several = sorted({*(ranks for ranks in asked.ranks if ranks <= most), *also})
    for ranks in [1, *several]:
        out = FOLDER / f"{name}_{ranks}"
        dygita(ranks, "run", deck, "--quiet", "--threads", 1, "--out", out, *words, expected=0)
        for case in cases if ranks > 1 else ():
            same(f"{name} on {ranks} ranks", FOLDER / f"{name}_1" / problem / case, out / problem / case)


stopped, unlike, implicit, uneven = (asked.folder / name for name in ("stopped.lua", "ranks_unlike.lua", "ranks_implicit.lua", "ranks_uneven.lua"))
DECKS = asked.folder.parents[1] / "decks"
ASSEMBLED = ["--solver", "latin{ static_steps = 'assembled', integration = 'implicit' }"]


def ranks_of(pid):
    """Processes that mpirun has started, in their order."""
    listed = subprocess.run(["ps", "-o", "pid=,stat=", "--ppid", str(pid)], capture_output=True, text=True, check=False).stdout.split("\n")
    return sorted(int(line.split()[0]) for line in listed if line and not line.split()[1].startswith("Z"))


def to_all(name):
    """What passes in an iteration is the interface fields between neighbours, and to all less than a number an unknown: sums of each piece."""
    record = json.loads((FOLDER / name / "implicit" / "base" / "run.json").read_text())
    each, n_iterations = record["ranks"]["of_each"], record["iterations"]["all"]
    to_neighbours, of_all = (sum(rank["bytes"][kind] for rank in each) / n_iterations for kind in ("neighbours", "all"))
    one_field = 8 * record["size"]["interface_unknowns"]
    if not 0.1 * one_field < to_neighbours < one_field or of_all / (len(each) - 1) > 0.7 * one_field:
        failures.append(f"{name}: {to_neighbours:.0f} bytes to neighbours and {of_all:.0f} to all in an iteration; a field of the interfaces: {one_field}")


def is_running(process):
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


def go_on(name, killed, then, *solver, deck=stopped, problem="stopped", us=150, whole_on=1):
    """A rank that dies ends the run; any number of ranks go on with what was computed, to the bits of a run that was never stopped (in one process; on as many ranks, where these cut it)."""
    words = ["run", deck, "--set", f"us={us}", "--checkpoint-every", "0.02s", "--no-frames", "--quiet", "--threads", "1", *solver, "--out"]
    whole = FOLDER / (f"whole_{problem}_{us}" + "_assembled" * bool(solver))
    if not whole.exists():
        dygita(whole_on, *words, whole, expected=0)
    out = FOLDER / name
    process = subprocess.Popen([*under_mpi(killed), asked.program, *map(str, [*words, out])],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    run = out / problem / "base"
    begun = time.monotonic()
    # Rank 0 has its part in the checkpoint, the others have theirs beside it.
    while sum(p.stat().st_size for p in run.glob("checkpoint.dygita*/**/*") if p.is_file()) + sum(
            p.stat().st_size for p in run.glob("checkpoint.dygita")) <= 200000:
        if process.poll() is not None or time.monotonic() > begun + 100:
            failures.append(f"{name}: the run has left no checkpoint to kill it by")
            process.kill()
            return
        time.sleep(0.01)
    ranks = ranks_of(process.pid) if killed > 1 else [process.pid]
    os.kill(ranks[-1], signal.SIGKILL)
    said = process.communicate(timeout=100)[1]
    if process.returncode == 0 or (killed > 1 and "signal 9" not in said):
        failures.append(f"{name}: a rank was killed: mpirun exits with {process.returncode}\n{said}")
    begun = time.monotonic()
    while any(is_running(rank) for rank in ranks) and time.monotonic() < begun + 30:
        time.sleep(0.1)
    if left := [rank for rank in ranks if is_running(rank)]:
        failures.append(f"{name}: a rank was killed, and {left} run on")
    kept = run / "continue.txt"
    wanted = [f"    dygita continue {run}"] + [f"    mpirun -n {killed} dygita continue {run}"] * (killed > 1)
    if not kept.exists() or [line for line in kept.read_text().splitlines() if line.startswith("    ")] != wanted:
        failures.append(f"{name}: {kept} does not say how to continue: {kept.read_text() if kept.exists() else 'not there'}")
    said = dygita(then, "continue", run, "--no-frames", "--threads", "1", expected=0, says=["increments are replayed"])
    if "differ in their last digits" in said:
        failures.append(f"{name}: the increments gone over differ\n{said}")
    same(name, whole / problem / "base", run)


def go_further(name, *words, deck=stopped, problem="stopped", written_by=(1, 3), continued_by=(1, 2), setting=()):
    """A run that has come to its end, to a tighter tolerance or further in time: any number of ranks goes on with what each of any number has left of its fields."""
    alone = None
    for writers in written_by:
        whole = FOLDER / f"{name}_by_{writers}"
        dygita(writers, "run", deck, "--quiet", "--threads", 1, "--out", whole, *setting, expected=0)
        check_parts(f"{name}, written by {writers}", whole / problem / "base", writers)
        for ranks in continued_by:
            run = shutil.copytree(whole, FOLDER / f"{name}_by_{writers}_on_{ranks}") / problem / "base"
            dygita(ranks, "continue", run, *words, "--quiet", "--threads", 1, expected=0)
            check_parts(f"{name}, written by {writers}, continued by {ranks}", run, ranks)
            alone = alone or run
            if run != alone:
                same(f"{name}, written by {writers}, continued by {ranks}", alone, run)


def check_parts(name, run, writers):
    """Each rank has left its own fields, and together they have as much as one process leaves; who has which follows from measured seconds."""
    parts = sorted(run.glob(f"{PARTS}/*"))
    record = json.loads((run / "run.json").read_text())
    fields = [part.stat().st_size - 8 for part in parts]
    if writers == 1:
        wrong = bool(parts) or f"{PARTS}/0" in record["files"]
    else:
        whole = 8 * record["size"]["interface_unknowns"] * sum(step["increments"] for step in record["steps"])
        wrong = len(parts) != writers or not 0.9 * whole <= sum(fields) <= whole or min(fields) == 0 or f"{PARTS}/1" not in record["files"]
    if wrong:
        failures.append(f"{name}: bytes of the parts of the state: {fields}, {record['size']}, {record['steps']}")


def spoil_part():
    """A part that is gone, cut off or of another run is told, and nothing is touched."""
    run = FOLDER / "tighter_by_3" / "stopped" / "base"
    part, before = run / PARTS / "2", contents(run)
    kept = part.read_bytes()
    for spoiled in None, kept[:-8], kept[:-1] + bytes([kept[-1] ^ 1]), kept + b"12345678":
        part.unlink() if spoiled is None else part.write_bytes(spoiled)
        for ranks in 1, 2:
            dygita(ranks, "continue", run, "--tolerance", "1e-8", "--quiet", expected=2, says=["its part '"])
        part.write_bytes(kept)
    if contents(run) != before:
        failures.append("a spoiled part: the run's folder has changed")


def largest_difference(alone, shared):
    """Of the tables of what was asked for, over the largest number of a table in that unit."""
    largest = {}
    for path in alone.glob("*.csv"):
        if path.name == "convergence.csv":
            continue
        here, there = (list(csv.DictReader(file.read_text().splitlines())) for file in (path, shared / path.name))
        for name in here[0]:
            if "[" not in name:
                continue
            pairs = [(float(a[name]), float(b[name])) for a, b in zip(here, there, strict=True)]
            size, off = largest.get((path.name, name.split("[")[1]), (0.0, 0.0))
            largest[path.name, name.split("[")[1]] = max(size, *(abs(a) for a, _ in pairs)), max(off, *(abs(a - b) for a, b in pairs))
    return max(off / size for size, off in largest.values() if size)


def cut_for_ranks(name, ranks, tolerance, *words, heaviest=1.15):
    """Too few bodies or unequal ones are cut, with a warning; ranks have about as much each, and the answer is that of one process (to the last of nine digits)."""
    runs = {}
    for n in 1, ranks:
        runs[n] = FOLDER / f"{name}_{n}" / "uneven" / "base"
        dygita(n, "run", uneven, "--quiet", "--threads", 1, "--out", FOLDER / f"{name}_{n}", *words, expected=0)
    record = json.loads((runs[ranks] / "run.json").read_text())
    unknowns = [rank["unknowns"] for rank in record["ranks"]["of_each"]]
    off = largest_difference(runs[1], runs[ranks])
    warned = sum("are divided to balance MPI load" in text for text in record["warnings"])
    if len(unknowns) != ranks or max(unknowns) * ranks > heaviest * sum(unknowns) or not 0.0 < off < tolerance or warned != 1:
        failures.append(f"{name}: unknowns of each rank {unknowns}, tables differ by {off:.3g}, {warned} warnings of the cut")
    return runs[ranks]


def measured(name):
    """Pieces are shared out by the seconds that they took in the run before, and the answer keeps its bits."""
    out = FOLDER / name
    words = ["run", asked.folder / "ranks.lua", "--quiet", "--threads", 1, "--set", "us=10", "--out", out]
    dygita(2, *words, expected=0)
    run = out / "ranks" / "base"
    before, record = contents(run), json.loads((run / "run.json").read_text())
    pieces = record["ranks"]["pieces"]
    for i, piece in enumerate(pieces):
        piece["seconds"] = 14.0 if i == 4 else 1.0
    (run / "run.json").write_text(json.dumps(record))
    dygita(2, *words, expected=0)
    ranks = [piece["rank"] for piece in json.loads((run / "run.json").read_text())["ranks"]["pieces"]]
    if ranks.count(ranks[4]) != 1 or contents(run) != before:
        failures.append(f"{name}: the piece that took most is not alone: {ranks}; or other bits")


def once_on_machine(name):
    """Nodes and cells are in memory once for the ranks of a machine, by files that have no name once the run begins, nor after an error of the deck; where they cannot be written each rank keeps its own."""
    deck = DECKS / "bench" / "blocks.lua"
    words = ["run", deck, "--quiet", "--threads", 1, "--set", "cells=32", "--set", "steps=2"]
    temporary = FOLDER / f"{name}_temporary"
    temporary.mkdir()
    runs = {key: FOLDER / f"{name}_{key}" for key in ("alone", "shared", "apart", "late")}
    session = {"OMPI_MCA_orte_tmpdir_base": tempfile.gettempdir()}    # of mpirun itself
    dygita(1, *words, "--out", runs["alone"], expected=0)
    dygita(3, *words, "--out", runs["shared"], expected=0, setting={**session, "TMPDIR": str(temporary)}, never=["cannot be shared"])
    # Two of three ranks hold what the third has written: of 8 bricks the nodes of each, and cells that they have in common.
    of_each = [rank["memory"]["meshes_once_on_machine"] for rank in json.loads((runs["shared"] / "blocks" / "base" / "run.json").read_text())["ranks"]["of_each"]]
    if min(of_each) < 8 * 24 * 17**3 - 8 * 8192 or list(temporary.iterdir()):
        failures.append(f"{name}: bytes of meshes in common {of_each}; files {list(temporary.iterdir())}")
    nowhere = {**session, "TMPDIR": str(FOLDER / "nowhere")}
    dygita(3, *words, "--out", runs["apart"], expected=0, setting=nowhere, says=["meshes cannot be shared"])
    same(f"{name}, shared", runs["alone"] / "blocks" / "base", runs["shared"] / "blocks" / "base")
    if contents(runs["alone"] / "blocks" / "base") != contents(runs["apart"] / "blocks" / "base"):
        failures.append(f"{name}: other bits where each rank keeps its own meshes")
    (FOLDER / "after_meshes.lua").write_text(deck.read_text() + "error('after all')\n")
    dygita(3, "run", FOLDER / "after_meshes.lua", *words[2:], "--out", runs["late"], expected=2, says=["after all"], setting={**session, "TMPDIR": str(temporary)})
    (FOLDER / "before_runs.lua").write_text(deck.read_text().replace("problem{", "error('not now') problem{"))
    dygita(3, "run", FOLDER / "before_runs.lua", *words[2:], "--out", runs["late"], expected=2, says=["not now"], setting={**session, "TMPDIR": str(temporary)})
    if left := [p.name for p in temporary.iterdir()]:
        failures.append(f"{name}: left after an error: {left}")


ROW = """
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local at, named, parts = { bottom = 0, middle = 1, top = 2, lid = 3 }, {}, {}
for name, k in pairs(at) do
  named[name] = substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, k * 10*mm }, size = { 10*mm, 10*mm, 10*mm }, cells = { 3, 3, 3 } } }
  parts[#parts + 1] = named[name]
end
local base = support.fixed{ name = "base", on = named.bottom:face "zmin" }
local hit = step.dynamic{ name = "hit", duration = 10*us, dt = 0.25*us, loads = { load.pressure{ on = named.lid:face "zmax", history = history.half_sine{ peak = PEAK, duration = 6*us } } } }
problem{ name = "row", substructures = parts, interfaces = { interface.contact{ between = "all touching", friction = 0.3 } }, supports = { base }, steps = { hit },
  outputs = { output.momentum{ name = "m", of = named.middle }, output.energy{} } }:run{}
"""


def bits():
    """Every kind of step has the bits of one process."""
    compare("implicit", stopped, "stopped")
    compare("windows", stopped, "stopped", "--set", "window=4")
    compare("explicit", stopped, "stopped", "--set", "explicit=1")
    compare("all_explicit", stopped, "stopped", "--solver", "latin{ integration = 'explicit' }")
    compare("passes", stopped, "stopped", "--set", "passes=1")
    compare("unlike", unlike, "unlike", most=4, also=[2, 3])
    compare("damped", unlike, "unlike", "--set", "beta=2e-8", "--set", "driven=1", most=4, also=[2, 3])
    compare("tuned", unlike, "unlike", "--set", "beta=1e-8", "--set", "tuned=1", most=4)
    compare("order_two", unlike, "unlike", "--set", "tetrahedra=1", most=3)
    compare("pieces", asked.folder / "ranks.lua", "ranks")
    # Cut substructures on several ranks; motions too large for the theory, stresses beyond yield.
    compare("cut", asked.folder / "ranks.lua", "ranks", "--set", "cut=24", "--set", "peak=30000*MPa", "--set", "us=30", also=[3])
    compare("massless", stopped, "stopped", "--solver", "latin{ massless_contact = true, static_steps = 'iterated' }")
    # All pieces of static steps in one system, which every rank solves.
    compare("assembled", stopped, "stopped", *ASSEMBLED, also=[3])
    compare("assembled_pieces", asked.folder / "ranks.lua", "ranks", "--solver", "latin{ static_steps = 'assembled', pieces = 24 }")
    compare("released", asked.folder / "ranks.lua", "ranks", "--set", "release=20", also=[3])


def iterated():
    """So have points that ranks iterate together, meshes of files and studies."""
    # Iterated points between ranks: each solves those that its pieces touch, sums are made piece by piece.
    compare("iterated", implicit, "implicit", "--set", "release=8", also=[4])
    compare("iterated_cut", implicit, "implicit", "--set", "cut=3", "--set", "driven=1", also=[3])
    compare("iterated_windows", implicit, "implicit", "--set", "window=4", "--set", "cut=2", also=[3])
    compare("heavy", implicit, "implicit", "--set", "heavy=1", "--set", "us=3", also=[3])    # a load on bodies whose mass is a matrix
    compare("cut_cube", DECKS / "verification" / "pieces.lua", "pieces", "--set", "n=8", "--set", "only=6", cases=("6_pieces",), also=[3])
    compare("iterated_mixed", implicit, "implicit", "--set", "explicit=4", also=[3])
    # Meshes of files: rank 0 has them meshed for all; turned copies.
    compare("meshed", DECKS / "bench" / "ring.lua", "ring", "--set", "bolts=6", "--set", "steps=3", "--solver", "latin{ integration = 'explicit' }", also=[3])
    compare("sector", DECKS / "verification" / "ring_sector.lua", "ring_sector", "--set", "fine=3", also=[3])
    (FOLDER / "spoiled.geo").write_text("Point(1) = {0, 0;\n")
    (FOLDER / "spoiled.lua").write_text('local m = mesh.gmsh{ file = "spoiled.geo" }\n')
    dygita(2, "run", FOLDER / "spoiled.lua", "--quiet", "--out", FOLDER / "spoiled", expected=2, says=["gmsh cannot read or mesh it"])
    compare("study", asked.folder / "study.lua", "study", cases=("mu 0.1", "mu 0.2", "mu 0.3"), most=2)
    to_all("iterated_4")


def continued():
    """Whoever goes on with what others have left; cuts that ranks ask for."""
    cut_for_ranks("uneven", 3, 1e-8, "--set", "cells=12")
    cut_for_ranks("one_body", 3, 1e-8, "--set", "bodies=1", "--set", "cells=5")
    implicit_cut = cut_for_ranks("one_implicit_body", 3, 1e-5, "--set", "bodies=1", "--set", "implicit=1", heaviest=1.2)
    # The cut is that of the run which is continued, on however many ranks.
    on_one = shutil.copytree(FOLDER / "one_implicit_body_3", FOLDER / "continued_on_one") / "uneven" / "base"
    for ranks, run in (3, implicit_cut), (1, on_one):
        dygita(ranks, "continue", run, "--until", "15*us", "--quiet", "--threads", 1, expected=0)
    same("a cut for three ranks continued on one", on_one, implicit_cut)
    compare("even", uneven, "uneven", "--set", "bodies=4", "--set", "long=1", "--set", "cells=5", also=[2])
    once_on_machine("once")
    measured("measured")
    go_on("two_then_one", 2, 1)
    go_on("two_then_three", 2, 3)
    go_on("one_then_two", 1, 2, us=300)
    go_on("assembled_two_then_one", 2, 1, *ASSEMBLED)
    go_on("iterated_four_then_three", 4, 3, deck=implicit, problem="implicit", us=60)
    go_on("iterated_three_then_one", 3, 1, deck=implicit, problem="implicit", us=60)
    go_on("cut_three_then_one", 3, 1, "--set", "bodies=1", "--set", "implicit=1", deck=uneven, problem="uneven", us=80, whole_on=3)
    go_further("further", "--until", "80*us")
    go_further("tighter", "--tolerance", "1e-8")
    go_further("tighter_implicit", "--tolerance", "1e-8", deck=implicit, problem="implicit", continued_by=(1, 3, 4))
    go_further("assembled_further", "--until", "80*us", setting=ASSEMBLED)
    spoil_part()


def refused():
    """What ranks cannot share is refused, and an error is said once."""
    dygita(2, "continue", FOLDER / "none", expected=2, says=["no folder"])
    dygita(7, "run", stopped, "--quiet", "--solver", "latin{ pieces = 1 }", "--out", FOLDER / "many", expected=2, says=["7 MPI ranks for 6 substructures"])
    dygita(2, "run", stopped, "--quiet", "--solver", "monolithic", "--out", FOLDER / "one", expected=2, says=["solver.monolithic is one system"])
    dygita(2, "check", stopped, expected=2, says=["dygita check: cannot run on several MPI ranks"])
    dygita(2, "run", stopped, "--set", "usage=1", "--quiet", "--out", FOLDER / "none", expected=2, says=["usage"])
    dygita(2, "run", FOLDER / "none.lua", expected=2, says=["no deck"])
    apart = [asked.mpirun, "--allow-run-as-root", "--oversubscribe"]
    for folder in "apart_1", "apart_2":
        (FOLDER / folder).mkdir()
        apart += [":"] * (folder == "apart_2") + ["-n", "1", "--wdir", str(FOLDER / folder), asked.program, "run", str(stopped), "--out", "results"]
    done = subprocess.run(apart, capture_output=True, text=True, timeout=100, check=False)
    if done.returncode != 2 or "rank 0 was started in" not in done.stderr or list((FOLDER / "apart_1").iterdir()):
        failures.append(f"ranks in folders of their own: exit {done.returncode}\n{done.stdout}{done.stderr}")
    # A history that fails in the middle of a run fails on all ranks, and is told once.
    dygita(2, "run", stopped, "--set", "broken=1", "--quiet", "--out", FOLDER / "broken", expected=2, says=["no record at 20 us"])
    # What Lua orders otherwise in each process is declared in one order; what is another on each rank all the same is refused.
    (FOLDER / "row.lua").write_text(ROW.replace("PEAK", "100*MPa"))
    compare("row", FOLDER / "row.lua", "row", also=[3])
    (FOLDER / "chance.lua").write_text(ROW.replace("PEAK", "tonumber(tostring({}):match('0x(%x+)'), 16) % 100000000"))
    dygita(2, "run", FOLDER / "chance.lua", "--quiet", "--out", FOLDER / "chance", expected=2, says=["MPI ranks have read different steps from the deck"])
    # An error of the deck after a run leaves what the run has written.
    (FOLDER / "late.lua").write_text(ROW.replace("PEAK", "100*MPa") + "error('after all')\n")
    dygita(4, "run", FOLDER / "late.lua", "--quiet", "--out", FOLDER / "late", expected=2, says=["after all"])
    if not (FOLDER / "late" / "row" / "base" / "run.json").exists():
        failures.append("an error of the deck after a run took its results away")
    # Each rank writes the frames of its own parts; one that cannot ends the run, which keeps the rest.
    run = FOLDER / "barred" / "ranks" / "base"
    (run / "frames" / "block 15_00002.vtu" / "in the way").mkdir(parents=True)
    (run / "frames" / "block 1_00002.vtu" / "in the way").mkdir(parents=True)
    dygita(2, "run", asked.folder / "ranks.lua", "--quiet", "--out", FOLDER / "barred", expected=2,
           says=["_00002.vtu': ", "the results that could be written are in"])
    listed = (run / "ranks.pvd").read_text()
    if "_00001.vtu" not in listed or "_00002.vtu" in listed or not (run / "energy.csv").exists():
        failures.append(f"a frame that cannot be written: {sorted(p.name for p in run.iterdir())}\n{listed}")


for part in [asked.part] if asked.part else ["bits", "iterated", "continued", "refused"]:
    {"bits": bits, "iterated": iterated, "continued": continued, "refused": refused}[part]()
shutil.rmtree(FOLDER)
print("\n".join(failures) or "the same bits on several ranks")
sys.exit(1 if failures else 0)
