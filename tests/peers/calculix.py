"""CalculiX's own suite of tests against this program: every deck is imported or refused by line, and those that run here
run in ccx as well.

calculix.py [--program dygita] [--out FOLDER] [--table FILE.md] [NAMES ...]

Installs Debian's `calculix-ccx` and `calculix-ccx-test` where they are missing (as root). Ends with 1 where a deck makes
the program fail in any way other than by a message that names a line, and with 2 where fewer than --least decks agree.
"""

import argparse
import collections
import gzip
import math
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "random"))
import frames  # noqa: E402

SUITE = pathlib.Path("/usr/share/doc/calculix-ccx-test/examples/test")
AGREES = 0.01
HARDER = 1000  # contact of ccx, by whose stiffness it gives way, is made as hard as it is here
TIME = 120  # s of one program on one deck
# The cells of this program: full integration, and hexahedra of 8 nodes with incompatible modes.
SAME_CELLS = {"C3D20R": "C3D20", "C3D8": "C3D8I", "C3D8R": "C3D8I"}
# The suite states no units: the first in which its materials are plausible. Length in m, stress in Pa.
UNITS = {"mm t s": (1e-3, 1e6), "m kg s": (1.0, 1.0), "in lbf s": (0.0254, 4.4482216152605 / 0.0254**2)}
# What may be left of a deck whose natural modes are compared: steps that come after them, and dampers, which modes lack.
LATER = {"*DASHPOT", "*MODAL DYNAMIC", "*MODAL DAMPING", "*STEADY STATE DYNAMICS", "*COMPLEX FREQUENCY", "*BASE MOTION", "a step of another kind",
         "an amplitude in a step without motion"}


PAGE = """# Against CalculiX

Written by `tests/peers/calculix.py --table manual/verification/calculix.md`. It hands each deck of CalculiX's own suite (Debian's `calculix-ccx-test`) to `dygita import`. Decks that run here run in `ccx`, too,
twice: as they are, and with the cells of this program, full integration in place of C3D20R and C3D8R and the incompatible modes of C3D8I in place of C3D8, with contact a thousand times as stiff where there is any (as stiff as it is where ccx finds no answer of that in two minutes).

Displacements: largest difference over the largest displacement, of all nodes that have a place to themselves, at the end of the last step. Frequencies: largest relative difference of the modes that `*FREQUENCY` asks for.
Von Mises: root mean square difference at the nodes over the largest; the two programs carry stresses to the nodes in ways of their own.

The decks `beamdy*` and `beamf` have one beam, `dashpot*` and `spring5` one mass on a spring, whose modes are compared; the steps after them have no word here. Where the two differ by more than 1 % on the same cells:
`beam8f` in its torsional mode, in which lumped mass on 4 x 4 cells is 6 % low ([why](../howto/mesh.md#mesh-size)) and its first bending modes 0.3 %; `beamnl*` by the axial displacement of large rotations, 3/5 w^2/L of a
cantilever, which small displacements leave out, and so `beamplane` and `beamstraight`, which under a hundredth of their force differ by 0.05 and 0.09 %; `*nodirect` by time steps that ccx chooses itself. `beamcontact` by large
displacements (half of the 4 %) and by a mesh of two cells across: there ccx answers 0.123, 0.129 or 0.136 mm opposite the force with its three contacts and small displacements, this program 0.125 mm, and 0.137 mm with
cells of a third and a quarter of the size; `cubef2f3` by ccx's `*TIE`, from which ccx's contact face to face on the same meshes (`cubef2f2`) differs by as much, and from this program by 0.35 %.
`tests/peers/traced.py` prints these.

"""


def install():
    if shutil.which("ccx") and SUITE.is_dir():
        return
    subprocess.run(["apt-get", "install", "-y", "calculix-ccx", "calculix-ccx-test"], check=True)


def decks(names):
    for file in sorted(SUITE.glob("*.inp*")):
        name = file.name.split(".inp")[0]
        if names and name not in names:
            continue
        data = gzip.decompress(file.read_bytes()) if file.suffix == ".gz" else file.read_bytes()
        yield name, data.decode("latin-1").replace("\r\n", "\n")


def run(command, folder):
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", timeout=TIME)
        return done.returncode, done.stdout, done.stderr
    except subprocess.TimeoutExpired:
        return None, "", "no answer in time"


def of_ccx(text, is_same, harder=HARDER):
    """The deck with nodal results in every step, and with the cells of this program and hard contact if asked for."""
    if is_same:
        text = re.sub(r"(?im)(^\*SURFACE BEHAVIOR\b.*LINEAR.*\n\s*)([-+.\dE]+)", lambda m: f"{m[1]}{harder * float(m[2]):.6g}", text)
        text = re.sub(r"(?im)(^\*FRICTION\b.*\n[^,\n]*,\s*)([-+.\dE]+)", lambda m: f"{m[1]}{harder * float(m[2]):.6g}", text)
        text = re.sub(r"(?im)(^\*ELEMENT\b.*?TYPE\s*=\s*)([A-Z0-9]+)",
                      lambda m: m[1] + SAME_CELLS.get(m[2].upper(), m[2]), text)
    return re.sub(r"(?im)^(\*END\s*STEP)", r"*NODE FILE\nU\n*EL FILE\nS\n\1", text)


