"""Folders of runs from strangers, and files that are too large: refused with a message, or continued to the right answer;
no crash, no hang, no file outside, no number that is not one.

hostile_folders.py PROGRAM FOLDER_OF_THE_DECKS
"""

import json
import os
import pathlib
import resource
import shutil
import signal
import stat
import struct
import subprocess
import sys
import tempfile
import time

PROGRAM, DECKS = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_hostile_"))
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)


def dygita(*words, expected, says="", limits=()):
    """expected: an exit code, or several that are all right."""
    def set_limits():
        for limit, value in limits:
            resource.setrlimit(limit, (value, value))
    try:
        done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, errors="replace", timeout=100, check=False,
                              cwd=FOLDER, preexec_fn=set_limits)
    except subprocess.TimeoutExpired:
        failures.append(f"dygita {' '.join(map(str, words))}: hangs")
        return ""
    output = done.stdout + done.stderr
    codes = expected if isinstance(expected, tuple) else (expected,)
    check(done.returncode in codes and says in output,
          f"dygita {' '.join(map(str, words))}: exit {done.returncode}, expected {expected} and '{says}'\n{output}")
    return output


def run(out, *more, deck="stopped.lua", expected=0):
    return dygita("run", DECKS / deck, "--quiet", "--threads", 1, "--out", out, *more, expected=expected)


