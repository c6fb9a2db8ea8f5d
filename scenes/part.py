"""Triangles and the few shapes that the built-in scenes are made of. Python 3 standard library only."""

import math


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def look_rotation(direction, up=(0, 1, 0)):
    """Quaternion (x, y, z, w) that turns -Z to `direction` and keeps +Y as near to `up` as it can."""
    z = normalized(tuple(-x for x in direction))
    if abs(sum(x * y for x, y in zip(z, normalized(up)))) > 0.999:
        up = (0, 0, 1)
    x = normalized(cross(up, z))
    y = cross(z, x)
    # The largest of the four components first: no division by a small number.
    squares = (1 + x[0] - y[1] - z[2], 1 - x[0] + y[1] - z[2], 1 - x[0] - y[1] + z[2], 1 + x[0] + y[1] + z[2])
    largest = max(range(4), key=lambda i: squares[i])
    if largest == 0:
        q = (squares[0], x[1] + y[0], z[0] + x[2], y[2] - z[1])
    elif largest == 1:
        q = (x[1] + y[0], squares[1], y[2] + z[1], z[0] - x[2])
    elif largest == 2:
        q = (z[0] + x[2], y[2] + z[1], squares[2], x[1] - y[0])
    else:
        q = (y[2] - z[1], z[0] - x[2], x[1] - y[0], squares[3])
    return normalized(q)


def turn_y(radians):
    return (0, math.sin(radians / 2), 0, math.cos(radians / 2))


class Part:
    """Triangles of one material. Counter-clockwise seen from the front.

    Skinned parts have four `joints` (indices) and `weights` (integers, sum 255) a vertex, morphed ones a `targets` list
    of (position offsets, normal offsets).
    """

    def __init__(self):
        self.positions, self.normals, self.texcoords, self.indices = [], [], [], []
        self.joints, self.weights, self.targets = [], [], []

    def quad(self, a, b, c, d, uv=None):
        """Flat quad; `uv` is a (u0, v0, u1, v1) rectangle, (u0, v1) at `a` and (u1, v0) at `c`."""
        n = normalized(cross(sub(c, a), sub(d, b)))
        first = len(self.positions)
        self.positions += [a, b, c, d]
        self.normals += [n] * 4
        if uv:
            u0, v0, u1, v1 = uv
            self.texcoords += [(u0, v1), (u1, v1), (u1, v0), (u0, v0)]
        self.indices += [first, first + 1, first + 2, first, first + 2, first + 3]
        return self

    def triangle(self, a, b, c):
        first = len(self.positions)
        self.positions += [a, b, c]
        self.normals += [normalized(cross(sub(b, a), sub(c, a)))] * 3
        self.indices += [first, first + 1, first + 2]
        return self

    def box(self, low, high, inward=False):
        """Axis-aligned box of 12 triangles that faces outward, or inward for a room."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        faces = [
            [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
            [(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)],
            [(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)],
            [(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)],
            [(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)],
            [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)],
        ]
        for face in faces:
            self.quad(*(face[::-1] if inward else face))
        return self