def fields_of_frd(file):
    """Places of nodes, and the last displacements and stresses by node."""
    places, last, block = {}, {}, None
    for line in file.read_text(errors="replace").splitlines():
        if line.startswith("    2C"):
            block = places
        elif line.startswith(" -4"):
            block = last[line[5:13].strip()] = {}
        elif line.startswith(" -3"):
            block = None
        elif line.startswith(" -1") and block is not None:
            values = line[13:].rstrip()
            block[int(line[3:13])] = [float(values[i:i + 12]) for i in range(0, len(values), 12)]
    return places, last


def frequencies_of_dat(file):
    found, is_table = [], False
    for line in file.read_text(errors="replace").splitlines():
        if "E I G E N V A L U E   O U T P U T" in line:
            found, is_table = [], True
        elif "P A R T I C I P A T I O N" in line:
            is_table = False
        elif is_table and re.match(r"^\s+\d+\s+[-\dE.+]+\s+[-\dE.+]+\s+[-\dE.+]+", line):
            found.append(float(line.split()[3]))
    return found


def mises(s):
    return math.sqrt(0.5 * ((s[0] - s[1])**2 + (s[1] - s[2])**2 + (s[2] - s[0])**2) + 3 * (s[3]**2 + s[4]**2 + s[5]**2))


def difference(ours, theirs, length, stress):
    """Largest difference of displacements over the largest displacement, of von Mises stresses over the largest; at places
    that a single node has in either program."""
    places, fields = theirs
    if "DISP" not in fields:
        return None
    size = max(max(abs(c) for c in x) for x in places.values()) or 1.0
    key = lambda x: tuple(round(c / size * 2e4) for c in x)  # noqa: E731
    at = collections.defaultdict(list)
    for node, x in places.items():
        at[key(x)].append(node)
    pairs, seen = [], collections.Counter(key([c / length for c in x]) for x, _, _ in ours)
    for x, u, s in ours:
        nodes = at.get(key([c / length for c in x]), [])
        if len(nodes) == 1 and seen[key([c / length for c in x])] == 1 and nodes[0] in fields["DISP"]:
            pairs.append((u, s, [length * c for c in fields["DISP"][nodes[0]][:3]], fields.get("STRESS", {}).get(nodes[0])))
    if len(pairs) < 0.5 * len(ours):
        return None
    largest = max(max(abs(c) for c in v) for _, _, v, _ in pairs) or 1.0
    of_u = max(max(abs(a - b) for a, b in zip(u, v)) for u, _, v, _ in pairs) / largest
    stressed = [(s, stress * mises(t)) for _, s, _, t in pairs if t]
    peak = max((t for _, t in stressed), default=0.0) or 1.0
    of_s = math.sqrt(sum((s - t)**2 for s, t in stressed) / max(len(stressed), 1)) / peak
    return of_u, of_s


def ours_of(folder):
    """Places, displacements and von Mises stresses of the last frame, or frequencies."""
    for file in folder.rglob("modes.csv"):
        rows = file.read_text().splitlines()
        column = [title.split(" ")[0] for title in rows[0].split(",")].index("frequency")
        return "frequencies", [float(row.split(",")[column]) for row in rows[1:]]
    nodes, last = [], {}
    for file in folder.rglob("frames/*.vtu"):
        part, number = file.stem.rsplit("_", 1)
        if file.parent.name == "frames" and number >= last.get(part, ("", None))[0]:
            last[part] = (number, file)
    for _, file in last.values():
        points, named = frames.arrays(file)
        stress = frames.numbers(named["von_mises"]) if "von_mises" in named else [0.0] * len(points)
        nodes += list(zip(points, frames.numbers(named["displacement"]), stress))
    return "fields", nodes


