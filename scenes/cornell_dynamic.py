"""cornell-dynamic: an anemone of 150,000 triangles that moves in the Cornell box, under two moving spots.

A loop of 2 s, 48 frames at 24 a second; its end meets its start. Six arms are one mesh with six skins, the foot
breathes by morph targets, the pearl in the middle turns to and fro with its node. Metres, seconds.
"""

import math

from cornell import CORNELL_CEILING, add_camera, add_walls, metres
from gltf_writer import Gltf
from part import Part, look_rotation, sub
from part_grid import Grid

PERIOD = 2.0
FRAMES = 48
KEYS = 16  # of smooth motions, and one more to close the loop
KEY_TIMES = [PERIOD * k / KEYS for k in range(KEYS + 1)]

MIDDLE = (0.278, 0.0, 0.285)  # of the creature, on the floor

ARMS = 6
LENGTH = 0.36
JOINTS = 8
BONE = LENGTH / JOINTS
ROWS, COLUMNS = 100, 120
RIBS = 4          # along an arm, wound around it
RIB_TURNS = 1.25
TIP = 0.885       # where the tip begins, in lengths
# Bend of each joint away from the axis of the creature, in degrees: out, then up and in again.
BENDS = [19, 13, 13, 8, -4, -20, -32, -38]


def wave(t, shift):
    """Once a loop; `shift` in radians."""
    return math.sin(2 * math.pi * t / PERIOD - shift)


# ---- turns, as quaternions (x, y, z, w) ----

def turn(axis, radians):
    s = math.sin(radians / 2)
    return (axis[0] * s, axis[1] * s, axis[2] * s, math.cos(radians / 2))


def then(second, first):
    ax, ay, az, aw = second
    bx, by, bz, bw = first
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def rotation(q):
    return [round(x, 9) for x in q]


# ---- arms ----

def arm_height(v):
    return math.sin(0.5 * math.pi * min(v, 1))  # in lengths; rows gather at the round tip


def arm_surface(v, angle):
    h = arm_height(v)
    bulb = math.exp(-((h - 0.945) / 0.045) ** 2)
    radius = (0.0265 - 0.0195 * h + 0.0065 * bulb) * math.sqrt(max(1 - h ** 24, 0))
    ribs = 1 + 0.2 * min(1, max(0, (TIP - h) / 0.12)) * math.cos(RIBS * angle)
    turned = angle + 2 * math.pi * RIB_TURNS * h
    return (radius * ribs * math.cos(turned), LENGTH * h, -radius * ribs * math.sin(turned))


def is_tip(row):
    return arm_height(row / ROWS) > TIP


