#!/usr/bin/python3
"""What ranks cost beyond the machine at hand: replays the exchange pattern of a run (`ranks` in run.json) with costs and a network that are stated.

By itself, `python3 manual/performance/ranks_model.py` does so with the patterns and costs that `./run.sh bench ranks` has last measured (ranks_pattern.json): it writes
ranks_model.csv and prints the table of the larger rings, and the latency from which windows of several time steps pay.

A pattern is pieces with unknowns, seconds of a processor an increment, and the points they share. A larger ring has the same bodies, each refined and cut into
cubes; pieces go to ranks in their order, evenly by cost. A time step of the deck then takes, on the rank that takes longest,

    increments x (pieces + own points + messages to neighbours + sums over all) + laws and energies of own points + what passes to all + outputs

Where the pieces are implicit an increment is an iteration: data and velocities of the unknowns at points between ranks pass to neighbours, sums of each piece to all, and each
rank adds those of all pieces. While a message is on its way the rank computes the pieces and the points that have nothing to do with others.

Outputs of a body are made by the ranks that have its pieces, which tell each other the motion of a ring of cells at the cuts between them.
"""

import csv
import json
import math
from collections import Counter
from dataclasses import asdict, dataclass, replace
from pathlib import Path

HERE = Path(__file__).resolve().parent

MOTION = 48     # bytes of a node's motion; or of data and velocities of a point, three unknowns
MESH = 24 + 32      # bytes of mesh a node, once on a machine: coordinates, a cell's nodes; of a body that is cut once more, of its pieces
CUT, ON_CUT = 29, 48    # bytes once on a machine: of a node of such a body, whose it is (29), and of a node on a cut, where its copies are (48)
POINT = 470         # bytes of a point between bodies, on every rank: 270 of what their faces have in common, 200 of what laws remember, works and residuals


@dataclass(frozen=True)
class Network:
    """Latency (s) of a message and bytes a second; processors that the ranks share (0: one each)."""

    latency: float = 2e-6
    bandwidth: float = 10e9
    cores: int = 0

    def to_one(self, messages, size):
        return messages * self.latency + size / self.bandwidth

    def to_all(self, calls, size, ranks):
        return calls * math.ceil(math.log2(ranks)) * self.latency + size * (ranks - 1) / ranks / self.bandwidth if ranks > 1 else 0.0


@dataclass(frozen=True)
class Costs:
    """Seconds of one processor; `sums` and `questions`: collective calls of an increment, and messages to rank 0 a body and time step."""

    unknown: float = 0.0            # of a piece, an increment (or iteration)
    point: float = 0.0              # of the interface work, an increment (or iteration) and point
    booked: float = 0.0             # laws and energies, a time step of the deck and point
    shown: float = 0.0              # outputs and error estimates, a time step of the deck and unknown
    fields: float = 0.0             # numbers an unknown elsewhere that rank 0 is sent in a time step
    questions: float = 0.0
    looks: float = 0.0              # times a time step of the deck that outputs want motions of the ring of cells at the cuts between ranks
    growth: float = 0.0             # of the cost of an unknown with the size of its piece, a power: 1/3 where the piece is factorised, a compact one
    piece: float = 0.0              # unknowns of the pieces that `unknown` is of
    added: float = 0.0              # s a byte that passed to all: adding up
    sums: float = 1.0
    exchanges: float = 1.0          # with neighbours, an increment (an iteration has two inner ones, of half the numbers)
    increments: float = 1.0         # of a time step of the deck: iterations where the pieces are implicit
    gathered: float = 0.0           # bytes that pass to all: a piece and time step of the deck