def compare(program, name, text, folder, units):
    rc, _, err = run([program, "run", f"{name}.lua", "--quiet", "--no-state", "--threads", "1", "--out", "ours"], folder)
    if rc == 1:
        return "not converged", err
    if rc != 0:
        return ("refused when run" if rc == 2 else "failed"), err
    kind, ours = ours_of(folder / "ours")
    answers = {}
    for label, is_same in (("as it is", False), ("same cells", True)):
        job = f"{name}_{'same' if is_same else 'ccx'}"
        for harder in (HARDER, 1) if is_same and "*SURFACE BEHAVIOR" in text.upper() else (HARDER,):
            (folder / f"{job}.inp").write_text(of_ccx(text, is_same, harder), encoding="latin-1")
            rc, out, _ = run(["ccx", job], folder)
            if rc == 0 and "*ERROR" not in out:
                break
        if rc != 0 or "*ERROR" in out:
            answers[label] = None
        elif kind == "frequencies":
            theirs = frequencies_of_dat(folder / f"{job}.dat")
            n = min(len(theirs), len(ours))
            top = max(theirs[:n], default=0.0)
            flexible = [(a, b) for a, b in zip(ours[:n], theirs[:n]) if b > 1e-3 * top]
            answers[label] = (max(abs(a / b - 1) for a, b in flexible), None) if flexible else None
        else:
            answers[label] = difference(ours, fields_of_frd(folder / f"{job}.frd"), *UNITS[units])
    return kind, answers


def keyword_of(line):
    found = re.search(r"(\*[A-Za-z][A-Za-z -]*)", line)
    return re.sub(r"\s", " ", found[1]).strip().upper() if found else line.split(": ")[-1]


def percent(value):
    return "-" if value is None else f"{100 * value:.3f}"


def study(program, name, text, out):
    """What became of a deck: a word, and what belongs to it."""
    folder = out / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / f"{name}.inp").write_text(text, encoding="latin-1")
    for units in UNITS:
        rc, deck, err = run([program, "import", f"{name}.inp", "--units", units], folder)
        if rc != 0:
            break
        (folder / f"{name}.lua").write_text(re.sub(r"(?m)^error\(.*\)$", "", deck))
        if "is outside the plausible range" not in run([program, "check", f"{name}.lua"], folder)[2]:
            break
    if rc == 2 and re.search(r"\.inp:\d+: |has no element that is a cell|has parts and no", err):
        return "refused", err.splitlines()[0]
    if rc != 0:
        return "FAULT", f"{rc}: {err}"
    (folder / f"{name}.lua").write_text(deck)
    left = [line[len("-- NOT TRANSLATED: "):] for line in deck.splitlines() if line.startswith("-- NOT TRANSLATED: ")]
    if left and "output.modes" in deck and {keyword_of(line) for line in left} <= LATER:
        (folder / f"{name}.lua").write_text(re.sub(r"(?m)^error\(.*\)$", "", deck))
    elif left:
        rc, _, err = run([program, "check", f"{name}.lua"], folder)
        return ("blocked", left) if rc == 2 and "not translated" in err else ("FAULT", f"it runs although lines are left: {rc} {err}")
    return compare(program, name, text, folder, units)


def table_of(rows):
    lines = ["| deck | compared | displacement or frequency, same cells % | von Mises (rms), same cells % | displacement or frequency, deck as it is % |",
             "| --- | --- | --- | --- | --- |"]
    for name, kind, answers in rows:
        same, plain = answers["same cells"] or (None, None), answers["as it is"] or (None, None)
        lines.append(f"| {name} | {kind} | {percent(same[0])} | {percent(same[1])} | {percent(plain[0])} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/release/dygita"))
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/peers")
    parser.add_argument("--table", type=pathlib.Path, help="file for the table, Markdown")
    parser.add_argument("--least", type=int, default=0, help="decks that must agree")
    parser.add_argument("names", nargs="*")
    asked = parser.parse_args()
    install()
    ends, blocked, alone, rows = collections.defaultdict(list), collections.Counter(), collections.Counter(), []
    for name, text in decks(asked.names):
        end, what = study(str(pathlib.Path(asked.program).resolve()), name, text, asked.out.resolve())
        ends[end].append(name)
        if end in ("fields", "frequencies"):
            rows.append((name, end, what))
        elif end == "blocked":
            words = {keyword_of(line) for line in what}
            words = {re.sub(r"'.*?'", "...", word)[:60] for word in words}
            blocked.update(words)
            alone.update(words if len(words) == 1 else ())
        print(name, end, what if isinstance(what, (str, dict)) else "; ".join(sorted(words)), flush=True)
    good = [name for name, _, answers in rows if (answers["same cells"] or (1,))[0] <= AGREES]
    as_is = [name for name, _, answers in rows if (answers["as it is"] or (1,))[0] <= AGREES]
    table = table_of(rows)
    summary = [f"{sum(map(len, ends.values()))} decks: " + ", ".join(f"{len(names)} {end}" for end, names in sorted(ends.items())),
               f"{len(good)} agree within 1 % with ccx on the same cells, {len(as_is)} on the deck as it is",
               "keywords that block decks (alone): " + ", ".join(f"{word} {n} ({alone[word]})" for word, n in blocked.most_common(25))]
    print(table + "\n" + "\n".join(summary))
    if asked.table:
        asked.table.write_text(PAGE + table + "\n" + "\n\n".join(summary) + "\n")
    if ends["FAULT"]:
        sys.exit(1)
    if len(good) < asked.least:
        sys.exit(2)


if __name__ == "__main__":
    main()
