"""What ranks cost beyond the machine at hand: replays the exchange pattern of a run (`ranks` in run.json) with costs and a network that are stated.

A pattern is pieces with unknowns, seconds of a processor an increment, and the points they share. A larger ring has the same bodies, each refined and cut into
cubes; pieces go to ranks in their order, evenly by cost. A time step of the deck then takes, on the rank that takes longest,

    increments x (pieces + own points + messages to neighbours + sums over all) + laws and energies of own points + what passes to all + outputs

Where the pieces are implicit an increment is an iteration: data and velocities of the unknowns at points between ranks pass to neighbours, sums of each piece to all.

Outputs of a body are made by the rank that has most of it, which is brought the fields that other ranks have of it.
"""

import math
from dataclasses import dataclass, replace

MOTION = 48     # bytes of a node's motion; or of data and velocities of a point, three unknowns
MESH = 64                                   # bytes of mesh and mass a node: coordinates, a cell's nodes, a mass


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
    brought: float = 0.0            # numbers an unknown that the rank which makes a body's outputs is brought of pieces elsewhere in a time step
    sums: float = 1.0
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


def watched(pattern, owners, ranks):
    """Of every rank: unknowns of the bodies that it has most of, and those of them that others have."""
    of_body = {}
    for body, owner, n in zip(pattern.bodies, owners, pattern.unknowns):
        on = of_body.setdefault(body, {})
        on[owner] = on.get(owner, 0.0) + n
    all_of, elsewhere = [0.0] * ranks, [0.0] * ranks
    for on in of_body.values():
        most = max(on, key=on.get)
        all_of[most] += sum(on.values())
        elsewhere[most] += sum(on.values()) - on[most]
    return all_of, elsewhere


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


def step(pattern, ranks, costs, network, owners=None, outputs="bodies"):
    """Seconds of a time step of the deck by what takes them, and bytes that all ranks send. owners: as a run had them, else in order, by size; outputs: of "bodies" or of
    "pieces"."""
    owners = owners or owners_of(pattern, ranks)
    unknowns, points, peers, sent = shared_out(pattern, ranks, owners)
    n, pieces = pattern.total(), len(pattern.unknowns)
    times, inc = {}, costs.increments
    work = [inc * (costs.unknown * u + costs.point * p) for u, p in zip(unknowns, points)]
    alone = [costs.booked * p for p in points]
    times["pieces and points"] = max(a + b for a, b in zip(work, alone))
    to_neighbours = 0 if ranks == 1 else inc * sum(sent)
    times["neighbours"] = 0.0 if not to_neighbours else inc * max(network.to_one(2 * p, s) for p, s in zip(peers, sent))
    gathered = costs.gathered * pieces
    times["to all"] = network.to_all(inc * costs.sums + 5, gathered, ranks)
    asked = 8 * costs.fields * (n - unknowns[0])
    questions = costs.questions * len(set(pattern.bodies)) * (1 - 1 / ranks)
    shown, brought = watched(pattern, owners, ranks) if outputs == "bodies" else (unknowns, [0.0] * ranks)
    times["outputs"] = max(costs.shown * own + network.to_one(0, 8 * costs.brought * more) for own, more in zip(shown, brought)) + network.to_one(2 * questions, asked)
    total = sum(times.values())
    if network.cores:   # ranks that share processors
        total = max(total, (sum(work) + sum(alone) + costs.shown * n) / min(network.cores, ranks))
    return times | {"all": total, "bytes": to_neighbours + gathered * (ranks - 1) + asked + 8 * costs.brought * sum(brought)}


def with_increments(costs, scale):
    """Cells smaller by scale^(1/3) in the same time step of the deck: as many more increments."""
    return replace(costs, increments=costs.increments * scale ** (1 / 3))
