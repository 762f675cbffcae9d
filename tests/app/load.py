"""Runs that are long, wide, large or many: memory, open files and time over the run, and what is there to read meanwhile.

load.py PROGRAM [--only steps,frames,substructures,sheet,faces,unknowns,problems] [--small]

Each load is compared with a smaller one of its kind: what grows faster than it may is a failure. --small takes seconds
(each change), without it minutes (before a release).
"""

import argparse
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
import time

FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_load_"))
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)


STEPS = """
local p = param{ n = 1000, frames = 50 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
end
local low, high = block("low", 0), block("high", 10*mm)
local seam = interface.contact{ name = "seam", between = { low:face "zmax", high:face "zmin" }, friction = 0.2 }
local top = output.history{ name = "top", on = high:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
local press = step.static{ name = "press", increments = 2, loads = { load.pressure{ on = high:face "zmax", history = 5*MPa } } }
problem{ name = "load", substructures = { low, high }, interfaces = { seam }, supports = { support.fixed{ name = "floor", on = low:face "zmin" } },
  steps = { press, step.dynamic{ name = "push", after = press, duration = p.n*us, dt = 1*us, loads = {
    load.pressure{ on = high:face "zmax", history = function(t) return 5e6 + 1e6 * math.sin(2e4 * t) end } } } },
  outputs = { output.energy{}, output.vtk{ frames = math.tointeger(p.frames) }, top, output.joint{ name = "joint", on = seam },
    output.srs{ name = "srs", of = top, from = 100, to = 10000 } } }:run{}
"""

# A wall of bricks, each on those below and beside the next, pushed from above, then struck: n columns, n rows.
WALL = """
local p = param{ columns = 5, rows = 4, cells = 2, increments = 2 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local bricks, top, bottom = {}, {}, {}
for r = 1, p.rows do
  for c = 1, p.columns do
    local b = substructure{ name = ("brick %d %d"):format(r, c), material = steel,
      mesh = mesh.box{ size = { 20*mm, 10*mm, 10*mm }, cells = { 2 * p.cells, p.cells, p.cells } }, place = { (20 * c + (r % 2) * 10)*mm, 0, (10 * r)*mm } }
    bricks[#bricks + 1] = b
    if r == 1 then bottom[#bottom + 1] = b:face "zmin" end
    if r == p.rows then top[#top + 1] = b:face "zmax" end
  end
end
local joints = interface.contact{ between = "all touching", friction = 0.3 }
local press = step.static{ name = "press", loads = { load.pressure{ on = top, history = 2*MPa } } }
problem{ name = "load", substructures = bricks, interfaces = { joints }, supports = { support.fixed{ name = "floor", on = bottom } },
  steps = { press, step.dynamic{ name = "strike", after = press, duration = p.increments*us, dt = 1*us, loads = { load.pressure{ on = top, history = 3*MPa } } } },
  solver = solver.latin{ max_iterations = 10 },
  outputs = { output.energy{}, output.vtk{ frames = 3 } } }:run{}
"""

# Blocks on top of each other, tied: n of them with cells^3 cells.
TOWER = """
local p = param{ n = 2, cells = 8, increments = 2 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local blocks, ties = {}, {}
for i = 1, p.n do
  blocks[i] = substructure{ name = "block " .. i, material = steel, place = { 0, 0, (10 * i)*mm },
    mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { p.cells, p.cells, p.cells } } }
  if i > 1 then ties[i - 1] = interface.bonded{ name = "tie " .. i, between = { blocks[i - 1]:face "zmax", blocks[i]:face "zmin" } } end
end
problem{ name = "load", substructures = blocks, interfaces = ties, supports = { support.fixed{ name = "floor", on = blocks[1]:face "zmin" } },
  steps = { step.dynamic{ name = "strike", duration = p.increments*us, dt = 1*us, loads = { load.pressure{ on = blocks[#blocks]:face "zmax", history = 3*MPa } } } },
  outputs = { output.energy{}, output.vtk{ frames = 1 } } }:run{}
"""

PROBLEMS = """
local p = param{ n = 10 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
for i = 1, p.n do
  local b = substructure{ name = "b", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 6, 6, 6 } } }
  local t = substructure{ name = "t", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 6, 6, 6 } }, place = { 0, 0, 10*mm } }
  local seam = interface.contact{ name = "seam", between = { b:face "zmax", t:face "zmin" }, friction = 0.2 }
  problem{ name = "load " .. i, substructures = { b, t }, interfaces = { seam }, supports = { support.fixed{ name = "floor", on = b:face "zmin" } },
    steps = { step.dynamic{ name = "s", duration = 20*us, dt = 1*us, loads = { load.pressure{ on = t:face "zmax", history = (1 + i)*MPa } } } },
    outputs = { output.energy{}, output.joint{ name = "joint", on = seam }, output.vtk{ frames = 4 } } }:run{}
end
"""

