"""Vectors, turns, and where the faces of boxes meet. Lengths in metres."""

import math

FACES = ("xmin", "xmax", "ymin", "ymax", "zmin", "zmax")
IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def axis_of(face):
    return "xyz".index(face[0])


def is_upper(face):
    return face.endswith("max")


def opposite(face):
    return face[0] + ("min" if is_upper(face) else "max")


def normal_of(face):
    normal = [0.0, 0.0, 0.0]
    normal[axis_of(face)] = 1.0 if is_upper(face) else -1.0
    return normal


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(a, b):
    return [x + y for x, y in zip(a, b)]


def times(s, a):
    return [s * x for x in a]


def norm(a):
    return math.sqrt(dot(a, a))


def apply(matrix, v):
    return [dot(row, v) for row in matrix]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def transposed(a):
    return [list(column) for column in zip(*a)]


def turn(axis, angle):
    """The matrix of a turn about an axis (Rodrigues)."""
    x, y, z = times(1 / norm(axis), axis)
    c, s = math.cos(angle), math.sin(angle)
    if abs(math.remainder(angle, math.pi / 2)) < 1e-12:    # so that quarter turns have no round-off of their own
        c, s = float(round(c)), float(round(s))
    t = 1 - c
    return [[t * x * x + c, t * x * y - s * z, t * x * z + s * y],
            [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
            [t * x * z - s * y, t * y * z + s * x, t * z * z + c]]


def axis_and_angle(matrix):
    """Of a turn; the axis of the largest column of the symmetric part where the angle is near pi."""
    trace = matrix[0][0] + matrix[1][1] + matrix[2][2]
    angle = math.acos(max(-1.0, min(1.0, (trace - 1) / 2)))
    if angle < 1e-12:
        return [0.0, 0.0, 1.0], 0.0
    axis = [matrix[2][1] - matrix[1][2], matrix[0][2] - matrix[2][0], matrix[1][0] - matrix[0][1]]
    if norm(axis) < 1e-6:
        columns = [[(matrix[i][j] + (i == j)) / 2 for i in range(3)] for j in range(3)]
        axis = max(columns, key=norm)
    else:
        angle = math.atan2(norm(axis), trace - 1)
    return times(1 / norm(axis), axis), angle


def quarter_turn(random):
    """One of the 23 turns that take the axes to axes."""
    while True:
        matrix = IDENTITY
        for _ in range(random.randint(1, 3)):
            matrix = product(turn(random.choice(([1, 0, 0], [0, 1, 0], [0, 0, 1])), random.choice((1, 2, 3)) * math.pi / 2), matrix)
        if matrix != IDENTITY:
            return matrix


def oblique_turn(random):
    axis = [random.gauss(0, 1) for _ in range(3)]
    return turn(axis, random.uniform(0.2, 3.0))


def ends(part, axis):
    return part["origin"][axis], part["origin"][axis] + part["size"][axis]


def place_of_face(part, face):
    return ends(part, axis_of(face))[1 if is_upper(face) else 0]


def centre_of_face(part, face):
    return [place_of_face(part, face) if i == axis_of(face) else sum(ends(part, i)) / 2 for i in range(3)]


def area_of_face(part, face):
    return math.prod(size for i, size in enumerate(part["size"]) if i != axis_of(face))


def overlap(a, b, axis):
    """Of two boxes along an axis: how long they lie beside each other, negative where they are apart."""
    (a0, a1), (b0, b1) = ends(a, axis), ends(b, axis)
    return min(a1, b1) - max(a0, b0)


def in_common(parts, joint):
    """The rectangle in which the faces of a joint meet: lowest and highest corner."""
    (a, face), (b, _) = joint["a"], joint["b"]
    a, b = parts[a], parts[b]
    axis = axis_of(face)
    low = [max(ends(a, i)[0], ends(b, i)[0]) for i in range(3)]
    high = [min(ends(a, i)[1], ends(b, i)[1]) for i in range(3)]
    low[axis] = high[axis] = place_of_face(a, face)
    return low, high


def grid_lines(part, axis):
    """Where the corners of the cells of a box stand along an axis."""
    low, high = ends(part, axis)
    return [low + (high - low) * k / part["cells"][axis] for k in range(part["cells"][axis] + 1)]


LINEAR = ("hex8", "prism6", "tet4")
QUADRATIC = ("hex20", "hex27", "prism15", "prism18", "tet10")
HEXAHEDRA = ("hex8", "hex20", "hex27")


def near(a, b):
    return abs(a - b) < 1e-9


def lies_within(inner, outer, face):
    """Does the face of one box lie within the (opposite) face of the other?"""
    return all(ends(outer, i)[0] - 1e-9 <= ends(inner, i)[0] and ends(inner, i)[1] <= ends(outer, i)[1] + 1e-9
               for i in range(3) if i != axis_of(face))


def nodes_coincide(parts, joint):
    """Have both faces the same nodes where they meet? Of order two they are taken for that only where one face lies within the other, and have cells of one type."""
    (a, face), (b, _) = joint["a"], joint["b"]
    a, b = parts[a], parts[b]
    both_linear = a["cell"] in LINEAR and b["cell"] in LINEAR
    if not both_linear and (a["cell"] != b["cell"] or not (lies_within(a, b, face) or lies_within(b, a, face))):
        return False
    low, high = in_common(parts, joint)
    for axis in range(3):
        if axis == axis_of(face):
            continue
        lines = [[x for x in grid_lines(part, axis) if low[axis] - 1e-9 < x < high[axis] + 1e-9] for part in (a, b)]
        if len(lines[0]) != len(lines[1]) or not all(map(near, *lines)) or not (near(lines[0][0], low[axis]) and near(lines[0][-1], high[axis])):
            return False
    return True

