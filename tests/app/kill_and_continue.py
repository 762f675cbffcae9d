"""Kills a run at random instants, continues it, and compares every table and frame with those of a run that was let
be, byte by byte.

kill_and_continue.py PROGRAM DECK [--set NAME=VALUE]... [--kills N] [--seed N] [--signals KILL,INT,TERM] [--cut N] [--refine TOLERANCE]
                     [--earlier NAME=VALUE]

--cut N: instead of killing, N times the checkpoint of an interrupted run is cut off at a random byte, or spoiled there,
as a crash of the machine while it is written would.

--earlier NAME=VALUE: all runs start from an earlier one with that setting (dygita run --from).
"""

import argparse
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

CHECKPOINT = "checkpoint.dygita"


def contents(run):
    """Tables and frames; what tells of time and files is another's."""
    files = [p for p in run.rglob("*") if p.suffix in (".csv", ".vtu", ".pvd")]
    return {p.relative_to(run): p.read_bytes() for p in files}


def differences(run, expected):
    found = contents(run)
    names = sorted(set(found) | set(expected), key=str)
    return [str(n) for n in names if found.get(n) != expected.get(n)]


class Kills:
    def __init__(self, asked):
        self.asked = asked
        self.random = random.Random(asked.seed)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="dygita_kills_"))
        self.failures, self.refined, self.earlier = [], None, None
        self.kinds = {"before anything": 0, "without a record": 0, "with a record": 0, "after the end": 0}

    def command(self, out):
        settings = [word for s in self.asked.set for word in ("--set", s)]
        earlier = [] if self.earlier is None else ["--from", str(self.earlier)]
        return [self.asked.program, "run", self.asked.deck, *settings, *earlier, "--quiet", "--threads", "1", "--out", str(out)]

    def going_on(self, run):
        return [self.asked.program, "continue", str(run), "--quiet", "--threads", "1"]

    def let_be(self, command):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1):
            self.failures.append(f"{' '.join(command)}: exit {done.returncode}\n{done.stdout}{done.stderr}")
        return done

    def stopped_after(self, command, seconds, number):
        """True where the signal came before the end."""
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(number)
        return process.wait() not in (0, 1)

    def run_earlier(self):
        folder = self.folder / "earlier"
        self.let_be([*self.command(folder), "--set", self.asked.earlier])
        self.earlier = next(folder.rglob("run.json")).parent

    def reference(self):
        start = time.monotonic()
        self.let_be(self.command(self.folder / "reference"))
        self.seconds = time.monotonic() - start
        self.path = next((self.folder / "reference").rglob("run.json")).parent.relative_to(self.folder / "reference")
        self.expected = contents(self.folder / "reference" / self.path)
        left = list((self.folder / "reference").rglob(CHECKPOINT)) + list((self.folder / "reference").rglob("*.lock"))
        if left:
            self.failures.append(f"a run that came to its end left {left}")
        print(f"reference: {self.seconds:.2f} s, {len(self.expected)} tables and frames")

    def compare(self, run, what):
        different = differences(run, self.expected)
        left = [p for p in run.parent.iterdir() if p != run] + list(run.glob(CHECKPOINT)) + list(run.rglob("*.tmp"))
        if different:
            self.failures.append(f"{what}: {len(different)} files differ: {', '.join(different[:5])}")
        if left:
            self.failures.append(f"{what}: left {left}")

    def refine(self, run):
        """What was killed and has gone on is refined as a run that was let be is: to the same bits."""
        if not self.asked.refine or self.refined is not None and self.random.random() < 0.5:
            return
        copies = []
        for source in (self.folder / "reference" / self.path, run):
            copies.append(self.folder / f"refined_{len(copies)}" / self.path)
            shutil.copytree(source, copies[-1])
            self.let_be([*self.going_on(copies[-1]), "--tolerance", self.asked.refine])
        different = differences(copies[1], contents(copies[0]))
        if different:
            self.failures.append(f"--tolerance after a kill: {len(different)} files differ: {', '.join(different[:5])}")
        for copy in ("refined_0", "refined_1"):
            shutil.rmtree(self.folder / copy)
        self.refined = True

    def kill_once(self, index):
        out = self.folder / f"kill_{index}"
        run = out / self.path
        name = self.random.choice(self.asked.signals.split(","))
        number = getattr(signal, "SIG" + name)
        instants, command = [], self.command(out)
        while True:
            instants.append(self.random.uniform(0.0, 1.05 * self.seconds))
            was_stopped = self.stopped_after(command, instants[-1], number)
            kind = ("before anything" if not (run / CHECKPOINT).exists() and was_stopped else
                    "after the end" if not was_stopped else
                    "with a record" if (run / "run.json").exists() else "without a record")
            self.kinds[kind] += 1
            if kind == "before anything" and not (run / "run.json").exists():
                break
            command = self.going_on(run)
            if not was_stopped or len(instants) == 3 or self.random.random() < 0.6:
                break
        if (run / CHECKPOINT).exists():
            self.let_be(self.going_on(run))
        elif not (run / "run.json").exists():
            self.let_be(self.command(out))
        self.refine(run)
        self.compare(run, f"{name} after {', '.join(f'{t:.3f}' for t in instants)} s")
        shutil.rmtree(out)

    def spoil_once(self, whole, index):
        """A checkpoint of which a crash has left only the beginning, or wrong bytes somewhere."""
        run = self.folder / f"cut_{index}" / self.path
        shutil.copytree(whole, run)
        checkpoint = run / CHECKPOINT
        data = bytearray(checkpoint.read_bytes())
        header = 24 + int.from_bytes(data[16:24], "little") + 8
        at = self.random.randrange(header, len(data))
        if index % 2:
            data[at] ^= 1 << self.random.randrange(8)
        else:
            del data[at:]
        checkpoint.write_bytes(data)
        (run / "run.json").unlink()
        self.let_be(self.going_on(run))
        self.compare(run, f"checkpoint {'spoiled' if index % 2 else 'cut'} at byte {at}")
        shutil.rmtree(self.folder / f"cut_{index}")

    def interrupted(self):
        """A run that was stopped when it had written two thirds of its frames."""
        out = self.folder / "interrupted"
        frames = 2 * sum(1 for name in self.expected if name.suffix == ".vtu") // 3
        process = subprocess.Popen(self.command(out), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and sum(1 for _ in out.rglob("*.vtu")) < frames:
            time.sleep(0.002)
        process.send_signal(signal.SIGINT)
        if process.wait() not in (0, 1) and (out / self.path / CHECKPOINT).exists():
            return out / self.path
        raise RuntimeError("the run was not stopped before its end, or has kept no checkpoint")

    def run(self):
        if self.asked.earlier:
            self.run_earlier()
        self.reference()
        if self.asked.cut:
            whole = self.interrupted()
            for index in range(self.asked.cut):
                self.spoil_once(whole, index)
        for index in range(self.asked.kills):
            self.kill_once(index)
        print("stopped: " + ", ".join(f"{n} {kind}" for kind, n in self.kinds.items()))
        print("\n".join(self.failures) or "all tables and frames are those of the run that was let be")
        shutil.rmtree(self.folder)
        return 1 if self.failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("deck")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--cut", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--signals", default="KILL")
    parser.add_argument("--earlier", default="", metavar="NAME=VALUE")
    parser.add_argument("--refine", default="", help="--tolerance of a continuation after some of the kills")
    return Kills(parser.parse_args()).run()


if __name__ == "__main__":
    sys.exit(main())
