"""arena: a round outdoor arena of about ten thousand triangles: podium, terraces, two storeys of arches, columns.

Bays and columns are one mesh each, placed 36 times.
"""

import math

from gltf_writer import Gltf
from part import Part, turn_y

SEGMENTS = 72   # of every ring
BAYS = 36
FLOOR_RADIUS = 16.0
PODIUM = 2.2    # height
STEPS, STEP_DEPTH, STEP_HEIGHT = 7, 0.9, 0.5
WALK = 3.0      # width of the walk behind the top step


def on_ring(radius, y, i):
    angle = 2 * math.pi * (i % SEGMENTS) / SEGMENTS
    return (radius * math.sin(angle), y, radius * math.cos(angle))


def ring(part, inside, outside):
    """A band between two circles given as (radius, y); seen from above, or from the axis where it stands upright."""
    for i in range(SEGMENTS):
        part.quad(on_ring(*inside, i), on_ring(*inside, i + 1), on_ring(*outside, i + 1), on_ring(*outside, i))


def disc(part, radius, y):
    for i in range(SEGMENTS):
        part.triangle((0, y, 0), on_ring(radius, y, i), on_ring(radius, y, i + 1))


def bay(width, height, depth, opening, spring, segments=10):
    """Wall with an arched opening, its middle at x = 0, its front at z = 0 facing -z, its back at z = depth."""
    part = Part()
    r, half = opening / 2, width / 2
    arch = [(-r * math.cos(math.pi * i / segments), spring + r * math.sin(math.pi * i / segments))
            for i in range(segments + 1)]
    for i in range(segments):
        (x0, y0), (x1, y1) = arch[i], arch[i + 1]
        part.quad((x1, y1, 0), (x0, y0, 0), (x0, height, 0), (x1, height, 0))
        part.quad((x0, y0, depth), (x1, y1, depth), (x1, height, depth), (x0, height, depth))
        part.quad((x0, y0, 0), (x1, y1, 0), (x1, y1, depth), (x0, y0, depth))
    for x0, x1 in ((-half, -r), (r, half)):
        part.quad((x1, 0, 0), (x0, 0, 0), (x0, height, 0), (x1, height, 0))
        part.quad((x0, 0, depth), (x1, 0, depth), (x1, height, depth), (x0, height, depth))
    part.quad((-r, 0, 0), (-r, spring, 0), (-r, spring, depth), (-r, 0, depth))
    part.quad((r, 0, depth), (r, spring, depth), (r, spring, 0), (r, 0, 0))
    part.quad((half, height, 0), (-half, height, 0), (-half, height, depth), (half, height, depth))
    return part


def column(radius, height, sides=10):
    """Base, tapered shaft with smooth normals, capital."""
    part = Part()
    part.box((-radius * 1.4, 0, -radius * 1.4), (radius * 1.4, 0.2, radius * 1.4))
    part.box((-radius * 1.3, height - 0.25, -radius * 1.3), (radius * 1.3, height, radius * 1.3))
    first = len(part.positions)
    for i in range(sides):
        angle = 2 * math.pi * i / sides
        n = (math.sin(angle), 0, math.cos(angle))
        part.positions += [(n[0] * radius, 0.15, n[2] * radius), (n[0] * radius * 0.85, height - 0.2,
                                                                  n[2] * radius * 0.85)]
        part.normals += [n, n]
    for i in range(sides):
        a, b = first + 2 * i, first + 2 * ((i + 1) % sides)
        part.indices += [a, b, b + 1, a, b + 1, a + 1]
    return part


def bowl(g, stone, pale, sand, earth):
    """Everything that goes round as rings."""
    floor = Part()
    disc(floor, FLOOR_RADIUS, 0)
    g.add("floor", floor, sand)
    podium = Part()
    ring(podium, (FLOOR_RADIUS, 0), (FLOOR_RADIUS, PODIUM))
    g.add("podium", podium, pale)
    terraces = Part()
    radius, y = FLOOR_RADIUS, PODIUM
    for step in range(STEPS):
        ring(terraces, (radius, y), (radius + STEP_DEPTH, y))
        radius += STEP_DEPTH
        ring(terraces, (radius, y), (radius, y + STEP_HEIGHT))
        y += STEP_HEIGHT
    ring(terraces, (radius, y), (radius + WALK, y))
    g.add("terraces", terraces, stone)
    outside = Part()
    ring(outside, (radius + WALK, y), (radius + WALK, 0))
    ring(outside, (radius + WALK, 0), (radius + WALK + 4, 0))
    g.add("outside", outside, earth)
    return radius + WALK, y


