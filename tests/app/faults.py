"""What nights bring to a run, besides being killed: each fault stops it with a clear message, keeps what was computed
and leaves no file that looks whole and is not.

faults.py PROGRAM FOLDER_OF_THE_DECK
"""

import fcntl
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PROGRAM, DECK = sys.argv[1], pathlib.Path(sys.argv[2]) / "stopped.lua"
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_faults_"))
failures = []


def dygita(*words, expected, says=""):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120, check=False)
    output = done.stdout + done.stderr
    if done.returncode != expected or says not in output:
        failures.append(f"dygita {' '.join(map(str, words))}: exit {done.returncode}, expected {expected} and '{says}'\n{output}")
    return output


def check(condition, what):
    if not condition:
        failures.append(what)


def deck_command(out, *more):
    return ["run", DECK, "--quiet", "--threads", "1", "--out", out, *more]


def frames_of(run):
    return sum(1 for _ in run.rglob("*.vtu"))


def stopped_run(name, number, *more):
    """A run that is sent a signal after some of its frames; its folder."""
    out = FOLDER / name
    process = subprocess.Popen([PROGRAM, *map(str, deck_command(out, *more))], stdout=subprocess.PIPE, text=True,
                               stderr=subprocess.STDOUT)
    while process.poll() is None and frames_of(out) < 60:
        time.sleep(0.002)
    process.send_signal(number)
    output = process.communicate()[0]
    return out / "stopped" / "base", output


def who_holds_the_folder():
    run = FOLDER / "held" / "stopped" / "base"
    run.parent.mkdir(parents=True)
    lock = run.parent / ".base.lock"
    with open(lock, "w") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        held.write(f"{os.getpid()} elsewhere 2026-01-31 23:59:59\n")
        held.flush()
        dygita(*deck_command(FOLDER / "held"), expected=2,
               says=f"is being written by process {os.getpid()} on elsewhere, since 2026-01-31 23:59:59")
        check(not run.exists(), "a run that was refused has made its folder")
    dygita(*deck_command(FOLDER / "held"), expected=0)  # its holder has died
    check(not lock.exists(), "the lock is left")
    with open(lock, "w") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        dygita("continue", run, "--iterations", "1", expected=2, says="is being written by another process")
    lock.unlink()


def an_error_in_the_middle():
    out = FOLDER / "broken"
    output = dygita(*deck_command(out, "--set", "broken=1"), expected=2, says="no record at 20 us")
    run = out / "stopped" / "base"
    check(f"earlier results are in {run}" in output, output)
    record = json.loads((run / "run.json").read_text())
    check(record["verdict"] == "interrupted" and "no record at 20 us" in record["stopped_by"], "the record hides the error")
    rows = (run / "joint.csv").read_text().splitlines()
    check(len(rows) == 24, f"{len(rows)} rows of a table whose run computed 4 + 19 increments")
    check("Stopped by an error" in (run / "report.html").read_text(), "the report hides the error")


def numbers_that_overflow():
    """Named by where they arise; what was computed before is kept."""
    deck = FOLDER / "overflow.lua"
    deck.write_text("""
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z) return substructure{ name = name, material = steel,
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } } end
local low, high = block("low", 0), block("high", 10*mm)
local seam = interface.contact{ name = "seam", between = { low:face "zmax", high:face "zmin" }, friction = 0.2 }
problem{ name = "overflow", substructures = { low, high }, interfaces = { seam }, supports = { support.fixed{ name = "floor", on = low:face "zmin" } },
  steps = { step.dynamic{ name = "push", duration = 20*us, dt = 1*us, loads = {
    load.pressure{ on = high:face "zmax", history = function(t) return t > 4*us and 1e160 or 1e6 end } } } },
  solver = solver.latin{ integration = "implicit" }, outputs = { output.energy{} } }:run{}
""")
    output = dygita("run", deck, "--quiet", "--out", FOLDER / "overflow", expected=3,
                    says="the iteration has diverged at substructure 'low', interface 'seam'")
    check("step 'push', increment 5 (t = 4e-06 s)" in output, output)
    rows = (FOLDER / "overflow" / "overflow" / "base" / "energy.csv").read_text().splitlines()
    check(len(rows) == 6 and not any("nan" in row or "inf" in row for row in rows), f"{len(rows)} rows before an overflow")


