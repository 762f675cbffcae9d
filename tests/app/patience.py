"""Nobody waits without a word: what takes long says what it does, and ends within two seconds of Ctrl-C or SIGTERM.

patience.py PROGRAM
"""

import os
import pathlib
import pty
import select
import signal
import subprocess
import sys
import tempfile
import time

PROGRAM = sys.argv[1]
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_patience_"))
STOPPED, SLACK = 130, 2.0  # s, beyond the two seconds that are promised: other tests run beside this one
NOTHING_SOLVED = "nothing was solved"
failures = []

SLOW_SOLID = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
MeshSize{ PointsOf{ Volume{1}; } } = 0.006;
"""

MESHED = """local block = substructure{ name = "block", mesh = mesh.gmsh{ file = "slow.geo" }:volume "volume1",
  material = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7850 } }
"""

# Two blocks of many facets that do not match.
JOINED = """local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7850 }
local lower = substructure{ name = "lower", material = steel, mesh = mesh.box{ size = { 1, 1, 0.01 }, cells = { 300, 300, 1 } } }
local upper = substructure{ name = "upper", material = steel, place = { translate = { 0, 0, 0.01 } },
  mesh = mesh.box{ size = { 1, 1, 0.01 }, cells = { 297, 297, 1 } } }
local joint = interface.contact{ name = "joint", between = { lower:face "zmax", upper:face "zmin" }, friction = 0.2 }
local base = support.fixed{ name = "base", on = lower:face "zmin" }
problem{ name = "joined", substructures = { lower, upper }, interfaces = { joint }, supports = { base },
  steps = { step.static{ name = "press", loads = { load.pressure{ on = upper:face "zmax", history = history.constant{ value = 1*MPa } } } } } }:run{}
"""

# One body whose factor takes many seconds.
LARGE = """local cube = substructure{ name = "cube", mesh = mesh.box{ size = { 1, 1, 1 }, cells = { 36, 36, 36 } },
  material = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7850 } }
problem{ name = "large", substructures = { cube }, supports = { support.fixed{ name = "base", on = cube:face "zmin" } },
  solver = solver.latin{ integration = "implicit", pieces = 1 },
  steps = { step.dynamic{ name = "push", duration = 100*us, dt = 10*us, loads = { load.pressure{ on = cube:face "zmax", history = 1*MPa } } } } }:run{}
"""

# Units of a bar in many time steps: the first by itself, the other one after it.
UNITS = """local bar = substructure{ name = "bar", mesh = mesh.box{ size = { 1, 0.1, 0.1 }, cells = { 20, 2, 2 } },
  material = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7850 } }