def killed(out, case, *more, deck="stopped.lua", after=0.0):
    """A run that was killed so long (s) after this case had some frames; the folder of the case."""
    process = subprocess.Popen([PROGRAM, "run", str(DECKS / deck), "--quiet", "--threads", "1", "--out", str(out), *more],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None and sum(1 for _ in (out / case).rglob("*.vtu")) < 6:
        time.sleep(0.001)
    time.sleep(after)
    process.send_signal(signal.SIGKILL)
    process.wait()
    return out / case


def names_below(folder):
    return {str(p.relative_to(folder)) for p in folder.rglob("*")}


def tables(folder):
    return {p.name: p.read_bytes() for p in folder.glob("*.csv")}


def checksum(data, start=0xCBF29CE484222325):
    """As base/fnv1a.hpp takes it, by words."""
    mask, value = (1 << 64) - 1, start
    for at in range(0, len(data), 8):
        piece = data[at:at + 8]
        word = int.from_bytes(piece if len(piece) == 8 else piece + (len(piece)).to_bytes(8, "little")[len(piece):], "little")
        value = ((value ^ word) * 0x100000001B3) & mask
        value = ((value << 29) | (value >> 35)) & mask
    return value


def files_too_large():
    """Said before anything is read: no memory, no time."""
    folder = FOLDER / "large"
    folder.mkdir()
    uses = {"csv": 'history.file{ file = "large.csv" }', "geo": 'mesh.gmsh{ file = "large.geo" }', "msh": 'mesh.gmsh{ file = "large.msh" }',
            "step": 'mesh.step{ file = "large.step" }', "inp": 'mesh.abaqus{ file = "large.inp", unit = mm }', "bdf": 'mesh.nastran{ file = "large.bdf", unit = mm }'}
    uses |= {kind: f'substructure.superelement{{ name = "s", stiffness = "large.{kind}", mass = "large.{kind}", points = "points.csv", units = "m kg s" }}' for kind in ("mtx", "op4", "pch")}
    (folder / "points.csv").write_text("face,x,y,z\nend,0,0,0\n")
    for kind, use in uses.items():
        with open(folder / f"large.{kind}", "wb") as file:
            file.write(b"$MeshFormat\n" if kind == "msh" else b"\n")
            file.truncate(50 << 30)
        (folder / f"{kind}.lua").write_text(use + "\n")
        of_file = kind not in ("inp", "bdf", "mtx", "op4", "pch")  # else of what it would take, which is asked first
        dygita("check", folder / f"{kind}.lua", expected=2, says=("has 5.12e+04 " if of_file else "") + "MB; the limit is 1024 MB\n    --memory-limit raises the limit")
    (folder / "small.lua").write_text('history.file{ file = "points.csv" }\n' + "-- " + "x" * (2 << 20) + "\n")
    dygita("check", folder / "small.lua", "--memory-limit", 1, expected=2, says="MB; the limit is 1 MB")
    for command, kind in (("srs", "csv"), ("import", "inp"), ("import", "bdf"), ("run", "geo")):
        dygita(command, folder / f"large.{kind}", expected=2, says="MB; the limit is 1024 MB")
    shutil.rmtree(folder)


def files_that_may_not_grow():
    """RLIMIT_FSIZE: an error that says so, and how the run goes on."""
    out = FOLDER / "small_files"
    output = dygita("run", DECKS / "stopped.lua", "--quiet", "--threads", 1, "--out", out, expected=2,
                    says="the file would be larger than this process may write (ulimit -f)", limits=[(resource.RLIMIT_FSIZE, 12000)])
    check("cannot write '" in output, output)


def records_to_repeat(whole):
    """Whatever is in run.json: an error of the user's input, and nothing is written but where --out says."""
    record = json.loads((whole / "run.json").read_text())
    text = json.dumps(record)
    other = dict(record, problem="../../evil", case="..")
    lies = {
        "cut": text[:len(text) // 2], "empty": "", "list": "[]", "deep": "[" * 200000, "nan": text.replace('"threads": 1', '"threads": NaN'),
        "huge": text.replace('"threads": 1', '"threads": 1e400'), "dots": json.dumps(other),
        "digest": json.dumps(dict(record, deck=dict(record["deck"], digest="0" * 16))),
        "mesh": json.dumps(dict(record, substructures=[dict(part, digest="0" * 16) for part in record["substructures"]])),
        "deck": json.dumps(dict(record, deck=dict(record["deck"], path="/dev/zero"))),
        "deck_gone": json.dumps(dict(record, deck=dict(record["deck"], path="no\n'deck\"$(touch x)"))),
        "parameters": json.dumps(dict(record, parameters={"us": "os.exit()"})),
        "parameter": json.dumps(dict(record, parameters={"us=1 us": 3.0, "'\n": 1})),
        "parameter_huge": json.dumps(dict(record, parameters=dict(record["parameters"], us=1e300))),
        "solver": json.dumps(dict(record, solver=dict(record["solver"], command_line="latin{} os.execute('touch x') --"))),
        "files": json.dumps(dict(record, files=["../../../etc/passwd.csv", "/dev/zero.csv", 7])),
        "files_text": json.dumps(dict(record, files="all")),
        "from": json.dumps(dict(record, options=dict(record.get("options", {}), **{"from": "/dev"}))),
        "options": json.dumps(dict(record, options=[1])),
    }
    for name, lie in lies.items():
        copy = FOLDER / "repeated" / "stopped" / name
        shutil.copytree(whole, copy)
        (copy / "run.json").write_text(lie)
        before = names_below(FOLDER)
        dygita("run", "--repeat", copy, "--quiet", "--threads", 1, "--out", FOLDER / "again", expected=2)
        new = {n for n in names_below(FOLDER) - before if not n.startswith("again")}
        check(not new, f"--repeat of a record with {name}: {new} came")
    # A table that leads elsewhere, or that has no end, is none to compare with.
    copy = FOLDER / "repeated" / "stopped" / "tables"
    shutil.copytree(whole, copy)
    (copy / "joint.csv").unlink()
    (copy / "joint.csv").symlink_to("/dev/zero")
    dygita("run", "--repeat", copy, "--quiet", "--threads", 1, "--out", FOLDER / "again", expected=2, says="'joint.csv' is not a file")
    (copy / "joint.csv").unlink()
    with open(copy / "joint.csv", "wb") as file:
        file.truncate(2 << 30)
    dygita("run", "--repeat", copy, "--quiet", "--threads", 1, "--out", FOLDER / "again", expected=2,
           says="joint.csv' has 2048 MB; the limit is 1024 MB")
    shutil.rmtree(FOLDER / "repeated")


def with_fields(state, change):
    """The state with its fields changed, and their checksum put right."""
    data = bytearray(state)
    length, = struct.unpack_from("<Q", data, 16)
    begin = 24 + length + 8
    change(data, begin)
    struct.pack_into("<Q", data, len(data) - 8, checksum(bytes(data[begin:-8])))
    return bytes(data)


def numbers_that_are_none(whole):
    """In a state that is otherwise whole: nothing is computed from them."""
    state = (whole / "state.dygita").read_bytes()
    check(with_fields(state, lambda data, begin: None) == state, "the checksum of this test is another")
    for name, number in (("nan", float("nan")), ("inf", float("inf"))):
        copy = FOLDER / "numbers" / "stopped" / "base"
        shutil.copytree(whole, copy)
        (copy / "state.dygita").write_bytes(with_fields(state, lambda data, begin: struct.pack_into("<d", data, begin + 80, number)))
        dygita("continue", copy, "--tolerance", "1e-9", "--quiet", "--threads", 1, expected=2, says="numbers that are not finite")
        dygita("run", DECKS / "stopped.lua", "--from", copy, "--quiet", "--threads", 1, "--out", FOLDER / "from", expected=2,
               says="numbers that are not finite")
        shutil.rmtree(FOLDER / "numbers")


def checkpoints_with_numbers_that_are_none():
    base = killed(FOLDER / "killed", "stopped/base", "--set", "us=20000", after=2.0)  # written each second
    data = bytearray((base / "checkpoint.dygita").read_bytes())
    at, total = 16, 0
    for record in range(3):  # the header and two entries: the second is spoiled, what follows it is cut off
        length, = struct.unpack_from("<Q", data, at)
        if record == 2:
            struct.pack_into("<d", data, at + 8 + 8, float("nan"))
        payload = bytes(data[at + 8:at + 8 + length])
        total = checksum(payload, checksum(struct.pack("<Q", total)))
        if record == 2:
            struct.pack_into("<Q", data, at + 8 + length, total)
        else:
            check(struct.unpack_from("<Q", data, at + 8 + length)[0] == total, "the checksum of this test is another")
        at += 16 + length
    (base / "checkpoint.dygita").write_bytes(bytes(data[:at]))
    dygita("continue", base, "--quiet", "--threads", 1, expected=2, says="numbers that are not finite")
    text = (base / "continue.txt").read_text() if (base / "continue.txt").exists() else ""
    check(text == f"This run has not come to its end. To continue it:\n    dygita continue {base}\n",
          "what says how to continue is another, or not there")


def folders_moved():
    """What a study still has to compute goes beside the run only where the folders have its names."""
    killed(FOLDER / "moved", "study/mu 0.2", "--set", "us=2000", deck="study.lua")
    home = FOLDER / "moved" / "elsewhere" / "downloads"
    home.mkdir(parents=True)
    (FOLDER / "moved" / "study" / "mu 0.2").rename(home / "case")
    before = names_below(FOLDER / "moved")
    dygita("continue", home / "case", "--quiet", "--threads", 1, expected=2, says="give its folders their names: study/mu 0.2")
    new = {n for n in names_below(FOLDER / "moved") - before if not n.startswith("elsewhere/downloads/case/")}
    check(not new, f"continued in a folder of another name, {new} came")


def tables_of_other_cases():
    """Read where a study goes on: what is no table of that output is refused, and no number that is none is believed."""
    killed(FOLDER / "cases", "study/mu 0.2", "--set", "us=2000", deck="study.lua")
    kept = (FOLDER / "cases" / "study" / "mu 0.1" / "joint.csv").read_text()
    lines = kept.splitlines()
    lies = {"cut": kept[:len(kept) // 2], "empty": "", "title": "time [s]\n0\n", "one": lines[0] + "\n",
            "nan": "\n".join([lines[0], lines[1].rsplit(",", 1)[0] + ",nan"]) + "\n", "swapped": (FOLDER / "cases" / "study" / "mu 0.1" / "energy.csv").read_text()}
    for name, lie in lies.items():
        copy = FOLDER / "cases_of" / name
        shutil.copytree(FOLDER / "cases", copy)
        (copy / "study" / "mu 0.1" / "joint.csv").write_text(lie)
        output = dygita("continue", copy / "study", "--quiet", "--threads", 1, expected=2, says="joint" if name == "one" else "joint.csv")
        check("mu 0.1: slip" not in output, f"a number of a table that is {name}: {output}")


def states_that_are_not_what_they_say(whole):
    state = (whole / "state.dygita").read_bytes()
    other = FOLDER / "other"
    run(other, "--set", "us=40")
    lies = {"cut": state[:-100], "twice": state + state, "version": state[:8] + b"\xff" * 4 + state[12:], "length": state[:16] + b"\xff" * 8 + state[24:],
            "one": state[:1], "zeros": bytes(len(state))}
    for name, lie in lies.items():
        copy = FOLDER / "states" / "stopped" / name
        shutil.copytree(whole, copy)
        (copy / "state.dygita").write_bytes(lie)
        dygita("continue", copy, "--tolerance", "1e-9", "--quiet", expected=2, says="cannot be used")
        dygita("run", DECKS / "stopped.lua", "--from", copy, "--quiet", "--out", FOLDER / "from", expected=2, says="cannot be used")
    copy = FOLDER / "states" / "stopped" / "large"
    shutil.copytree(whole, copy)
    with open(copy / "state.dygita", "r+b") as file:
        file.truncate(200 << 30)
        file.seek(16)
        file.write(struct.pack("<Q", 100 << 30))
    dygita("continue", copy, "--tolerance", "1e-9", "--quiet", expected=2, says="does not fit into memory")


def replaced_by(path, kind, others):
    """What somebody may have put in the place of a file of ours; `others` is a file of somebody's."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    path.unlink(missing_ok=True)
    path.parent.mkdir(parents=True, exist_ok=True)
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "endless":
        path.symlink_to("/dev/zero")
    elif kind == "device":
        os.mknod(path, stat.S_IFCHR | 0o666, os.makedev(1, 5))
    elif kind == "link":
        path.symlink_to(others)
    elif kind == "second name":
        os.link(others, path)
    elif kind == "folder":
        path.mkdir()
    else:
        path.write_bytes(b"")
        os.truncate(path, {"empty": 0, "huge": 60 << 30}[kind])


KINDS = ["pipe", "endless", "link", "second name", "folder", "empty", "huge"] + (["device"] if os.geteuid() == 0 else [])


def members_before():
    """An ensemble that runs where another has run: it takes away the members of that one, and nothing else."""
    whole = FOLDER / "members"
    run(whole, deck="ensemble.lua")

    def over(name, prepare, expected=0, says=""):
        out, others = FOLDER / "over", FOLDER / "others"
        for path in (out, others):
            shutil.rmtree(path, ignore_errors=True)
        shutil.copytree(whole, out)
        shutil.copytree(whole / "struck" / "ensemble_1", others / "run")
        (others / "precious").write_text("precious")
        prepare(out / "struck", others)
        before = {p: p.read_bytes() for p in others.rglob("*") if p.is_file()}
        dygita("run", DECKS / "ensemble.lua", "--quiet", "--threads", 1, "--out", out, "--set", "n=3", expected=expected, says=says)
        after = {p: p.read_bytes() for p in others.rglob("*") if p.is_file()}
        check(before == after, f"an ensemble over {name}: files of somebody else came, went or changed")
        return out / "struck"

    def linked(name):
        def prepare(struck, others):
            replaced_by(struck / name, "link", others / "run")
        return prepare

    out = over("its members", lambda struck, others: None)
    check(sorted(p.name for p in out.iterdir()) == ["ensemble", "ensemble_1", "ensemble_2", "ensemble_3"], "the members that were before")
    over("a folder of statistics that is a link", linked("ensemble"), 2, "is a link, and files would be written where it leads: remove it")
    over("a member that is a link", linked("ensemble_1"), 2, "is a link, and files would be written where it leads: remove it")
    over("a member before that is a link", linked("ensemble_4"))

    def names_others(struck, others):
        record = json.loads((struck / "ensemble" / "ensemble.json").read_text())
        names = ["base", "ensemble_notes", "..", "../others/run", "", "ensemble", "ensemble_", "ensemble_4/../base"]
        (struck / "ensemble" / "ensemble.json").write_text(json.dumps(dict(record, members=[{"name": name} for name in names])))
        for name in ("base", "ensemble_notes"):
            shutil.copytree(struck / "ensemble_1", struck / name)

    out = over("a record that names other cases", names_others)
    check(all((out / name / "run.json").exists() for name in ("base", "ensemble_notes")), "cases that are no members went")
    for kind in KINDS:
        expected = (0, 2) if kind == "folder" else 0
        over(f"a record that is of kind '{kind}'", lambda struck, others: replaced_by(struck / "ensemble" / "ensemble.json", kind, others / "precious"), expected)
        over(f"a table that is of kind '{kind}'", lambda struck, others: replaced_by(struck / "ensemble" / "top.csv", kind, others / "precious"), expected)
        listed = "ensemble_4/.dygita-files"
        over(f"a list that is of kind '{kind}'", lambda struck, others: replaced_by(struck / listed, kind, others / "precious"), (0, 2) if kind == "huge" else 0)
    over("a list of files elsewhere", lambda struck, others: (struck / "ensemble_4" / ".dygita-files").write_text(f"../../../others/precious\n{others}/precious\n"))


def members_repeated():
    """`run --repeat` of a member: what is beside its record is no more believed than that of a run."""
    whole = FOLDER / "members" / "struck" / "ensemble_1"

    def repeated(name, file, kind, expected, says=""):
        copy, others = FOLDER / "of_member" / "struck" / "ensemble_1", FOLDER / "others"
        for path in (FOLDER / "of_member", FOLDER / "again"):
            shutil.rmtree(path, ignore_errors=True)
        shutil.copytree(whole, copy)
        others.mkdir(exist_ok=True)
        (others / "precious").write_text("precious")
        replaced_by(copy / file, kind, others / "precious")
        before = names_below(FOLDER)
        dygita("run", "--repeat", copy, "--quiet", "--threads", 1, "--out", FOLDER / "again", expected=expected, says=says)
        new = {n for n in names_below(FOLDER) - before if not n.startswith("again")}
        check(not new and (others / "precious").read_text() == "precious", f"--repeat of a member with {name}: {new} came")

    for kind in KINDS:
        repeated(f"a record of kind '{kind}'", "run.json", kind, 2)
        repeated(f"a table of kind '{kind}'", "top.csv", kind, 1 if kind in ("link", "second name", "empty") else 2)
    repeated("a state of kind 'pipe'", "state.dygita", "pipe", 0)
    repeated("a list of kind 'pipe'", ".dygita-files", "pipe", 0)


def members_that_go_on():
    """A killed ensemble is continued from its members' folders: each is asked whose it is, and whether it is whole."""
    killed(FOLDER / "stopped_members", "struck/ensemble_2", "--set", "us=2000", deck="ensemble.lua")

    def go_on(name, prepare, expected, says=""):
        out, others = FOLDER / "going_on", FOLDER / "others"
        for path in (out, others):
            shutil.rmtree(path, ignore_errors=True)
        shutil.copytree(FOLDER / "stopped_members", out)
        shutil.copytree(out / "struck" / "ensemble_1", others / "run")
        (others / "precious").write_text("precious")
        prepare(out / "struck", others)
        before = {p: p.read_bytes() for p in others.rglob("*") if p.is_file()}
        dygita("continue", out / "struck", "--quiet", "--threads", 1, expected=expected, says=says)
        check(before == {p: p.read_bytes() for p in others.rglob("*") if p.is_file()}, f"continued with {name}: files of somebody else changed")

    def exchanged(struck, others):
        (struck / "ensemble_1").rename(struck / "aside")
        (struck / "ensemble_4").rename(struck / "ensemble_1")
        (struck / "aside").rename(struck / "ensemble_4")

    def lines(file, change):
        def prepare(struck, others):
            rows = (struck / file).read_text().splitlines()
            (struck / file).write_text("\n".join(change(rows)) + "\n")
        return prepare

    # The members go from neighbour to neighbour: 1, 4, 2, 3.
    go_on("nothing done to it", lambda struck, others: None, 0)
    go_on("members exchanged", exchanged, 2, "case 'ensemble_4', not of problem 'struck', case 'ensemble_1'")
    go_on("rows cut off", lines("ensemble_1/top.csv", lambda rows: rows[:-3]), 2, "top.csv has 3998 rows of step 'push', which has 4000 increments: it is cut off")
    go_on("rows in another order", lines("ensemble_4/top.csv", lambda rows: rows[:5] + rows[6:4:-1] + rows[7:]), 2, "rows are not in the order of time")
    go_on("statistics that lead elsewhere", lambda struck, others: replaced_by(struck / "ensemble", "link", others / "run"), 2, "is a link, and files would be written")
    go_on("a member to come that leads elsewhere", lambda struck, others: replaced_by(struck / "ensemble_3", "link", others / "run"), 2)
    for kind in KINDS:
        for file, expected in (("ensemble_2/checkpoint.dygita", 2), ("ensemble_1/joint.csv", 2), ("ensemble_4/state.dygita", 2), ("ensemble_1/run.json", (0, 2)),
                               (".ensemble_3.lock", 0 if kind in ("empty", "huge") else 2)):
            go_on(f"{file} of kind '{kind}'", lambda struck, others: replaced_by(struck / file, kind, others / "precious"), expected)


def meshes_kept():
    """The folder of meshes beside a deck: what is there is taken where it is signed, else it is as if it were not there."""
    scene, out = FOLDER / "meshes", FOLDER / "meshed"
    scene.mkdir()
    shutil.copy(DECKS.parent / "intake" / "ring_on_plate.step", scene / "a.step")
    deck = scene / "deck.lua"
    deck.write_text("""
local s = substructure{ name = "s", mesh = mesh.step{ file = "a.step", size = 20*mm, parts = { "1" } }:part "1",
  material = material.elastic{ name = "m", young = 200*GPa, poisson = 0.3, density = 7800 } }
problem{ name = "p", substructures = { s }, supports = { support.fixed{ name = "f", on = s:face "surface1" } },
  steps = { step.static{ name = "g", loads = { load.gravity{ z = -10 } } } },
  outputs = { output.history{ name = "u", on = s:face "surface2", quantity = "displacement" } } }:run{}
""")
    os.environ["XDG_STATE_HOME"] = str(FOLDER / "home")
    words = ["run", deck, "--quiet", "--threads", 1, "--out", out]
    dygita(*words, expected=0)
    table, kept = (out / "p" / "base" / "u.csv").read_bytes(), scene / ".dygita"
    entries = list(kept.glob("*.mesh"))
    check(len(entries) == 1, f"{len(entries)} meshes kept")
    entry, whole = entries[0], entries[0].read_bytes()
    secret = FOLDER / "home" / "dygita" / "secret"
    own, others = secret.read_bytes(), scene / "others"
    others.write_text("precious")
    lies = {"cut": whole[:len(whole) // 2], "head": whole[:46], "length": whole[:46] + b"\xff" * 8 + whole[54:], "sign": whole[:46] + struct.pack("<Q", 1 << 63) + whole[54:]}

    def meshed(name, prepare):
        replaced_by(kept, "folder", others)
        entry.write_bytes(whole)
        shutil.rmtree(secret.parent)
        secret.parent.mkdir()
        secret.write_bytes(own)
        secret.chmod(0o600)
        prepare()
        before = names_below(FOLDER)
        dygita(*words, expected=0)
        new = {n for n in names_below(FOLDER) - before if not n.startswith("meshes/.dygita")}
        check((out / "p" / "base" / "u.csv").read_bytes() == table, f"a mesh kept: {name}: another answer")
        check(not new and others.read_text() == "precious", f"a mesh kept: {name}: {new} came, or what others have changed")

    meshed("whole", lambda: None)
    for name, lie in lies.items():
        meshed(name, lambda: entry.write_bytes(lie))
    for kind in KINDS:
        meshed(f"entry of kind '{kind}'", lambda: replaced_by(entry, kind, others))
        meshed(f"secret of kind '{kind}'", lambda: replaced_by(secret, kind, others))
        if kind != "second name":
            meshed(f"folder of kind '{kind}'", lambda: replaced_by(kept, kind, scene if kind == "link" else others))
    meshed("secret of all", lambda: secret.chmod(0o644))
    if os.geteuid() == 0:
        meshed("secret of another user", lambda: os.chown(secret, 65534, 65534))
    del os.environ["XDG_STATE_HOME"]


def main():
    members_before()
    members_repeated()
    members_that_go_on()
    meshes_kept()
    files_too_large()
    files_that_may_not_grow()
    run(FOLDER / "whole")
    whole = FOLDER / "whole" / "stopped" / "base"
    check(not (whole / "continue.txt").exists(), "a run that has come to its end says how to continue it")
    records_to_repeat(whole)
    numbers_that_are_none(whole)
    states_that_are_not_what_they_say(whole)
    checkpoints_with_numbers_that_are_none()
    folders_moved()
    tables_of_other_cases()


main()
shutil.rmtree(FOLDER)
print("\n".join(failures) or "folders of strangers do no harm")
sys.exit(1 if failures else 0)