def energies_that_overflow():
    """In every solver and both kinds of step, where no iteration meets them first; the last good increment is kept."""
    deck = FOLDER / "energies.lua"
    deck.write_text("""
local p = param{ static = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local b = substructure{ name = "alone", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local function loads(from) return { load.pressure{ on = b:face "zmax", history = function(t) return t > from and 1e170 or 1e6 end } } end
local first = step.static{ name = "first", increments = 2, loads = { load.pressure{ on = b:face "zmax", history = 1*MPa } } }
problem{ name = "energies", substructures = { b }, supports = { support.fixed{ name = "floor", on = b:face "zmin" } },
  steps = p.static == 1 and { first, step.static{ name = "push", after = first, loads = loads(-1) } }
    or { step.dynamic{ name = "push", duration = 20*us, dt = 1*us, loads = loads(4*us) } },
  outputs = { output.energy{}, output.vtk{ frames = 20 } } }:run{}
""")
    for solver in ("latin", "monolithic", "explicit"):
        for static, increment, rows, frames in ((0, 5, 6, 5), (1, 1, 4, 3)):
            out = FOLDER / "energies" / f"{solver} {static}"
            dygita("run", deck, "--quiet", "--set", f"static={static}", "--solver", solver, "--out", out, expected=3,
                   says=f"step 'push', increment {increment} (t = ")
            output = dygita("run", deck, "--quiet", "--set", f"static={static}", "--solver", solver, "--out", out, expected=3,
                            says="the energies of substructure 'alone' are not finite")
            run = out / "energies" / "base"
            check(f"earlier results are in {run}" in output, output)
            table = (run / "energy.csv").read_text().splitlines()
            check(len(table) == rows and not any("nan" in row or "inf" in row for row in table), f"{solver}: {table}")
            check(frames_of(run) == frames, f"{solver}, static {static}: {frames_of(run)} frames")
            check(json.loads((run / "run.json").read_text())["verdict"] == "interrupted", f"{solver}: the record hides it")


def little_memory():
    """The run ends with its tables. The limit: what a short run of the same takes, and a little more."""
    deck = FOLDER / "long.lua"
    deck.write_text("""
local p = param{ n = 1000 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z) return substructure{ name = name, material = steel,
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } } end
local low, high = block("low", 0), block("high", 10*mm)
local seam = interface.contact{ name = "seam", between = { low:face "zmax", high:face "zmin" }, friction = 0.2 }
problem{ name = "long", substructures = { low, high }, interfaces = { seam }, supports = { support.fixed{ name = "floor", on = low:face "zmin" } },
  steps = { step.dynamic{ name = "push", duration = p.n*us, dt = 1*us, loads = { load.pressure{ on = high:face "zmax", history = 5*MPa } } } },
  solver = solver.latin{ integration = "implicit" }, outputs = { output.energy{}, output.vtk{ frames = 1000 }, output.joint{ name = "joint", on = seam } } }:run{}
""")
    for limit, name, field in ((resource.RLIMIT_AS, "addresses", "VmPeak"), (resource.RLIMIT_DATA, "data", "VmData")):
        less_memory(deck, FOLDER / f"long_{name}", limit, field)


