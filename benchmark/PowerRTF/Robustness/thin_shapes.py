# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes with thin parts, made in code: closed surfaces without creases, their thickness in units
of the spacing h that n even samples have.

A shape is (points, triangles), oriented outwards, with enough facets to be smooth at h / 4.
"""

import math

SECTORS = 120


def area(points, triangles):
    total = 0
    for a, b, c in triangles:
        u = [points[b][k] - points[a][k] for k in range(3)]
        v = [points[c][k] - points[a][k] for k in range(3)]
        total += math.sqrt(sum((u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2]) ** 2
                               for i in range(3))) / 2
    return total


def with_spacing(make, thickness, samples):
    """The shape `make(t)` whose `t` is `thickness` times the spacing of so many samples."""
    h = 0.05
    for _ in range(3):  # the area depends on t, but little
        shape = make(thickness * h)
        h = math.sqrt(2 / math.sqrt(3) * area(*shape) / samples)
    return make(thickness * h)


def arc(center, radius, begin, end, steps):
    """Points of a circle in the half-plane (distance to the axis, height); angles in degrees."""
    angles = [math.radians(begin + (end - begin) * k / steps) for k in range(steps + 1)]
    return [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a)) for a in angles]


def dense(profile, step):
    """The profile with points no farther apart than `step`."""
    result = [profile[0]]
    for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
        parts = max(1, math.ceil(math.hypot(r1 - r0, z1 - z0) / step))
        if math.hypot(r1 - r0, z1 - z0) < 1e-9:
            continue
        result += [(r0 + (r1 - r0) * k / parts, z0 + (z1 - z0) * k / parts)
                   for k in range(1, parts + 1)]
    return result


def revolved(profile, step=0.03):
    """The surface of revolution of a profile from the lower to the upper point of the axis."""
    profile = dense(profile, step)[1:-1]
    low, high = (0, 0, profile[0][1]), (0, 0, profile[-1][1])
    points = []
    for r, z in profile:
        points += [(r * math.cos(2 * math.pi * k / SECTORS),
                    r * math.sin(2 * math.pi * k / SECTORS), z) for k in range(SECTORS)]
    triangles = []
    for i in range(len(profile) - 1):
        for k in range(SECTORS):
            a, b = i * SECTORS + k, i * SECTORS + (k + 1) % SECTORS
            triangles += [(a, b, b + SECTORS), (a, b + SECTORS, a + SECTORS)]
    last = (len(profile) - 1) * SECTORS
    points += [low, high]
    for k in range(SECTORS):
        following = (k + 1) % SECTORS
        triangles += [(len(points) - 2, following, k),
                      (len(points) - 1, last + k, last + following)]
    return points, triangles


def pin(t):
    """A ball with a finger of diameter t."""
    r, top = t / 2, 2
    foot = math.degrees(math.acos(r))
    return revolved(arc((0, 0), 1, -90, foot, 40)
                    + arc((0, top), r, 0, 90, 16))


def disc(t):
    """A plate with a round rim."""
    r = t / 2
    return revolved([(0, -r)] + arc((1, 0), r, -90, 90, 16) + [(0, r)])


def oval(t):
    """A plate, twice as long as it is wide."""
    points, triangles = disc(t)
    return [(2 * x, y, z) for x, y, z in points], triangles


def bowl(t):
    """Half a hollow ball with a round rim."""
    r = t / 2
    return revolved(arc((0, 0), 1 + r, -90, 0, 40) + arc((1, 0), r, 0, 180, 16)
                    + arc((0, 0), 1 - r, 0, -90, 40))


def ring(t):
    """A ball with a plate around its equator."""
    r, reach = t / 2, 1.5
    foot = math.degrees(math.asin(r))
    return revolved(arc((0, 0), 1, -90, -foot, 40) + arc((reach, 0), r, -90, 90, 16)
                    + arc((0, 0), 1, foot, 90, 40))


def groove(t):
    """A ball with a narrow groove of width t around its equator."""
    r, ground = t / 2, 0.8
    foot = math.degrees(math.asin(r))
    return revolved(arc((0, 0), 1, -90, -foot, 40) + arc((ground, 0), r, -90, -270, 16)
                    + arc((0, 0), 1, foot, 90, 40))


def lens(t):
    """A flat ellipsoid: its rim is sharper than it is thick."""
    return revolved([(math.cos(math.radians(a)), t / 2 * math.sin(math.radians(a)))
                     for a in range(-90, 91)])


def needle(t):
    """A long ellipsoid: pointed."""
    return revolved([(t / 2 * math.cos(math.radians(a)), math.sin(math.radians(a)))
                     for a in range(-90, 91)])


def wave(t):
    """A plate that is bent up and down."""
    points, triangles = disc(t)
    return [(x, y, z + 0.12 * math.sin(5 * x)) for x, y, z in points], triangles


def swept(centers, t):
    """A tube of diameter t along a curve, with round ends."""
    def minus(a, b):
        return [x - y for x, y in zip(a, b)]

    def unit(a):
        size = math.sqrt(sum(x * x for x in a))
        return [x / size for x in a]

    def cross(a, b):
        return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]

    sectors, r, rings = 24, t / 2, []
    ahead = [unit(minus(centers[min(i + 1, len(centers) - 1)], centers[max(i - 1, 0)]))
             for i in range(len(centers))]
    across = unit(cross(ahead[0], [0.3, 0.5, 0.8]))
    for i, (center, d) in enumerate(zip(centers, ahead)):
        across = unit(minus(across, [sum(x * y for x, y in zip(across, d)) * x for x in d]))
        turns = [(0, r)]
        if i == 0:
            turns = [(-r * math.cos(a), r * math.sin(a))
                     for a in (math.radians(x) for x in (15, 30, 45, 60, 75, 90))]
        elif i == len(centers) - 1:
            turns = [(r * math.cos(a), r * math.sin(a))
                     for a in (math.radians(x) for x in (90, 75, 60, 45, 30, 15))]
        other = cross(d, across)
        for along, radius in turns:
            rings.append([[center[k] + along * d[k]
                           + radius * (math.cos(2 * math.pi * s / sectors) * across[k]
                                       + math.sin(2 * math.pi * s / sectors) * other[k])
                           for k in range(3)] for s in range(sectors)])
    points = [tuple(p) for those in rings for p in those]
    triangles = []
    for i in range(len(rings) - 1):
        for s in range(sectors):
            a, b = i * sectors + s, i * sectors + (s + 1) % sectors
            triangles += [(a, b, b + sectors), (a, b + sectors, a + sectors)]
    points += [tuple(centers[0][k] - r * ahead[0][k] for k in range(3)),
               tuple(centers[-1][k] + r * ahead[-1][k] for k in range(3))]
    last = (len(rings) - 1) * sectors
    for s in range(sectors):
        following = (s + 1) % sectors
        triangles += [(len(points) - 2, following, s),
                      (len(points) - 1, last + s, last + following)]
    return points, triangles


def spring(t):
    """A tube along a helix: thin everywhere."""
    return swept([(math.cos(a), math.sin(a), 0.08 * a)
                  for a in (k * 0.05 for k in range(380))], t)


def with_ears(t, half_width, reach, directions):
    """A ball with ears of thickness t, `half_width` (an angle) wide, in the given directions."""
    def plateau(x):
        return 1 / (1 + x ** 8)

    def height(theta, phi):
        total = 0
        for at in directions:
            away = (phi - at + math.pi) % (2 * math.pi) - math.pi
            total += plateau(away / (t / 2)) * plateau(theta / half_width)
        return 1 + reach * total

    def is_tip(x):
        return any(abs((x - at + math.pi) % (2 * math.pi) - math.pi) < 0.6 * t
                   for at in directions)

    def even(profile, low, high, parts, weight):
        """Parameters from low to high between which the profile is about as long."""
        steps = 20000
        xs = [low + (high - low) * k / steps for k in range(steps + 1)]
        sums = [0]
        for a, b in zip(xs, xs[1:]):
            sums.append(sums[-1] + math.hypot(weight(a) * (b - a), profile(b) - profile(a)))
        result, k = [], 0
        for i in range(parts):
            goal = sums[-1] * i / parts
            while sums[k + 1] < goal:
                k += 1
            share = (goal - sums[k]) / (sums[k + 1] - sums[k])
            result.append(xs[k] + share * (xs[k + 1] - xs[k]))
        return result

    phis = even(lambda phi: height(0, phi), 0, 2 * math.pi, 300,
                lambda phi: 25 if is_tip(phi) else 1)
    thetas = even(lambda theta: height(theta, directions[0]), -math.pi / 2, math.pi / 2, 120,
                  lambda theta: 1)[1:]
    points, triangles = [], []
    for theta in thetas:
        for phi in phis:
            r = height(theta, phi)
            points.append((r * math.cos(theta) * math.cos(phi), r * math.cos(theta) * math.sin(phi),
                           r * math.sin(theta)))
    around = len(phis)
    for i in range(len(thetas) - 1):
        for k in range(around):
            a, b = i * around + k, i * around + (k + 1) % around
            triangles += [(a, b, b + around), (a, b + around, a + around)]
    points += [(0, 0, -1), (0, 0, 1)]
    last = (len(thetas) - 1) * around
    for k in range(around):
        following = (k + 1) % around
        triangles += [(len(points) - 2, following, k),
                      (len(points) - 1, last + k, last + following)]
    return points, triangles


def ears(t):
    """A ball with two ears, 1.5 radii from each other."""
    return with_ears(t, 0.25, 0.5, [1, 2.2])


def wings(t):
    """A ball with two long wings."""
    return with_ears(t, 0.4, 1.5, [0.5, 0.5 + math.pi])


SHAPES = [pin, disc, oval, bowl, ring, groove, lens, wave, ears, wings]
WITHOUT_ROOM = [needle, spring]  # pointed, and thin all over: no spacing of the samples helps