# Blocks in a square of side x side, bonded to their neighbours one by one.
SHEET = """
local p = param{ side = 10 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local blocks, seams, held = {}, {}, {}
local function bond(a, b) seams[#seams + 1] = interface.bonded{ name = "seam " .. #seams, between = { a, b } } end
for i = 1, p.side do
  blocks[i] = {}
  for j = 1, p.side do
    blocks[i][j] = substructure{ name = ("block %d %d"):format(i, j), material = steel, mesh = cube, place = { (10 * i)*mm, (10 * j)*mm, 0 } }
    if i > 1 then bond(blocks[i - 1][j]:face "xmax", blocks[i][j]:face "xmin") end
    if j > 1 then bond(blocks[i][j - 1]:face "ymax", blocks[i][j]:face "ymin") end
  end
  held[i] = blocks[i][1]:face "ymin"
end
local all = {}
for _, row in ipairs(blocks) do for _, block in ipairs(row) do all[#all + 1] = block end end
problem{ name = "load", substructures = all, interfaces = seams, supports = { support.fixed{ name = "edge", on = held } },
  steps = { step.static{ name = "press", loads = { load.pressure{ on = all[#all]:face "zmax", history = 3*MPa } } } } }:run{}
"""

# A strip of n cells, each with a named face on its top, and a pressure on each of them.
FACES = """
local p = param{ n = 100 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local strip = substructure{ name = "strip", material = steel, mesh = mesh.gmsh{ file = "strip" .. p.n .. ".msh" }:volume "body" }
local loads = {}
for i = 1, p.n do loads[i] = load.pressure{ on = strip:face("top" .. i), history = 1*kPa } end
problem{ name = "load", substructures = { strip }, supports = { support.fixed{ name = "floor", on = strip:face "bottom" } },
  steps = { step.static{ name = "press", loads = loads } } }:run{}
"""


def status(process, key):
    try:
        with open(f"/proc/{process}/status") as file:
            return int(re.search(rf"^{key}:\s+(\d+)", file.read(), re.M).group(1)) / 1024  # MB
    except (OSError, AttributeError):
        return 0.0


def processor_time():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def readable(run):
    """How many frames the lists of a run in progress name; every file that they name is there and whole."""
    n = 0
    for pvd in run.rglob("*.pvd"):
        text = pvd.read_text()
        check(text.endswith("</VTKFile>\n"), f"{pvd}: half a list while the run goes on")
        for file in re.findall(r'file="([^"]*)"', text)[-20:]:  # the latest
            vtu = pvd.parent / file
            check(vtu.exists() and vtu.read_bytes().endswith(b"</VTKFile>\n"), f"{vtu}: named while the run goes on, and not whole")
            n += 1
    return n