def less_memory(deck, out, limit, field):
    words = [PROGRAM, "run", str(deck), "--quiet", "--threads", "1", "--out", str(out)]
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    most = 0
    while process.poll() is None:
        try:
            most = max(most, int(pathlib.Path(f"/proc/{process.pid}/status").read_text().split(field + ":")[1].split()[0]))
        except (OSError, IndexError):
            pass
        time.sleep(0.001)
    if process.returncode != 0 or most > 4e6:  # kB; a build with sanitizers asks for terabytes of addresses
        print(f"little memory: not tried, exit {process.returncode}, {most} kB")
        return
    bytes_allowed = 1024 * most + (40 << 20)  # the heap grows by 32 MB at a time
    try:
        done = subprocess.run([*words, "--set", "n=1000000"], capture_output=True, text=True, check=False, timeout=300,
                              preexec_fn=lambda: resource.setrlimit(limit, (bytes_allowed, bytes_allowed)))
    except subprocess.TimeoutExpired:
        check(False, f"little memory ({field}): hangs")
        return
    output = done.stdout + done.stderr
    check(done.returncode == 3 and "not enough memory" in output, f"little memory ({field}): exit {done.returncode}\n{output[-1000:]}")
    run = out / "long" / "base"
    check(f"earlier results are in {run}" in output, output[-1000:])
    check(len((run / "energy.csv").read_text().splitlines()) > 5000, "the table of a run that met its end by memory")
    check(json.loads((run / "run.json").read_text())["stopped_by"].startswith("not enough memory"), "the record hides it")
    check((run / "checkpoint.dygita").exists() and not list(run.rglob("*.tmp")), "no checkpoint, or half a file")


def a_disk_that_the_checkpoint_fills():
    """A file may grow to 1.5 MB here: the checkpoint meets that first, and the run goes on to its results."""
    out = FOLDER / "full"

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (1500000, 1500000))

    words = ["--set", "us=1000", "--no-frames"]
    whole = FOLDER / "whole"
    dygita(*deck_command(whole, *words), expected=0)
    done = subprocess.run([PROGRAM, *map(str, deck_command(out, *words))], capture_output=True, text=True, preexec_fn=limit, check=False)
    output = done.stdout + done.stderr
    check("checkpoint.dygita' cannot be written: the file would be larger than this process may write" in output and "the run continues" in output, output)
    check("state.dygita': the file would be larger than this process may write" in output and done.returncode == 0, f"exit {done.returncode}\n{output}")
    for name in ("joint.csv", "energy.csv", "srs.csv", "run.json", "report.html"):
        kept = out / "stopped" / "base" / name
        check(kept.exists(), f"a full disk: no {name}")
        if name.endswith(".csv") and kept.exists():
            check(kept.read_bytes() == (whole / "stopped" / "base" / name).read_bytes(), f"a full disk: another {name}")
    check(not list(out.rglob("*.tmp")), "half a file is left")


def a_small_disk():
    """The checkpoint says in advance that it does not fit, and leaves half of the room to the results."""
    script = 'mount -t tmpfs -o size=6000k none "$0" && exec "$@"'
    out = FOLDER / "small"
    out.mkdir()
    words = [PROGRAM, *map(str, deck_command(out, "--set", "us=1000", "--no-frames"))]
    inside = ["unshare", "-r", "-m", "sh", "-c", script, str(out)]
    if not shutil.which("unshare") or subprocess.run([*inside, "true"], capture_output=True, check=False).returncode != 0:
        print("a small disk: not tried, no file system may be mounted here")
        return
    done = subprocess.run([*inside, *words], capture_output=True, text=True, check=False)
    output = done.stdout + done.stderr
    check("checkpoint.dygita' needs about" in output and "are free: checkpointing stops at half the free space" in output, output)
    check("stops growing; the rest is reserved for results" in output and done.returncode == 0, output)