def arcade(g, radius, y, stone, pale):
    """Two storeys of arches on the outer edge of the walk, a column before each pier, a cornice on top."""
    storey, depth = 3.6, 0.7
    front = radius - depth
    width = 2 * front * math.tan(math.pi / BAYS) + 0.12  # neighbours reach into each other
    bay_mesh = g.mesh("bay", (bay(width, storey, depth, 2.5, 1.9), stone))
    column_mesh = g.mesh("column", (column(0.24, storey), pale))
    for level in range(2):
        for i in range(BAYS):
            angle = 2 * math.pi * i / BAYS
            at = (front * math.sin(angle), y + storey * level, front * math.cos(angle))
            g.node("bay %d.%d" % (level, i), mesh=bay_mesh, translation=[round(x, 6) + 0.0 for x in at],
                   rotation=[round(x, 9) + 0.0 for x in turn_y(angle)])
    stand = (front - 0.35) / math.cos(math.pi / BAYS)
    for i in range(BAYS):
        angle = 2 * math.pi * (i + 0.5) / BAYS
        at = (stand * math.sin(angle), y, stand * math.cos(angle))
        g.node("column %d" % i, mesh=column_mesh, translation=[round(x, 6) + 0.0 for x in at],
               rotation=[round(x, 9) + 0.0 for x in turn_y(angle)])
    cornice = Part()
    top = y + 2 * storey
    inside, outside = front - 0.15, radius + 0.35
    ring(cornice, (outside, top - 0.05), (inside, top - 0.05))
    ring(cornice, (inside, top - 0.05), (inside, top + 0.4))
    ring(cornice, (inside, top + 0.4), (outside, top + 0.4))
    ring(cornice, (outside, top + 0.4), (outside, top - 0.05))
    g.add("cornice", cornice, pale)


def stage(g, stone, red, blue, wood):
    """A stepped platform with an obelisk in the middle, banners on the podium, crates on the sand."""
    platform = Part()
    for level in range(4):
        half = 4.5 - level
        platform.box((-half, 0.45 * level - 0.02, -half), (half, 0.45 * (level + 1), half))
    platform.box((-0.6, 1.75, -0.6), (0.6, 2.6, 0.6))
    tip = (0, 8.2, 0)
    corners = [(-0.4, 2.6, 0.4), (0.4, 2.6, 0.4), (0.4, 2.6, -0.4), (-0.4, 2.6, -0.4)]
    for i in range(4):
        platform.triangle(corners[i], corners[(i + 1) % 4], tip)
    g.add("platform", platform, stone)
    banners = (Part(), Part())
    for i in range(24):
        # In the plane of the podium's facet, 4 cm before it.
        angle = 2 * math.pi * (3 * i + 0.5) / SEGMENTS
        distance = FLOOR_RADIUS * math.cos(math.pi / SEGMENTS) - 0.04
        side = (math.cos(angle), 0, -math.sin(angle))
        centre = (distance * math.sin(angle), 0, distance * math.cos(angle))

        def at(s, y):
            return tuple(c + s * d for c, d in zip(centre, side))[:1] + (y,) + (centre[2] + s * side[2],)

        banners[i % 2].quad(at(0.55, 0.2), at(-0.55, 0.2), at(-0.55, 2.1), at(0.55, 2.1))
    g.add("red banners", banners[0], red)
    g.add("blue banners", banners[1], blue)
    crate = g.mesh("crate", (Part().box((-0.5, 0, -0.5), (0.5, 1, 0.5)), wood))
    for i in range(12):
        angle = 2.4 * i
        r = 7.5 + 0.55 * i
        g.node("crate %d" % i, mesh=crate,
               translation=[round(r * math.sin(angle), 6), 0, round(r * math.cos(angle), 6)],
               rotation=[round(x, 9) for x in turn_y(1.3 * i)], scale=[1 + 0.08 * (i % 5)] * 3)


def arena():
    g = Gltf("arena", 0.5)
    stone = g.material("stone", (0.6, 0.53, 0.43))
    pale = g.material("pale stone", (0.72, 0.68, 0.6))
    sand = g.material("sand", (0.62, 0.48, 0.3))
    earth = g.material("earth", (0.36, 0.33, 0.22))
    red = g.material("red", (0.6, 0.09, 0.07))
    blue = g.material("blue", (0.08, 0.16, 0.5))
    wood = g.material("wood", (0.45, 0.3, 0.16))
    radius, y = bowl(g, stone, pale, sand, earth)
    arcade(g, radius, y, stone, pale)
    stage(g, stone, red, blue, wood)
    g.light("directional", "sun", 12, color=(1, 0.94, 0.84), direction=(0.62, -0.55, -0.56))
    g.camera("main", (3.5, 7.2, 20.5), (-2.5, 3.2, -6), math.radians(62), znear=0.05)
    g.camera("ground", (-10.5, 1.7, 8.0), (4, 4.2, -12), math.radians(68), znear=0.05)
    g.camera("arcade", (21.5, 7.4, 8.5), (17.5, 6.8, -14), math.radians(62), znear=0.05)
    return g