class Watched:
    """A run with what the system says of it meanwhile."""

    def __init__(self, program, deck, **settings):
        out = FOLDER / "out"
        shutil.rmtree(out, ignore_errors=True)
        path = FOLDER / "deck.lua"
        path.write_text(deck)
        words = [w for name, value in settings.items() for w in ("--set", f"{name}={value}")]
        before = processor_time()
        process = subprocess.Popen([program, "run", str(path), "--quiet", "--threads", "1", "--out", str(out), *words], stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        self.memory, self.handles, self.listed = [], [], 0
        watcher = threading.Thread(target=self.watch, args=(process, out))
        watcher.start()
        self.output = process.communicate()[0]
        self.seconds = processor_time() - before  # of a busy machine the clock says little
        watcher.join()
        self.exit_code = process.returncode
        check(self.exit_code in (0, 1), f"{settings}: exit {self.exit_code}\n{self.output[-3000:]}")
        files = [p for p in out.rglob("*") if p.is_file()]
        self.n_files, self.bytes = len(files), sum(p.stat().st_size for p in files)
        left = [p for p in files if p.suffix == ".tmp" or p.name == "checkpoint.dygita"]
        check(not left, f"{settings}: left {left}")
        self.largest = max(self.memory, default=0.0)
        print(f"  {settings}: {self.seconds:.1f} s, {self.largest:.0f} MB, {max(self.handles, default=0)} files open at most, "
              f"{self.n_files} files of {self.bytes / 1e6:.1f} MB; {self.listed} frames read meanwhile")
        shutil.rmtree(out, ignore_errors=True)

    def watch(self, process, out):
        while process.poll() is None:
            self.memory.append(status(process.pid, "VmHWM"))
            try:
                self.handles.append(len(os.listdir(f"/proc/{process.pid}/fd")))
            except OSError:
                pass
            self.listed = max(self.listed, readable(out))
            time.sleep(0.1)



def at_most(what, value, limit):
    print(f"  {what}: {value:.3g}, at most {limit:g}")
    check(value <= limit, f"{what}: {value:.3g}, more than {limit:g}")


def steps(program, small):
    n = 20000 if small else 100000
    few, many = Watched(program, STEPS, n=n // 10), Watched(program, STEPS, n=n)
    at_most("bytes of memory an increment", (many.largest - few.largest) * 1024 * 1024 / (0.9 * n), 2500)
    at_most("processor time of ten times as many increments, over that of one", many.seconds / few.seconds, 20)
    at_most("files open", max(many.handles), 40)


def frames(program, small):
    n = 1500 if small else 20000
    few, many = Watched(program, STEPS, n=n // 5, frames=n // 5), Watched(program, STEPS, n=n, frames=n)
    at_most("processor time of five times as many frames, over that of one", many.seconds / few.seconds, 10)
    check(many.listed > 0, "no frame could be read while the run went on")


def substructures(program, small):
    columns, rows = (8, 6) if small else (25, 20)
    few, many = Watched(program, WALL, columns=columns // 2, rows=rows // 2), Watched(program, WALL, columns=columns, rows=rows)
    at_most("processor time of four times as many parts, over that of one", many.seconds / few.seconds, 8)
    at_most("memory of four times as many parts, over that of one", many.largest / few.largest, 6)
    at_most("files open", max(many.handles), 40)


def unknowns(program, small):
    n, cells = (4, 8) if small else (68, 16)  # 17^3 nodes of three unknowns each: 1e6
    few, many = Watched(program, TOWER, n=n // 2, cells=cells), Watched(program, TOWER, n=n, cells=cells)
    at_most("kB of memory an unknown", many.largest * 1024 / (3 * n * (cells + 1) ** 3), 20 if small else 5)
    at_most("processor time of twice as many unknowns, over that of one", many.seconds / few.seconds, 4)


def sheet(program, small):
    side = 20 if small else 54
    few, many = Watched(program, SHEET, side=side // 2), Watched(program, SHEET, side=side)
    at_most("processor time of four times as many parts, over that of one", many.seconds / few.seconds, 8)
    at_most("memory of four times as many parts, over that of one", many.largest / few.largest, 6)


def strip(n):
    """A mesh of n cubes in a row whose upper faces have names of their own."""

    def node(i, j, k):
        return 1 + 4 * i + 2 * j + k

    def square(name, *nodes):
        return [2, 3, name, *nodes]

    elements = [square(i + 1, node(i, 0, 1), node(i + 1, 0, 1), node(i + 1, 1, 1), node(i, 1, 1)) for i in range(n)]
    elements += [square(n + 1, node(i, 0, 0), node(i, 1, 0), node(i + 1, 1, 0), node(i + 1, 0, 0)) for i in range(n)]
    elements += [[3, 5, n + 2] + [node(i + di, j, k) for k in (0, 1) for di, j in ((0, 0), (1, 0), (1, 1), (0, 1))] for i in range(n)]
    names = [f'2 {i + 1} "top{i + 1}"' for i in range(n)] + [f'2 {n + 1} "bottom"', f'3 {n + 2} "body"']
    nodes = [f"{node(i, j, k)} {i * 0.01} {j * 0.01} {k * 0.01}" for i in range(n + 1) for j in (0, 1) for k in (0, 1)]
    cells = [f"{number + 1} {kind} 2 {name} {name} {' '.join(map(str, of))}" for number, (_, kind, name, *of) in enumerate(elements)]
    sections = {"MeshFormat": ["2.2 0 8"], "PhysicalNames": [str(len(names)), *names], "Nodes": [str(len(nodes)), *nodes],
                "Elements": [str(len(cells)), *cells]}
    text = "".join(f"${title}\n" + "\n".join(lines) + f"\n$End{title}\n" for title, lines in sections.items())
    (FOLDER / f"strip{n}.msh").write_text(text)


def faces(program, small):
    n = 1200 if small else 5000
    for size in (n // 4, n):
        strip(size)
    few, many = Watched(program, FACES, n=n // 4), Watched(program, FACES, n=n)
    at_most("processor time of four times as many named faces and loads, over that of one", many.seconds / few.seconds, 8)
    at_most("memory of four times as many named faces, over that of one", many.largest / few.largest, 6)


def problems(program, small):
    n = 20 if small else 100
    few, many = Watched(program, PROBLEMS, n=n // 5), Watched(program, PROBLEMS, n=n)
    at_most("MB of memory that five times as many problems take more", many.largest - few.largest, 0.4 * n)
    at_most("processor time of five times as many problems, over that of one", many.seconds / few.seconds, 8)
    at_most("files open", max(many.handles), 40)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--only", default="steps,frames,substructures,sheet,faces,unknowns,problems")
    parser.add_argument("--small", action="store_true")
    asked = parser.parse_args()
    for name in asked.only.split(","):
        print(name)
        globals()[name](asked.program, asked.small)
    shutil.rmtree(FOLDER)
    print("\n".join(failures) or "nothing grows faster than it may")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