def a_disk_that_is_full_at_once():
    """What is given back to the results is never the checkpoint's header: where there is room later, the run goes on as it says."""
    out = FOLDER / "tiny"
    out.mkdir()
    run = out / "stopped" / "base"
    script = 'mount -t tmpfs -o size=SIZE none "$0"; "$@"; echo "first: $?"; mount -o remount,size=50m "$0"; exec "$PROGRAM" continue "$RUN" --quiet'
    inside = ["unshare", "-r", "-m", "sh", "-c"]
    if not shutil.which("unshare") or subprocess.run([*inside, 'mount -t tmpfs -o size=90k none "$0"', str(out)], capture_output=True, check=False).returncode != 0:
        print("a disk that is full at once: not tried, no file system may be mounted here")
        return
    n_advised = 0
    for size in ("100k", "150k", "250k"):
        words = [PROGRAM, *map(str, deck_command(out, "--set", "us=100"))]
        done = subprocess.run([*inside, script.replace("SIZE", size), str(out), *words], capture_output=True, text=True, check=False,
                              env={**os.environ, "PROGRAM": PROGRAM, "RUN": str(run)})
        output = done.stdout + done.stderr
        check("first: 2" in output and "No space left on device" in output, f"{size}: the disk was not full\n{output}")
        if "dygita continue" in output:
            n_advised += 1
            check(done.returncode == 0, f"{size}: continue refuses what was advised\n{output}")
    check(n_advised > 0, "a disk that is full at once: no size at which the run could go on later")


def interrupted():
    for number in (signal.SIGINT, signal.SIGTERM):
        run, output = stopped_run(f"interrupted_{number}", number, "--set", "us=2000")
        check(f"dygita continue {run}" in output, f"{number}: the command that goes on is not said\n{output}")
        for name in ("run.json", "joint.csv", "checkpoint.dygita", "report.html"):
            check((run / name).exists(), f"{number}: no {name}")


def stopped_before_anything_was_sampled():
    """What the run has not looked at it does not call free of errors."""
    out = FOLDER / "soon"
    process = subprocess.Popen([PROGRAM, *map(str, deck_command(out, "--set", "us=100000"))], stdout=subprocess.PIPE, text=True,
                               stderr=subprocess.STDOUT)
    while process.poll() is None and frames_of(out) < 28:  # of the static step
        time.sleep(0.001)
    time.sleep(0.3)
    process.send_signal(signal.SIGTERM)
    output = process.communicate()[0]
    increments = [int(line.split(": ")[1].split()[0]) for line in output.splitlines() if "dynamic 'strike': " in line]
    check(increments and 0 < increments[0] < 20000, f"not stopped in the first fifth of the step: {increments}\n{output}")
    check("mesh 0 " not in output, output)
    check((out / "stopped" / "base" / "srs.csv").exists() and not (out / "stopped" / "base" / "srs_band.csv").exists(), "bands of nothing")


def a_spoiled_checkpoint():
    run, _ = stopped_run("spoiled", signal.SIGKILL, "--set", "us=2000")
    checkpoint = run / "checkpoint.dygita"
    whole = checkpoint.read_bytes()
    before = sorted(p for p in run.rglob("*"))
    for data, says in ((whole[:100], "its header is truncated or damaged"), (b"", "it is truncated"),
                       (b"solid ascii" * 99, "it is not a checkpoint of dygita"),
                       (whole[:40] + b"?" + whole[41:], "its header is truncated or damaged"),
                       (whole[:8] + b"\x07" + whole[9:], "version 7 of the format")):
        checkpoint.write_bytes(data)
        dygita("continue", run, "--quiet", expected=2, says=says)
    check(before == sorted(p for p in run.rglob("*")), "a checkpoint that was refused has cost other files")
    checkpoint.write_bytes(whole)
    dygita("continue", run, "--tolerance", "1e-9", expected=2, says="the run is not complete")


def a_load_that_changed():
    """Each load is compared with itself: a small one beside a large one."""
    folder = FOLDER / "changed"
    folder.mkdir()
    (folder / "small.csv").write_text("time [s],force [N]\n0,0\n1e-6,1\n1e-4,1\n")
    deck = folder / "changed.lua"
    deck.write_text("""
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local b = substructure{ name = "b", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
problem{ name = "changed", substructures = { b }, supports = { support.fixed{ name = "f", on = b:face "zmin" } },
  steps = { step.dynamic{ name = "s", duration = 20*us, dt = 1*us, loads = {
    load.pressure{ on = b:face "zmax", history = history.half_sine{ peak = 100*MPa, duration = 10*us } },
    load.force{ on = b:face "xmax", x = history.file{ file = "small.csv" } } } } },
  outputs = { output.energy{} } }:run{}
""")
    dygita("run", deck, "--quiet", "--out", folder / "out", expected=0)
    (folder / "small.csv").write_text("time [s],force [N]\n0,0\n1e-6,10\n1e-4,10\n")
    dygita("continue", folder / "out" / "changed" / "base", "--iterations", "1", "--quiet", expected=2,
           says="the loads of step 's' have changed since the run")


