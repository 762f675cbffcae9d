#!/usr/bin/env python3
"""The Brake-Reuss beam without friction, by finite elements of another kind: what cells with one point of integration and bolts that are
beams, coupled to their bearing faces, do to the first four frequencies. Needs numpy and scipy; nothing of the program.

    for n in 4 6 8; do python3 meshes/make_brake_reuss.py --order 1 --n $n --nz $((n * 3 / 4)) --nx $((4 * n)) --out build/beam_$n.msh; done
    python3 manual/verification/brake_reuss_variants.py build/beam_4.msh build/beam_6.msh build/beam_8.msh
"""
import sys

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import eigsh, splu

YOUNG, POISSON, DENSITY = 200e9, 0.29, 7800.0
SHEAR = YOUNG / (2 * (1 + POISSON))
HOLES, HEIGHT, R_SHANK, R_HOLE, R_WASHER = (-0.03, 0.0, 0.03), 12.7e-3, 3.96875e-3, 4.25e-3, 8.73125e-3
GRIP = 2 * (HEIGHT + 1.5875e-3)
CORNERS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], float)
HOURGLASS = np.array([CORNERS[:, 1] * CORNERS[:, 2], CORNERS[:, 2] * CORNERS[:, 0], CORNERS[:, 0] * CORNERS[:, 1], CORNERS.prod(axis=1)])


def read(file):
    """Places of nodes; cells of each volume; nodes of each face."""
    lines = iter(open(file).read().split("\n"))
    names, cells, faces, places = {}, {}, {}, None
    for line in lines:
        if line == "$PhysicalNames":
            for _ in range(int(next(lines))):
                dimension, number, name = next(lines).split()
                names[int(dimension), int(number)] = name.strip('"')
        elif line == "$Nodes":
            places = np.array([next(lines).split()[1:] for _ in range(int(next(lines)))], float)
        elif line == "$Elements":
            for _ in range(int(next(lines))):
                v = [int(x) for x in next(lines).split()]
                to, name = (cells, names[3, v[3]]) if v[1] == 5 else (faces, names[2, v[3]])
                to.setdefault(name, []).append([x - 1 for x in v[5:]])
    return places, {k: np.array(v) for k, v in cells.items()}, {k: np.unique(v) for k, v in faces.items()}


def elasticity():
    lame = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    d = np.diag([2 * SHEAR] * 3 + [SHEAR] * 3)
    d[:3, :3] += lame
    return d


def strains(gradient):
    """(cells, 6, 3 n) of gradients (cells, n, 3)."""
    n = gradient.shape[1]
    b = np.zeros((len(gradient), 6, 3 * n))
    for row, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))):
        b[:, row, i::3] += gradient[:, :, j]
        if i != j:
            b[:, row, j::3] += gradient[:, :, i]
    return b


def derivatives(at):
    """Of the eight shape functions at a point of the reference cell: (8, 3)."""
    terms = 1 + CORNERS * at
    return np.stack([CORNERS[:, d] * np.delete(terms, d, axis=1).prod(axis=1) for d in range(3)], axis=1) / 8


def stiffness(x, kind):
    """(cells, 24, 24); kind: "reduced", one point with hourglass stiffness 0.005 G [Flanagan and Belytschko 1981], or "internal modes",
    eight points and Wilson's modes [Taylor, Beresford and Wilson 1976]."""
    elastic = elasticity()
    middle = np.einsum("cnd,ne->cde", x, derivatives(np.zeros(3)))
    if kind == "reduced":
        gradient = np.einsum("nd,cde->cne", derivatives(np.zeros(3)), np.linalg.inv(middle))
        volume = 8 * np.linalg.det(middle)
        b = strains(gradient)
        k = np.einsum("c,cri,rs,csj->cij", volume, b, elastic, b, optimize=True)
        gamma = (HOURGLASS[None] - np.einsum("cnd,cmd,am->can", gradient, x, HOURGLASS)) / 8
        scale = 0.005 * SHEAR * volume * np.einsum("cnd,cnd->c", gradient, gradient)
        springs = np.einsum("c,can,cam->cnm", scale, gamma, gamma)
        for d in range(3):
            k[:, d::3, d::3] += springs
        return k
    k_uu, k_ua, k_aa = (np.zeros((len(x), *shape)) for shape in ((24, 24), (24, 9), (9, 9)))
    inverse_middle, det_middle = np.linalg.inv(middle), np.linalg.det(middle)
    for at in CORNERS / np.sqrt(3):
        jacobian = np.einsum("cnd,ne->cde", x, derivatives(at))
        det = np.linalg.det(jacobian)
        b = strains(np.einsum("nd,cde->cne", derivatives(at), np.linalg.inv(jacobian)))
        inner = strains(np.einsum("nd,cde->cne", np.diag(-2 * at), inverse_middle)) * (det_middle / det)[:, None, None]
        for to, p, q in ((k_uu, b, b), (k_ua, b, inner), (k_aa, inner, inner)):
            to += np.einsum("c,cri,rs,csj->cij", det, p, elastic, q, optimize=True)
    return k_uu - k_ua @ np.linalg.solve(k_aa, k_ua.transpose(0, 2, 1))


