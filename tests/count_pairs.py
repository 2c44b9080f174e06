#!/usr/bin/env python3
"""Pairs of (edge of one OBJ, triangle of another) that share a point, for tests/residual.sh.

    count_pairs.py EDGES.obj TRIANGLES.obj

Coordinates have six decimals, so they are whole micrometres, and whole numbers are exact here however
long they get: no filter, no tolerance, and nothing in common with the program that is tested."""
import sys
from collections import defaultdict

CELL = 30000  # micrometres


def read(path):
    points, triangles = [], []
    for line in open(path):
        word = line.split()
        if word[:1] == ["v"]:
            points.append(tuple(round(float(x) * 1e6) for x in word[1:4]))
        elif word[:1] == ["f"]:
            triangles.append(tuple(int(w.split("/")[0]) - 1 for w in word[1:4]))
    return points, triangles


def volume(a, b, c, d):
    x, y, z = ([p[k] - a[k] for k in range(3)] for p in (b, c, d))
    return (x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2])
            + x[2] * (y[0] * z[1] - y[1] * z[0]))


def area(a, b, c, i, j):
    return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i])


def in_plane(p, q, t):
    """A segment and a triangle of one plane, seen along the axis in which the triangle is widest."""
    i, j = max(((0, 1), (1, 2), (2, 0)), key=lambda k: abs(area(*t, *k)))

    def meet(a, b, c, d):
        s = area(a, b, c, i, j), area(a, b, d, i, j), area(c, d, a, i, j), area(c, d, b, i, j)
        if not any(s):
            return all(max(min(a[k], b[k]), min(c[k], d[k])) <= min(max(a[k], b[k]), max(c[k], d[k])) for k in (i, j))
        return s[0] * s[1] <= 0 and s[2] * s[3] <= 0

    sides = [area(t[k], t[k - 2], p, i, j) for k in range(3)]
    return all(s >= 0 for s in sides) or all(s <= 0 for s in sides) or any(meet(p, q, t[k], t[k - 2]) for k in range(3))


def meets(p, q, t):
    above, below = volume(*t, p), volume(*t, q)
    if above * below > 0:
        return False
    if above == 0 == below:
        return in_plane(p, q, t)
    sides = [volume(p, q, t[k], t[k - 2]) for k in range(3)]
    return all(s >= 0 for s in sides) or all(s <= 0 for s in sides)


def cells(points):
    low, high = ([f(p[k] for p in points) // CELL for k in range(3)] for f in (min, max))
    return ((x, y, z) for x in range(low[0], high[0] + 1) for y in range(low[1], high[1] + 1)
            for z in range(low[2], high[2] + 1))


def main():
    points, faces = read(sys.argv[1])
    edges = sorted({tuple(sorted((f[k], f[k - 1]))) for f in faces for k in range(3)})
    corners, triangles = read(sys.argv[2])
    grid = defaultdict(list)
    for n, f in enumerate(triangles):
        for cell in cells([corners[v] for v in f]):
            grid[cell].append(n)
    pairs = 0
    for a, b in edges:
        p, q = points[a], points[b]
        near = {n for cell in cells((p, q)) for n in grid.get(cell, ())}
        pairs += sum(meets(p, q, [corners[v] for v in triangles[n]]) for n in near)
    print(pairs)


main()
