"""Smooth surfaces made of a grid of points around an axis. Python 3 standard library only."""

import math

from part import Part, cross, normalized, sub

STEP = 1e-5  # of the parameters, for derivatives


class Grid:
    """`surface(v, angle)` gives a point: v from 0, the first row, to 1, a single point on top; `angle` in radians, all
    around. Outside is where d surface / d angle x d surface / dv points."""

    def __init__(self, surface, rows, columns):
        self.rows, self.columns = rows, columns
        self.points, self.normals = [], []
        for row in range(rows):
            for column in range(columns):
                v, angle = row / rows, 2 * math.pi * column / columns
                around = sub(surface(v, angle + STEP), surface(v, angle - STEP))
                along = sub(surface(v + STEP, angle), surface(max(v - STEP, 0), angle))
                self.points.append(surface(v, angle))
                self.normals.append(normalized(cross(around, along)))
        self.points.append(surface(1, 0))
        self.normals.append((0, 1, 0))

    def triangles(self, row, column):
        """Of the cell between this row and the next, this column and the next; point indices."""
        a, b = row * self.columns + column, row * self.columns + (column + 1) % self.columns
        if row == self.rows - 1:
            return [(a, b, len(self.points) - 1)]
        c, d = a + self.columns, b + self.columns
        return [(a, b, c), (b, d, c)]

    def part(self, holds=lambda row, column: True):
        """The cells for which `holds` is true; and the grid's points that it uses, in the order of its vertices."""
        part, used, vertex = Part(), [], {}
        for row in range(self.rows):
            for column in range(self.columns):
                if not holds(row, column):
                    continue
                for triangle in self.triangles(row, column):
                    for point in triangle:
                        if point not in vertex:
                            vertex[point] = len(used)
                            used.append(point)
                        part.indices.append(vertex[point])
        part.positions = [self.points[i] for i in used]
        part.normals = [self.normals[i] for i in used]
        return part, used