@dataclass(frozen=True)
class Pattern:
    unknowns: tuple
    links: tuple                    # (piece, piece, points), the first the lower
    bodies: tuple                   # body of each piece

    @staticmethod
    def of(record):
        pieces = record["ranks"]["pieces"]
        bodies = {name: i for i, name in enumerate(dict.fromkeys(p["substructure"] for p in pieces))}
        return Pattern(tuple(p["unknowns"] for p in pieces), tuple((i, j, n) for i, p in enumerate(pieces) for j, n in p["neighbours"] if j > i),
                       tuple(bodies[p["substructure"]] for p in pieces))

    def total(self):
        return sum(self.unknowns)

    def points(self):
        return sum(n for _, _, n in self.links)

    def refined(self, total, least):
        """The same bodies with `total` unknowns, cut into `least` pieces or more of about the same size."""
        scale = total / self.total()
        largest = total / least
        grids, first, unknowns, links, bodies = [], [0], [], [], []
        for n in self.unknowns:
            cuts = max(1, math.ceil(scale * n / largest))
            a = max(1, round(cuts ** (1 / 3)))
            b = max(1, round(math.sqrt(cuts / a)))
            grids.append((a, b, math.ceil(cuts / (a * b))))
            first.append(first[-1] + math.prod(grids[-1]))
        for i, ((a, b, c), n) in enumerate(zip(grids, self.unknowns)):
            size = scale * n / (a * b * c)
            face = (size / 3) ** (2 / 3)
            unknowns += [size] * (a * b * c)
            bodies += [self.bodies[i]] * (a * b * c)
            for at in range(a * b * c):
                x, y, z = at // (b * c), at // c % b, at % c
                links += [(first[i] + at, first[i] + at + step, face) for has, step in ((x + 1 < a, b * c), (y + 1 < b, c), (z + 1 < c, 1)) if has]
        for i, j, n in self.links:
            here, there = first[i + 1] - first[i], first[j + 1] - first[j]
            pairs = max(round(here ** (2 / 3)), round(there ** (2 / 3)))
            links += [(first[i] + k * here // pairs, first[j] + k * there // pairs, n * scale ** (2 / 3) / pairs) for k in range(pairs)]
        return Pattern(tuple(unknowns), tuple(links), tuple(bodies))


def owners_of(pattern, ranks):
    """Rank of each piece: in their order, by size."""
    share, sum_before, owners = pattern.total() / ranks, 0.0, []
    for n in pattern.unknowns:
        owners.append(min(ranks - 1, int((sum_before + 0.5 * n) / share)))
        sum_before += n
    return owners


RING = 2 * 24       # bytes of the motion of the ring of cells beyond a cut, a point of it: its own node where the other owns that, and the next


def at_cuts(pattern, ranks, owners):
    """Of every rank: bytes of the rings of cells that it is told of in an instant."""
    told = [0.0] * ranks
    for i, j, n in pattern.links:
        if pattern.bodies[i] == pattern.bodies[j] and owners[i] != owners[j]:
            told[owners[i]] += RING * n
            told[owners[j]] += RING * n
    return told


def interior(pattern, ranks, owners):
    """Of every rank: unknowns of pieces, and points, that touch no other rank."""
    border = {k for i, j, _ in pattern.links if owners[i] != owners[j] for k in (i, j)}
    unknowns, points = [0.0] * ranks, [0.0] * ranks
    for i, n in enumerate(pattern.unknowns):
        unknowns[owners[i]] += 0.0 if i in border else n
    for i, j, n in pattern.links:
        if owners[i] == owners[j]:
            points[owners[i]] += n
    return unknowns, points


def shared_out(pattern, ranks, owners):
    """Of every rank: unknowns, points, peers, bytes to neighbours in an increment."""
    unknowns, points, sent = [0.0] * ranks, [0.0] * ranks, [{} for _ in range(ranks)]
    for owner, n in zip(owners, pattern.unknowns):
        unknowns[owner] += n
    for i, j, n in pattern.links:
        a, b = owners[i], owners[j]
        points[a] += n
        if a == b:
            continue
        points[b] += n
        for here, there in ((a, b), (b, a)):
            sent[here][there] = sent[here].get(there, 0.0) + MOTION * n
    return unknowns, points, [len(s) for s in sent], [sum(s.values()) for s in sent]


def step(pattern, ranks, costs, network, owners=None):
    """Seconds of a time step of the deck by what takes them, and bytes that all ranks send. owners: as a run had them, else in order, by size."""
    owners = owners or owners_of(pattern, ranks)
    unknowns, points, peers, sent = shared_out(pattern, ranks, owners)
    n, pieces = pattern.total(), len(pattern.unknowns)
    times, inc = {}, costs.increments
    of_unknown = costs.unknown * ((n / pieces) / costs.piece) ** costs.growth if costs.growth else costs.unknown
    work = [inc * (of_unknown * u + costs.point * p) for u, p in zip(unknowns, points)]
    alone = [costs.booked * p for p in points]
    times["pieces and points"] = max(a + b for a, b in zip(work, alone))
    hidden = [inc * (of_unknown * u + costs.point * p) for u, p in zip(*interior(pattern, ranks, owners))]
    numbers = 0.5 * (1.0 + costs.exchanges)
    to_neighbours = 0 if ranks == 1 else inc * numbers * sum(sent)
    times["neighbours"] = 0.0 if not to_neighbours else max(max(0.0, inc * network.to_one(2 * costs.exchanges * p, numbers * s) - h) for p, s, h in zip(peers, sent, hidden))
    gathered = costs.gathered * pieces
    times["to all"] = network.to_all(inc * costs.sums + 5, gathered, ranks) + (costs.added * gathered if ranks > 1 else 0.0)
    asked = 8 * costs.fields * (n - unknowns[0])
    questions = costs.questions * len(set(pattern.bodies)) * (1 - 1 / ranks)
    rings = [costs.looks * told for told in at_cuts(pattern, ranks, owners)]
    times["outputs"] = max(costs.shown * own + network.to_one(0, ring) for own, ring in zip(unknowns, rings)) + network.to_one(2 * questions, asked)
    total = sum(times.values())
    if network.cores:   # ranks that share processors
        total = max(total, (sum(work) + sum(alone) + costs.shown * n) / min(network.cores, ranks))
    return times | {"all": total, "bytes": to_neighbours + gathered * (ranks - 1) + asked + sum(rings)}


def with_increments(costs, scale):
    """Cells smaller by scale^(1/3) in the same time step of the deck: as many more increments."""
    return replace(costs, increments=costs.increments * scale ** (1 / 3))


def on_machine(pattern):
    """Bytes of meshes, and of where cuts have put their nodes, on every machine."""
    n_pieces = Counter(pattern.bodies)
    nodes = sum(n / 3 * (MESH + (MESH + CUT) * (n_pieces[body] > 1)) for n, body in zip(pattern.unknowns, pattern.bodies))
    return nodes + ON_CUT * sum(n for i, j, n in pattern.links if pattern.bodies[i] == pattern.bodies[j])


LATENCY, BANDWIDTH = 2e-6, 10e9


def predict_rings(measured, quick=False):
    """Rows of larger rings on a network. measured: {how: (pattern, costs)}."""
    rows = []
    counts = [8, 64, 512, 4096] if quick else [8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096]
    cases = [("strong", size, ranks) for size in (1e7, 1e8, 1e9) for ranks in counts] + [("weak", 1e9 / 4096 * ranks, ranks) for ranks in counts]
    network = Network(LATENCY, BANDWIDTH)
    for how, (pattern, costs) in measured.items():
        for scaling, size, ranks in cases:
            refined = pattern.refined(size, 4 * ranks)
            # Explicit increments follow the cells; implicit time steps stay those of the deck.
            own = with_increments(costs, size / pattern.total()) if how == "explicit" else costs
            one = step(refined, 1, own, network)["all"]
            times = step(refined, ranks, own, network)
            bound = max((k for k in times if k not in ("all", "bytes")), key=times.get)
            rows.append({"scaling": scaling, "unknowns": size, "ranks": ranks, "pieces": how, "increments per step": own.increments, "s per step": times["all"],
                         "speed-up": one / times["all"], "efficiency": one / times["all"] / ranks, "most in": bound, "share of it": times[bound] / times["all"],
                         "GB per step": 1e-9 * times["bytes"], "meshes on every machine [GB]": 1e-9 * on_machine(refined),
                         "points on every rank [GB]": 1e-9 * POINT * sum(n for i, j, n in refined.links if refined.bodies[i] != refined.bodies[j])})
    return rows


# Of an iteration, one after the other. By itself: to neighbours; the indicator, to all; two inner ones, to neighbours; the acceleration's first and second sums, to all. In a window
# there are no inner ones, and the first sums go with the indicator.
MESSAGES, IN_WINDOWS = 6, 3


def break_even(iteration, around, of_step, of_window, window):
    """Latency (s, of a message or of one sum over all) from which a window of so many time steps is faster than time steps one by one; infinite where it never is.

    iteration, around: s that an iteration computes, and that a time step does before and after all of its iterations; of_step, of_window: iterations of a time step by itself and
    of a window, each of which goes through all of its time steps with what is before and after, and exchanges once."""
    spared = MESSAGES * of_step - IN_WINDOWS * of_window / window
    more = of_window * (around + iteration) - around - of_step * iteration
    return more / spared if spared > 0.0 else math.inf


def saved(measured, windows):
    """What the model takes from a measurement, as JSON. measured: {how: (pattern, costs)}; windows: rows (ranks.measure_windows)."""
    return json.dumps({"rings": {how: {"pattern": asdict(pattern), "costs": asdict(costs)} for how, (pattern, costs) in measured.items()}, "windows": windows}, indent=1)


def loaded(path):
    stored = json.loads(path.read_text())
    rings = {how: (Pattern(tuple(of["pattern"]["unknowns"]), tuple(tuple(link) for link in of["pattern"]["links"]), tuple(of["pattern"]["bodies"])), Costs(**of["costs"]))
             for how, of in stored["rings"].items()}
    return rings, stored["windows"]


def write_rows(path, rows):
    with open(path, "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(rows[0])
        out.writerows([f"{v:.6g}" if isinstance(v, float) else v for v in row.values()] for row in rows)


def windows_table(rows):
    """Of each scene: iterations, messages a time step and the latency from which the window pays."""
    lines = ["| dt | window | iterations | messages in sequence per time step | pays above a latency of |", "| --- | --- | --- | --- | --- |"]
    for row in rows:
        one = next(r for r in rows if r["cfl"] == row["cfl"] and r["window"] == 1)
        latency = break_even(one["s of an iteration"], one["s around"], one["iterations"], row["iterations"], row["window"]) if row["window"] > 1 else None
        pays = "" if latency is None else "never" if math.isinf(latency) else f"{1e6 * latency:.0f} us"
        lines.append(f"| {row['cfl']:g} h/c | {row['window']} | {row['iterations']:.1f} | {(MESSAGES if row['window'] == 1 else IN_WINDOWS) * row['iterations'] / row['window']:.1f} | {pays} |")
    return "\n".join(lines)


def rings_table(rows):
    found = {(row["unknowns"], row["ranks"], row["pieces"]): row for row in rows if row["scaling"] == "strong"}
    lines = ["| unknowns | ranks | explicit | implicit |", "| --- | --- | --- | --- |"]
    for size in (1e7, 1e8, 1e9):
        for ranks in (8, 64, 512, 4096):
            told = [found[size, ranks, how] for how in ("explicit", "implicit")]
            cells = [f"{float(format(of['speed-up'], '.2g')):g} ({of['most in']})" for of in told]
            lines.append(f"| {size:.0e} | {ranks} | ".replace("e+0", "e") + " | ".join(cells) + " |")
    return "\n".join(lines)


def main():
    rings, windows = loaded(HERE / "ranks_pattern.json")
    rows = predict_rings(rings)
    write_rows(HERE / "ranks_model.csv", rows)
    print("Speed-up over one processor that has all to itself, and what takes most of the time:\n")
    print(rings_table(rows))
    print("\nWindows of several time steps, of decks/bench/blocks.lua on 2 ranks:\n")
    print(windows_table(windows))


if __name__ == "__main__":
    main()