def assemble(places, cells, kind):
    """Stiffness and lumped mass."""
    x = places[cells]
    k = stiffness(x, kind)
    at = (3 * cells[:, :, None] + np.arange(3)).reshape(len(cells), 24)
    n = places.size
    K = sp.coo_matrix((k.ravel(), (np.repeat(at, 24, axis=1).ravel(), np.tile(at, (1, 24)).ravel())), shape=(n, n)).tocsr()
    volume = sum(np.linalg.det(np.einsum("cnd,ne->cde", x, derivatives(p))) for p in CORNERS / np.sqrt(3))
    mass = np.bincount(at.ravel(), np.repeat(DENSITY * volume / 8, 24), n)
    return K, mass


def beam(length):
    """Stiffness of a round Timoshenko beam along z, 12 x 12, of (u, turn) at its upper and its lower end."""
    area, inertia = np.pi * R_SHANK**2, np.pi * R_SHANK**4 / 4
    k = np.zeros((12, 12))
    sheared = 12 * YOUNG * inertia / (0.89 * SHEAR * area * length**2)
    for i, j, value in ((2, 8, YOUNG * area / length), (5, 11, SHEAR * 2 * inertia / length)):
        k[np.ix_((i, j), (i, j))] = value * np.array([[1, -1], [-1, 1]])
    base = YOUNG * inertia / (length**3 * (1 + sheared))
    l = length
    bend = base * np.array([[12, 6 * l, -12, 6 * l], [6 * l, (4 + sheared) * l * l, -6 * l, (2 - sheared) * l * l],
                            [-12, -6 * l, 12, -6 * l], [6 * l, (2 - sheared) * l * l, -6 * l, (4 + sheared) * l * l]])
    # From the lower end up: displacement along x with the turn about y, along y with the one about -x.
    for shift, turn, sign in ((0, 4, 1), (1, 3, -1)):
        at, s = [6 + shift, 6 + turn, shift, turn], np.array([1, sign, 1, sign])
        k[np.ix_(at, at)] += bend * np.outer(s, s)
    return k


def mean_motion(places, nodes, n):
    """(6, n): translation and turn of nodes in the mean, by least squares."""
    from_middle = places[nodes] - places[nodes].mean(axis=0)
    rigid = np.zeros((len(nodes), 3, 6))
    rigid[:, :, :3] = np.eye(3)
    for d in range(3):
        rigid[:, :, 3 + d] = np.cross(np.eye(3)[d], from_middle)
    rigid = rigid.reshape(-1, 6)
    take = np.linalg.solve(rigid.T @ rigid, rigid.T)
    columns = (3 * nodes[:, None] + np.arange(3)).ravel()
    return sp.csr_matrix((take.ravel(), (np.repeat(np.arange(6), len(columns)), np.tile(columns, 6))), shape=(6, n))


