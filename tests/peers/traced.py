"""Decks of CalculiX's suite that differ by more than 1 % from this program although the cells are the same: what ccx answers with
its other contacts, and what smaller cells answer.

traced.py [--program dygita] [--out FOLDER]
"""

import argparse
import pathlib
import re
import shutil
import subprocess

import calculix

BEAM = pathlib.Path(__file__).with_name("beamcontact.lua")
PLACES = ((1, 0.75, 4), (1, 0.75, 2), (1, 0.75, 6), (1, 0, 7))


def answer_of_ccx(text, folder):
    (folder / "traced.inp").write_text(text, encoding="latin-1")
    subprocess.run(["ccx", "traced"], cwd=folder, capture_output=True, timeout=calculix.TIME, check=True)
    return calculix.fields_of_frd(folder / "traced.frd")


def at(answer, place):
    places, fields = answer
    node = next(n for n, x in places.items() if max(abs(a - b) for a, b in zip(x, place)) < 1e-4)
    return fields["DISP"][node][0]


def beamcontact(program, folder):
    print("beamcontact, x displacement (mm) at", *PLACES)
    deck = calculix.of_ccx(dict(calculix.decks(["beamcontact"]))["beamcontact"], True)
    small = deck.replace(",NLGEOM", "")
    kinds = {"surface to surface, as in the deck": deck, "the same, small displacements": small, "node to surface": small.replace("SURFACE TO SURFACE", "NODE TO SURFACE"),
             "mortar": small.replace("TYPE=SURFACE TO SURFACE", "TYPE=MORTAR")}
    for name, text in kinds.items():
        answer = answer_of_ccx(text, folder)
        print(f"  ccx, {name}: " + ", ".join(f"{at(answer, place):.5f}" for place in PLACES))
    for nx, nz in ((2, 8), (4, 16), (6, 32)):
        command = [program, "run", str(BEAM), "--set", f"nx={nx}", "--set", f"ny={nx}", "--set", f"nz={nz}", "--quiet", "--no-state", "--threads", "1", "--out", "ours"]
        said = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout
        print(f"  dygita, {nx} x {nx} x {nz} cells: " + ", ".join(re.findall(r": (-?[\d.]+) mm", said)))


def cubef2f3(program, folder):
    decks = dict(calculix.decks(["cubef2f2", "cubef2f3"]))
    kind, _ = calculix.study(program, "cubef2f3", decks["cubef2f3"], folder)
    ours = calculix.ours_of(folder / "cubef2f3" / "ours")[1]
    print(f"cubef2f3 ({kind}), largest difference over the largest displacement")
    for name, text in (("*TIE, as in the deck", decks["cubef2f3"]), ("contact face to face, as in cubef2f2", decks["cubef2f2"])):
        answer = answer_of_ccx(calculix.of_ccx(text, False), folder)
        print(f"  ccx, {name}: {100 * calculix.difference(ours, answer, *calculix.UNITS['mm t s'])[0]:.2f} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(calculix.ROOT / "build/release/dygita"))
    parser.add_argument("--out", type=pathlib.Path, default=calculix.ROOT / "build/peers/traced")
    asked = parser.parse_args()
    calculix.install()
    shutil.rmtree(asked.out, ignore_errors=True)
    asked.out.mkdir(parents=True)
    program, folder = str(pathlib.Path(asked.program).resolve()), asked.out.resolve()
    beamcontact(program, folder)
    cubef2f3(program, folder)


if __name__ == "__main__":
    main()