def a_state_without_a_record():
    out = FOLDER / "no_record"
    dygita(*deck_command(out, "--checkpoint-every", "0"), expected=0)
    run = out / "stopped" / "base"
    for name in ("run.json", "joint.csv", "report.html"):
        (run / name).unlink()
    dygita("continue", run, "--quiet", expected=0, says="results in")
    for name in ("run.json", "joint.csv", "report.html"):
        check((run / name).exists(), f"continued without {name}")


def a_folder_that_is_removed():
    out = FOLDER / "removed"
    process = subprocess.Popen([PROGRAM, *map(str, deck_command(out, "--set", "us=2000"))], stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True)
    while process.poll() is None and frames_of(out) < 60:
        time.sleep(0.002)
    out.rename(FOLDER / "elsewhere")
    output = process.communicate()[0]
    check(process.returncode == 2, f"a run whose folder was moved away: exit {process.returncode}\n{output}")
    check("was removed or emptied while the run wrote there" in output, output)
    check(not (out / "stopped" / "base" / "run.json").exists(), "a folder without its first frames has a record")


def pipes_in_the_place_of_files():
    """Whoever reads a pipe that nobody writes waits for ever: it is refused, or left out, as a device is."""
    dygita(*deck_command(FOLDER / "pipes"), expected=0)
    whole = FOLDER / "pipes" / "stopped" / "base"
    stopped, _ = stopped_run("pipes_stopped", signal.SIGKILL, "--set", "us=2000")
    refused = "a pipe, a device or a folder, not a file"
    again = deck_command(FOLDER / "again", "--repeat", whole / "run.json")
    for file, command, expected, says in (
            (whole / "run.json", ("report", whole), 2, refused), (whole / "scenes.json", ("report", whole), 2, refused),
            (whole / "above.csv", ("report", whole), 0, ""),
            (whole / "view.py", ("view", whole, "--paraview", "true"), 2, refused),
            (whole / "run.json", again, 2, refused), (whole / "joint.csv", again, 2, "nothing to compare with"),
            (whole / "run.json", ("continue", whole, "--iterations", "1"), 2, refused),
            (whole / "state.dygita", ("continue", whole, "--iterations", "1"), 2, refused),
            (whole / ".dygita-files", ("continue", whole, "--iterations", "1", "--quiet"), 0, ""),
            (stopped / "checkpoint.dygita", ("continue", stopped, "--quiet"), 2, refused)):
        kept = file.read_bytes()
        file.unlink()
        os.mkfifo(file)
        try:
            dygita(*command, expected=expected, says=says)
        except subprocess.TimeoutExpired:
            failures.append(f"{file.name} is a pipe: dygita {command[0]} waits for it")
        file.unlink()
        file.write_bytes(kept)