def is_groove(column):
    """The middle 12 of the 30 columns from one rib's ridge to the next."""
    return 9 <= column % (COLUMNS // RIBS) < 21


def joint_weights(y):
    """Four joints and their weights (sum 255) at height y: a cubic B-spline over the middles of the bones."""
    u = y / BONE - 0.5
    first = math.floor(u)
    f = u - first
    spline = [(1 - f) ** 3 / 6, (3 * f ** 3 - 6 * f ** 2 + 4) / 6, (-3 * f ** 3 + 3 * f ** 2 + 3 * f + 1) / 6,
              f ** 3 / 6]
    weight = {}
    for k in range(4):
        joint = min(max(first - 1 + k, 0), JOINTS - 1)
        weight[joint] = weight.get(joint, 0) + spline[k]
    joints = sorted(weight) + [0] * (4 - len(weight))
    bytes_ = [math.floor(255 * weight[j] + 0.5) for j in sorted(weight)] + [0] * (4 - len(weight))
    bytes_[bytes_.index(max(bytes_))] += 255 - sum(bytes_)
    return joints, bytes_


def arm_mesh(g, ribs, grooves, tip):
    """`ribs`, `grooves`, `tip`: materials."""
    grid = Grid(arm_surface, ROWS, COLUMNS)
    parts = []
    for material, holds in ((ribs, lambda r, c: not is_tip(r) and not is_groove(c)),
                            (grooves, lambda r, c: not is_tip(r) and is_groove(c)), (tip, lambda r, c: is_tip(r))):
        part, _ = grid.part(holds)
        for position in part.positions:
            joints, weights = joint_weights(position[1])
            part.joints.append(joints)
            part.weights.append(weights)
        parts.append((part, material))
    return g.mesh("arm", *parts)


def joint_turn(arm, joint, t):
    """Bend away from the creature's axis (about -Z), sway to the side (about X): waves that run to the tip."""
    around = 2 * math.pi * arm / ARMS
    strength = (joint + 2) / (JOINTS + 1)
    bend = BENDS[joint] + 11 * strength * wave(t, 0.7 * joint + 2 * around)
    sway = 13 * strength * wave(t, 0.55 * joint + around + 1)
    return then(turn((1, 0, 0), math.radians(sway)), turn((0, 0, 1), -math.radians(bend)))


def add_arm(g, creature, mesh, index):
    around = 2 * math.pi * (index + 0.2) / ARMS
    parent = g.node("arm %d" % index, creature,
                    translation=[round(0.046 * math.cos(around), 9), 0.06, round(0.046 * math.sin(around), 9)],
                    rotation=rotation(turn((0, 1, 0), -around)), scale=[1, 1, 1] if index % 2 else [0.86, 0.86, 0.86])
    joints = []
    for j in range(JOINTS):
        turns = [joint_turn(index, j, t) for t in KEY_TIMES[:-1]]
        parent = g.node("joint %d.%d" % (index, j), parent, rotation=rotation(turns[0]),
                        translation=[0, BONE if j else 0, 0])
        g.animate(parent, "rotation", KEY_TIMES, turns + turns[:1])
        joints.append(parent)
    skin = g.skin("arm %d" % index, joints, [(0, BONE * j, 0) for j in range(JOINTS)])
    g.node("skinned arm %d" % index, mesh=mesh, skin=skin)


# ---- foot and pearl ----

# Radius and height of the foot's profile, from the floor to the top.
PROFILE = [(0.118, 0), (0.094, 0.01), (0.066, 0.035), (0.062, 0.062), (0.07, 0.082), (0.064, 0.098), (0.036, 0.106),
           (0, 0.107)]
FOOT_ROWS, FOOT_COLUMNS, FOOT_RIBS = 24, 96, 12


def profile(v):
    """Through the points of PROFILE (Catmull, Rom 1974)."""
    last = len(PROFILE) - 1
    i = min(int(v * last), last - 1)
    f = v * last - i
    a, b, c, d = (PROFILE[min(max(k, 0), last)] for k in range(i - 1, i + 3))
    return [0.5 * (2 * q + (r - p) * f + (2 * p - 5 * q + 4 * r - s) * f ** 2 + (3 * q - p - 3 * r + s) * f ** 3)
            for p, q, r, s in zip(a, b, c, d)]


def foot_surface(swell, wring):
    """`swell` widens the waist, `wring` turns the top against the floor."""
    def surface(v, angle):
        radius, y = profile(min(v, 1))
        waist = math.sin(math.pi * min(v, 1)) ** 2
        radius *= 1 + 0.065 * math.cos(FOOT_RIBS * angle) * (1 - v) + 0.16 * swell * waist
        turned = angle + (1.2 + 0.6 * wring) * y / PROFILE[-1][1]
        return (radius * math.cos(turned), y + 0.006 * swell * waist, -radius * math.sin(turned))
    return surface


def add_foot(g, creature, ribs, grooves):
    """`ribs`, `grooves`: materials."""
    rest, swollen, wrung = (Grid(foot_surface(swell, wring), FOOT_ROWS, FOOT_COLUMNS)
                            for swell, wring in ((0, 0), (1, 0), (0, 1)))
    parts = []
    for material, is_groove_part in ((ribs, False), (grooves, True)):
        part, used = rest.part(lambda row, column: (column % 8 in (3, 4)) == is_groove_part)
        for moved in (swollen, wrung):
            part.targets.append(([sub(moved.points[i], rest.points[i]) for i in used],
                                 [sub(moved.normals[i], rest.normals[i]) for i in used]))
        parts.append((part, material))
    weights = [(0.5 + 0.5 * wave(t, 0), 0.8 * wave(t, 1.5)) for t in KEY_TIMES[:-1]]
    node = g.node("foot", creature, mesh=g.mesh("foot", *parts), weights=[round(w, 9) for w in weights[0]])
    g.animate(node, "weights", KEY_TIMES, weights + weights[:1])


def pearl_surface(v, angle):
    polar = math.pi * (0.97 - 0.97 * min(v, 1))  # open at the bottom, inside the foot
    radius = 0.033 * (1 + 0.1 * math.sin(polar) * math.cos(ARMS * angle))
    turned = angle + 0.9 * v
    return (radius * math.sin(polar) * math.cos(turned), radius * math.cos(polar),
            -radius * math.sin(polar) * math.sin(turned))


def add_pearl(g, creature, material):
    """Turns to and fro in steps of a frame, which change half-way between the frames."""
    part, _ = Grid(pearl_surface, 20, 60).part()
    node = g.node("pearl", creature, mesh=g.mesh("pearl", (part, material)), translation=[0, 0.125, 0])
    times = [0] + [PERIOD * (k - 0.5) / FRAMES for k in range(1, FRAMES + 1)] + [PERIOD]
    turns = [turn((0, 1, 0), 0.7 * wave(PERIOD * (k % FRAMES) / FRAMES, 0)) for k in range(FRAMES + 1)]
    g.animate(node, "rotation", times, turns + turns[-1:], "STEP")


# ---- lights ----

def add_key_light(g):
    """Goes round under the ceiling on an ellipse, always looking at the creature."""
    a, b, y = 0.14, 0.06, 0.52

    def place(t):
        return (MIDDLE[0] + a * wave(t, 0), y, 0.08 + b * wave(t, -math.pi / 2))

    def velocity(t):
        w = 2 * math.pi / PERIOD
        return (a * w * wave(t, -math.pi / 2), 0, -b * w * wave(t, 0))

    def aim(t):
        return look_rotation(sub((MIDDLE[0], 0.14, MIDDLE[2]), place(t)))

    node = g.light("spot", "key", 1.3, position=place(0), direction=sub((MIDDLE[0], 0.14, MIDDLE[2]), place(0)),
                   cone_degrees=(20, 40))
    quarters = [PERIOD * k / 4 for k in range(5)]
    keys = [row for t in (0, 0.5, 1, 1.5, 0) for row in (velocity(t), place(t), velocity(t))]
    g.animate(node, "translation", quarters, keys, "CUBICSPLINE")
    g.animate(node, "rotation", KEY_TIMES, [aim(t) for t in KEY_TIMES[:-1]] + [aim(0)])


def add_sweeping_light(g):
    """Hangs from a turning arm and sweeps over red wall, back wall and green wall, and back."""
    arm = g.node("sweep", translation=[0.278, 0.5, 0.3])
    turns = [turn((0, 1, 0), math.pi + 1.35 * wave(t, 0)) for t in KEY_TIMES[:-1]]
    g.json["nodes"][arm]["rotation"] = rotation(turns[0])
    g.animate(arm, "rotation", KEY_TIMES, turns + turns[:1])
    g.light("spot", "sweep", 0.6, position=(0, 0, -0.05), direction=(0, -0.65, -1), cone_degrees=(8, 40), parent=arm)


def cornell_dynamic():
    g = Gltf("cornell-dynamic", 2)
    materials = add_walls(g)
    g.add("ceiling", Part().quad(*metres(CORNELL_CEILING)), materials["white"])
    blue = g.material("blue", (0.08, 0.2, 0.55))
    amber = g.material("amber", (0.85, 0.5, 0.1))
    pearl = g.material("pearl", (0.86, 0.8, 0.68))
    creature = g.node("creature", translation=list(MIDDLE))
    add_foot(g, creature, blue, amber)
    add_pearl(g, creature, pearl)
    arm = arm_mesh(g, blue, amber, pearl)
    for index in range(ARMS):
        add_arm(g, creature, arm, index)
    add_key_light(g)
    add_sweeping_light(g)
    add_camera(g)
    return g