class Model:
    def __init__(self, file, kind, bolts):
        places, cells, faces = read(file)
        self.places, self.n = places, places.size
        every = np.vstack(list(cells.values()))
        middle = places[every].mean(axis=1)
        off = np.min([np.hypot(middle[:, 0] - x, middle[:, 1]) for x in HOLES], axis=0)
        is_bolt = (off < R_SHANK) | (np.abs(middle[:, 2]) > HEIGHT) & (np.abs(middle[:, 0]) < 0.05)
        kept = every if bolts == "solid" else every[~is_bolt]
        self.K, self.mass = assemble(places, kept, kind)
        self.pull = np.zeros(self.n)
        if bolts == "coupled":
            _, weight = assemble(places, every[is_bolt], kind)
            for x in HOLES:
                ends, off = [], np.hypot(places[:, 0] - x, places[:, 1])
                for up in (1, -1):
                    bearing = np.flatnonzero((np.abs(places[:, 2] - up * HEIGHT) < 1e-7) & (off < 1.02 * R_WASHER) & (off > 0.98 * R_HOLE) & (self.mass[::3] > 0))
                    own = (off < 12.5e-3) & (up * places[:, 2] > -1e-9)
                    self.mass[(3 * bearing[:, None] + np.arange(3)).ravel()] += weight[::3][own].sum() / len(bearing)
                    ends.append(mean_motion(places, bearing, self.n))
                ends = sp.vstack(ends)
                self.K = sp.csr_matrix(self.K + ends.T @ sp.csr_matrix(beam(GRIP)) @ ends)
                self.pull += ends.T @ np.array([0.0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0])
        below = {tuple(np.round(places[i, :2] * 1e7).astype(int)): i for name in faces if name.startswith("bot") for i in faces[name] if abs(places[i, 2]) < 1e-9}
        pairs = lambda name: [(i, below[tuple(np.round(places[i, :2] * 1e7).astype(int))]) for i in faces[name]]
        self.lap = pairs("top.lap")
        self.shanks = [p for k in (1, 2, 3) for p in pairs(f"top.mid{k}")] if bolts == "solid" else []
        self.closed = self.tighten()

    def constrained(self, closed):
        """T of u = T q + jump: shanks in one, closed nodes of the lap without friction; nodes without mass are gone."""
        slave = [(3 * i + d, 3 * j + d, -1.0 if d == 2 else 0.0) for i, j in self.shanks for d in range(3)]
        slave += [(3 * i + 2, 3 * j + 2, 0.0) for i, j in closed]
        known = {s for s, _, _ in slave}
        # A node of the shank's rim belongs to one face only.
        free = np.array([i for i in range(self.n) if i not in known and self.mass[i] > 0])
        number = np.full(self.n, -1)
        number[free] = np.arange(len(free))
        rows = np.concatenate([free, [s for s, _, _ in slave]]).astype(int)
        columns = np.concatenate([np.arange(len(free)), [number[m] for _, m, _ in slave]]).astype(int)
        jump = np.zeros(self.n)
        for s, _, j in slave:
            jump[s] = j
        return sp.csr_matrix((np.ones(len(rows)), (rows, columns)), shape=(self.n, len(free))), jump

    def tighten(self):
        """Pairs of the lap that stay closed, by releasing what pulls and closing what overlaps: the same for any force."""
        closed, seen = list(self.lap), 0
        for _ in range(30):
            T, jump = self.constrained(closed)
            K = (T.T @ self.K @ T).tocsc()
            f = T.T @ (self.pull - self.K @ jump)
            # Held against rigid motions by the mass, which no balanced load feels.
            M = sp.diags(T.T @ self.mass)
            u = T @ splu((K + 1e-2 * (2 * np.pi) ** 2 * M).tocsc()).solve(f) + jump
            reaction = self.K @ u - self.pull
            scale = np.abs([reaction[3 * i + 2] for i, _ in closed]).max()
            shut = {p for p in closed if reaction[3 * p[0] + 2] > -1e-9 * scale}
            shut |= {p for p in self.lap if p not in set(closed) and u[3 * p[0] + 2] < u[3 * p[1] + 2]}
            if shut == set(closed):
                return closed
            closed = [p for p in self.lap if p in shut]
        raise SystemExit("the contact did not settle")

    def frequencies(self, n=4):
        T, _ = self.constrained(self.closed)
        K, M = (T.T @ self.K @ T).tocsc(), sp.diags(T.T @ self.mass).tocsc()
        values = eigsh(K, k=6 + n, M=M, sigma=-((2 * np.pi * 30) ** 2), which="LM", return_eigenvectors=False)
        f = np.sqrt(np.abs(np.sort(values))) / (2 * np.pi)
        if f[5] > 1.0 or f[6] < 10.0:
            raise SystemExit(f"not six rigid motions: {f}")
        return f[6:]


if __name__ == "__main__":
    for file in sys.argv[1:]:
        for kind, bolts in (("internal modes", "solid"), ("reduced", "solid"), ("internal modes", "coupled"), ("reduced", "coupled")):
            model = Model(file, kind, bolts)
            print(f"{file}: cells {kind}, bolts {bolts}, {model.n} unknowns, {len(model.closed)} of {len(model.lap)} closed:", " ".join(f"{f:.2f}" for f in model.frequencies()), "Hz", flush=True)