def decks_that_take_long():
    folder = FOLDER / "decks"
    folder.mkdir()
    for name, text, expected, says in (
            ("number", "print(string.find(1234567890123456789, ('.-'):rep(30) .. 'x'))", 2, "too many repetitions"),
            ("number_as_pattern", "print(('12'):rep(9):find(12))", 2, "1\t2"),
            ("searches", "local s = ('a'):rep(30000) for i = 1, 1e6 do s:find('a-b') end", 2, "and was stopped"),
            ("sparse", "local t = {} for k = 61, 3, -1 do t[1 << k] = 1 end for i = 1, 5 do t[i] = 1 end table.remove(t, 1)", 2, "sparse.lua:1: deck code has run for 1 s and was stopped"),
            ("long_numbers", "local a = ('1'):rep(50000000) for i = 1, 1e7 do local x = tonumber(a, 10) end", 2, "and was stopped"),
            ("doubled", "local h = history.constant{ value = 1 } for i = 1, 60 do h = h + h end print(h(0))", 2, "1.1529215046068e+18"),
            ("long_name", "material.elastic{ [('a'):rep(20000000)] = 1 }", 2, "known: damping"),
            ("escapes", "print('a\\27[2J\\7\\194\\155b\\tc')", 2, "a\\x1b[2J\\x07\\xc2\\x9bb\tc"),
            ("escapes_in_an_error", "error('a\\27[2Jb')", 2, "a\\x1b[2Jb")):
        (folder / f"{name}.lua").write_text(text)
        start = time.monotonic()
        output = dygita("run", folder / f"{name}.lua", "--time-limit", "1", expected=expected, says=says)
        check(len(output) < 100000, f"{name}: a message of {len(output)} characters")
        check(time.monotonic() - start < 20.0, f"{name}: took {time.monotonic() - start:.1f} s")


def a_time_limit_of_the_clock():
    """A deck that gets little of the processor ends too: it is stopped, and goes on after its limit has passed."""
    deck = FOLDER / "endless.lua"
    deck.write_text("print('begun') while true do end")
    process = subprocess.Popen([PROGRAM, "run", str(deck), "--time-limit", "3"], stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True)
    for line in iter(process.stdout.readline, ""):
        if "begun" in line:
            break
    process.send_signal(signal.SIGSTOP)
    time.sleep(3.0)
    process.send_signal(signal.SIGCONT)
    output = process.stdout.read()
    status, used = os.wait4(process.pid, 0)[1:]
    check(os.waitstatus_to_exitcode(status) == 2 and "has run for 3 s" in output, output)
    check(used.ru_utime + used.ru_stime < 2.0, "the time limit counts the processor's time, not that of the clock")


def a_kill_while_the_mesher_starts():
    """A mesher whose dygita is killed before it has confined itself is never told: it must end by itself."""
    (FOLDER / "endless.geo").write_text('SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1};\nFor i In {1:1e18}\n  a = i;\nEndFor\n')
    deck = FOLDER / "endless_mesh.lua"
    deck.write_text('mesh.gmsh{ file = "endless.geo" }')
    for wait in (0.0, 0.02, 0.05, 0.1, 0.4):
        process = subprocess.Popen([PROGRAM, "run", str(deck)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        listed = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
        meshers, begun = [], time.monotonic()
        while not meshers and time.monotonic() < begun + 20:
            meshers = listed.read_text().split()
        time.sleep(wait)
        process.kill()
        process.wait()
        begun = time.monotonic()
        left = meshers
        while left and time.monotonic() < begun + 20:
            left = [pid for pid in meshers if is_running(pid)]
            time.sleep(0.05)
        check(meshers and not left, f"dygita was killed {wait} s after its mesher had begun: {len(left)} of {len(meshers)} go on")
        for pid in left:
            os.kill(int(pid), signal.SIGKILL)


def is_running(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().split(") ")[1][0] != "Z"
    except OSError:
        return False


for fault in (who_holds_the_folder, an_error_in_the_middle, numbers_that_overflow, energies_that_overflow, little_memory,
              a_disk_that_the_checkpoint_fills, a_small_disk, a_disk_that_is_full_at_once, interrupted, stopped_before_anything_was_sampled, a_spoiled_checkpoint,
              a_load_that_changed, a_state_without_a_record, a_folder_that_is_removed, pipes_in_the_place_of_files, decks_that_take_long, a_time_limit_of_the_clock,
              a_kill_while_the_mesher_starts):
    fault()
shutil.rmtree(FOLDER)
print("\n".join(failures) or "every fault was met")
sys.exit(1 if failures else 0)