ensemble{ n = 2, vary = { p = uniform(1, 2)*MPa }, of = function(v)
  return problem{ name = "units", substructures = { bar }, supports = { support.fixed{ name = "base", on = bar:face "xmin" } },
    solver = solver.latin{ integration = "implicit" },
    steps = { step.dynamic{ name = "push", duration = 10*ms, dt = 1*us, loads = { load.pressure{ on = bar:face "xmax", history = v.p } } } } }
end }:run{}
"""


def check(condition, what):
    if not condition:
        failures.append(what)


def deck(name, text):
    path = FOLDER / name
    path.write_text(text)
    return path


def wait_for(said, until, process, longest=120.0):
    """Reads until what was said has the words; how long that took."""
    start = time.monotonic()
    while until not in said():
        if process.poll() is not None or time.monotonic() - start > longest:
            failures.append(f"'{until}' was not said in {time.monotonic() - start:.0f} s, but: {said()[-500:]}")
            break
        time.sleep(0.02)
    return time.monotonic() - start


def end_of(process, number, what):
    """Sends a signal; the process must end in time."""
    start = time.monotonic()
    process.send_signal(number)
    try:
        code = process.wait(timeout=30)
    except subprocess.TimeoutExpired:
        process.kill()
        failures.append(f"{what}: {number.name} was not heard within 30 s")
        return
    took = time.monotonic() - start
    check(code == STOPPED, f"{what}: exit {code} after {number.name}, expected {STOPPED}")
    check(took < 2.0 + SLACK, f"{what}: {number.name} was heard after {took:.1f} s")


class Terminal:
    """A program on a terminal of its own."""

    def __init__(self, *words):
        self.ours, theirs = pty.openpty()
        self.process = subprocess.Popen([PROGRAM, *map(str, words)], stdout=theirs, stderr=theirs, stdin=theirs,
                                        cwd=FOLDER)
        os.close(theirs)
        self.text = ""

    def said(self):
        while select.select([self.ours], [], [], 0)[0]:
            try:
                more = os.read(self.ours, 1 << 16).decode(errors="replace")
            except OSError:
                break
            if not more:
                break
            self.text += more
        return self.text


def meshers_of(process):
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = entry.read_text().rsplit(")", 1)[1].split()
            name = (entry.parent / "comm").read_text().strip()
        except OSError:
            continue
        if name.startswith("dygita-mesher") and int(fields[1]) == process.pid:
            found.append(int(entry.parent.name))
    return found


def is_running(pid):
    return pathlib.Path(f"/proc/{pid}").exists()


def a_log_says_what_is_meshed():
    path = deck("meshed.lua", MESHED)
    log = FOLDER / "meshed.log"
    with log.open("w", encoding="utf-8") as stream:
        process = subprocess.Popen([PROGRAM, "check", str(path)], stdout=stream, stderr=stream, cwd=FOLDER)
        took = wait_for(log.read_text, "meshing slow.geo: ", process)
        check(8.0 < took < 20.0, f"a log's first line about a mesh came after {took:.1f} s, expected 10")
        meshers = meshers_of(process)
        check(len(meshers) == 1, f"{len(meshers)} meshers at work, expected one")
        end_of(process, signal.SIGINT, "a mesh")
    check(NOTHING_SOLVED in log.read_text(), f"what was kept is not said: {log.read_text()[-300:]}")
    check(log.read_text().count("meshing slow.geo") < 4, "a log has a line about a mesh more than every ten seconds")
    check(not any(map(is_running, meshers)), "a mesher outlives the program")


def a_terminal_says_what_is_meshed():
    terminal = Terminal("run", deck("meshed.lua", MESHED), "--out", FOLDER / "out")
    took = wait_for(terminal.said, "\r\x1b[Kmeshing slow.geo: ", terminal.process)
    check(took < 10.0, f"a terminal's first line about a mesh came after {took:.1f} s")
    end_of(terminal.process, signal.SIGTERM, "a mesh on a terminal")
    check("stopping; a second signal ends at once" in terminal.said(), "a signal is not acknowledged")
    check(NOTHING_SOLVED in terminal.said(), "what was kept is not said on a terminal")


def a_check_says_which_interface_and_ends():
    for number in (signal.SIGINT, signal.SIGTERM):
        terminal = Terminal("check", deck("joined.lua", JOINED))
        wait_for(terminal.said, "points of interfaces: 0/1", terminal.process)
        end_of(terminal.process, number, "the points of an interface")
        check(NOTHING_SOLVED in terminal.said(), "what was kept is not said of a check")


def a_factor_ends():
    terminal = Terminal("run", deck("large.lua", LARGE), "--out", FOLDER / "out", "--threads", "1")
    wait_for(terminal.said, "factors of step 'push': 0/1", terminal.process)
    time.sleep(1.0)
    end_of(terminal.process, signal.SIGTERM, "a factor")
    check("stopped; the results so far are written" in terminal.said(), f"what was kept is not said of a factor: {terminal.said()[-300:]}")


def an_ensemble_says_what_is_lost():
    for number, made in ((signal.SIGINT, False), (signal.SIGTERM, True)):
        terminal = Terminal("run", deck("units.lua", UNITS), "--out", FOLDER / "out", "--threads", "1")
        wait_for(terminal.said, "energy balance closes" if made else "case 'ensemble_", terminal.process)
        end_of(terminal.process, number, "an ensemble")
        words = "one member had come to its end and is lost" if made else "no member had come to its end"
        check("stopped in an ensemble: " + words in terminal.said(), f"what is lost is not said of an ensemble: {terminal.said()[-300:]}")
        check(NOTHING_SOLVED not in terminal.said(), "an ensemble that was stopped says that nothing was solved")


(FOLDER / "slow.geo").write_text(SLOW_SOLID)
a_log_says_what_is_meshed()
a_terminal_says_what_is_meshed()
a_check_says_which_interface_and_ends()
a_factor_ends()
an_ensemble_says_what_is_lost()
for failure in failures:
    print(failure)
sys.exit(1 if failures else 0)
