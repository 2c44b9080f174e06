#!/usr/bin/env python3
"""Where joints are, by a reader of its own, for tests/fk.sh: quaternions, words split at blanks, whole files.

    fk.py check FILE.bvh|FILE.amc [ASF] [replace|add] <joints.csv    compares with `kitsuke inspect --joints`
    fk.py make bvh|acclaim SEED NAME                                writes an odd skeleton and its motion

check prints the largest distance, as a part of the skeleton's height (the longest way along its bones), and fails
beyond 1e-6 or where joints or frames differ."""
import math
import random
import sys

AXIS = {"x": 1, "y": 2, "z": 3}


def product(a, b):
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def about(axis, degrees):
    q = [math.cos(math.radians(degrees) / 2), 0, 0, 0]
    q[AXIS[axis]] = math.sin(math.radians(degrees) / 2)
    return q


def turned(q, v):
    return product(product(q, (0, *v)), (q[0], -q[1], -q[2], -q[3]))[1:]


def plus(a, b):
    return [x + y for x, y in zip(a, b)]


class Joint:
    def __init__(self, name, parent, offset=(0, 0, 0)):
        self.name, self.parent, self.offset, self.channels = name, parent, offset, []
        self.axis = (1, 0, 0, 0)  # rotations are meant in a frame turned by this


def place(joints, row, adds):
    """Positions of all joints; row[j] are the values of joint j's channels, (what, axis) in order of the product."""
    at, turn = [], []
    for joint, values in zip(joints, row):
        local, own = list(joint.offset), (1, 0, 0, 0)
        for (what, axis), value in zip(joint.channels, values):
            if what == "position":
                k = AXIS[axis] - 1
                local[k] = joint.offset[k] + value if adds else value
            else:
                own = product(own, about(axis, value))
        c = joint.axis
        own = product(product(c, own), (c[0], -c[1], -c[2], -c[3]))
        if joint.parent is None:
            at.append(local), turn.append(own)
        else:
            at.append(plus(at[joint.parent], turned(turn[joint.parent], local)))
            turn.append(product(turn[joint.parent], own))
    return at


def read_bvh(path):
    lines = open(path, newline=None).read().split("\n")
    joints, stack, n = [], [], 0
    while not lines[n].split()[:1] == ["MOTION"]:
        word = lines[n].split()
        n += 1
        if word[:1] in (["ROOT"], ["JOINT"], ["End"]):
            parent = stack[-1] if stack else None
            name = joints[parent].name + "_End" if word[0] == "End" else " ".join(word[1:]).strip('"')
            joints.append(Joint(name, parent))
        elif word[:1] == ["{"]:
            stack.append(len(joints) - 1)
        elif word[:1] == ["}"]:
            stack.pop()
        elif word[:1] == ["OFFSET"]:
            joints[-1].offset = [float(x) for x in word[1:4]]
        elif word[:1] == ["CHANNELS"]:
            joints[-1].channels = [(w[1:].lower(), w[0].lower()) for w in word[2:]]
    values = iter(" ".join(lines[n + 3:]).split())
    rows = []
    for _ in range(int(lines[n + 1].split(":")[1])):
        try:
            rows.append([[float(next(values)) for _ in j.channels] for j in joints])
        except RuntimeError:  # the file ends within a frame
            break
    return joints, rows


def read_acclaim(amc, asf):
    bones, order, key, degrees, tree = {}, ["root"], None, {"deg": 1, "rad": 180 / math.pi}, {}
    unit = 1
    for line in open(asf):
        word = line.split("#")[0].split() or [""]
        if word[0].startswith(":"):
            key = word[0]
        elif key == ":units" and word[0] == "angle":
            unit = degrees[word[1]]
        elif key == ":root" and word[0] == "order":
            bones["root"] = {"dof": [w.lower() for w in word[1:]], "axis": ([0, 0, 0], "XYZ"), "length": 0,
                             "direction": [0, 0, 0]}
        elif key == ":bonedata" and word[0] == "name":
            bone = bones[word[1]] = {"dof": [], "axis": ([0, 0, 0], "XYZ")}
        elif key == ":bonedata" and word[0] == "axis":
            bone["axis"] = [float(x) * unit for x in word[1:4]], word[4]
        elif key == ":bonedata" and word[0] == "direction":
            bone["direction"] = [float(x) for x in word[1:4]]
        elif key == ":bonedata" and word[0] == "length":
            bone["length"] = float(word[1])
        elif key == ":bonedata" and word[0] == "dof":
            bone["dof"] = word[1:]
        elif key == ":hierarchy" and word[0] not in ("", "begin", "end"):
            order += word[1:]
            tree.update((child, word[0]) for child in word[1:])
    joints, index = [], {}
    for name in sorted(order, key=lambda name: depth(tree, name)):
        bone, parent = bones[name], tree.get(name)
        index[name] = len(joints)
        joint = Joint(name, index.get(parent), tip(bones[parent]) if parent else (0, 0, 0))
        angles, turns = bone["axis"]
        # Values come in the order of dof; what is turned first says the axis, for the bone as for its frame, but the
        # root turns in the order of its values.
        first = "".join(d[1] for d in bone["dof"] if d[0] == "r") if name == "root" else turns.lower()
        bone["turns"] = sorted(bone["dof"], key=lambda d: d[0] == "r" and -first.index(d[1]))
        joint.channels = [("position" if d[0] == "t" else "rotation", d[1]) for d in bone["turns"]]
        for angle, axis in zip(angles, "xyz"):
            bone[axis] = about(axis, angle)
        for axis in reversed(turns.lower()):
            joint.axis = product(joint.axis, bone[axis])
        joints.append(joint)
    leaves = [Joint(j.name + "_End", index[j.name], tip(bones[j.name])) for j in joints if j.name not in tree.values()]
    rows, now = [], {}
    for line in open(amc):
        word = line.split("#")[0].split()
        if len(word) == 1 and word[0].isdigit():
            now = {}
            rows.append(now)
        elif word and rows:
            value = {d: float(x) * (1 if d[0] == "t" else unit) for d, x in zip(bones[word[0]]["dof"], word[1:])}
            now[word[0]] = [value[d] for d in bones[word[0]]["turns"]]
    return joints + leaves, [[row.get(j.name, []) for j in joints + leaves] for row in rows]


def depth(tree, name):
    return 1 + depth(tree, tree[name]) if name in tree else 0


def tip(bone):
    return [x * bone["length"] for x in bone["direction"]]


def check(path, *options):
    adds = "add" in options
    joints, rows = read_acclaim(path, options[0]) if path.endswith("amc") else read_bvh(path)
    way = []
    for j in joints:
        way.append(math.hypot(*j.offset) + (way[j.parent] if j.parent is not None else 0))
    names, worst, lines = {j.name: i for i, j in enumerate(joints)}, 0, sys.stdin.read().split("\n")[1:-1]
    assert len(lines) == len(rows) * len(joints), f"{len(lines)} lines for {len(rows)} frames of {len(joints)} joints"
    assert path.endswith("amc") or [x.split(",")[1] for x in lines[:len(joints)]] == [j.name for j in joints], "order"
    for f, row in enumerate(rows):
        at = place(joints, row, adds)
        for line in lines[f * len(joints):(f + 1) * len(joints)]:
            frame, name, *p = line.split(",")
            assert int(frame) == f + 1, line
            worst = max(worst, math.dist(at[names[name]], [float(x) for x in p]) / max(way))
    print(f"{worst:.2g} of the height, {len(rows)} frames, {len(joints)} joints")
    return worst < 1e-6


def some(dice, size):
    return " ".join(dice.choice(["%.6f", "%g", "%.4e", "%+.3f"]) % dice.uniform(-size, size) for _ in range(3))


def make_bvh(dice, name):
    """Any order of channels, positions at any joint and anywhere in the list, joints of no length, bare leaves."""
    text, counts = ["HIERARCHY"], []

    def joint(level):
        pad = dice.choice(["\t", "  "]) * level
        text.append(f"{pad}{'JOINT' if level else 'ROOT'} part {len(counts)}")
        text.append(pad + "{")
        text.append(f"{pad}\tOFFSET {some(dice, 30) if dice.random() < 0.9 else '0 0 0'}")
        channels = [a + "rotation" for a in dice.sample("XYZ", dice.choice([1, 2, 3, 3, 3, 3]))]
        if level == 0 or dice.random() < 0.3:
            channels += [a + "position" for a in dice.sample("XYZ", dice.choice([1, 3, 3, 3]))]
        if dice.random() < 0.3:
            dice.shuffle(channels)
        text.append(f"{pad}\tCHANNELS {len(channels)} {' '.join(channels)}")
        counts.append(len(channels))
        children = dice.choice([0, 1, 1, 2, 3]) if 0 < level < 12 else 3 * (level == 0)
        for _ in range(children):
            joint(level + 1)
        if not children and dice.random() < 0.7:
            text.extend([pad + "\tEnd Site", pad + "\t{", f"{pad}\t\tOFFSET {some(dice, 9)}", pad + "\t}"])
        text.append(pad + "}")

    joint(0)
    text += ["MOTION", "Frames: 9", "Frame Time: 0.01"]
    for _ in range(9):
        text.append(dice.choice(" \t").join(some(dice, dice.choice([5, 400])).split()[0] for _ in range(sum(counts))))
    open(name + ".bvh", "w", newline="").write(dice.choice(["\n", "\r\n"]).join(text) + dice.choice(["", "\n"]))


def make_acclaim(dice, name):
    """Bones with any axis, any order of it, any degrees of freedom in any order."""
    order = " order " + " ".join(dice.sample(["TX", "TY", "TZ", "RX", "RY", "RZ"], 6))
    asf = [":units", " length 0.45", " angle " + dice.choice(["deg", "rad"]), ":root", order, " axis XYZ",
           " position 0 0 0", " orientation 0 0 0", ":bonedata"]
    dof, parents = {"root": 6 * ["t"]}, {}
    for i in range(12):
        bone = f"bone{i}"
        parents.setdefault(dice.choice(list(dof)), []).append(bone)
        dof[bone] = dice.sample(["rx", "ry", "rz"], dice.choice([0, 1, 2, 3, 3]))
        asf += [" begin", " name " + bone, " direction " + some(dice, 1), f" length {dice.uniform(0, 9):.4f}",
                f" axis {some(dice, 90)} {''.join(dice.sample('XYZ', 3))}"]
        asf += [" dof " + " ".join(dof[bone])] * bool(dof[bone]) + [" end"]
    asf += [":hierarchy", " begin"] + [f" {p} {' '.join(c)}" for p, c in parents.items()] + [" end"]
    amc = [":FULLY-SPECIFIED"]
    for frame in range(1, 9):
        amc.append(str(frame))
        amc += [f"{bone} {' '.join(f'{dice.uniform(-99, 99):.5f}' for _ in d)}" for bone, d in dof.items() if d]
    open(name + ".asf", "w").write("\n".join(asf) + "\n")
    open(name + ".amc", "w").write("\n".join(amc) + "\n")


if sys.argv[1] == "check":
    sys.exit(not check(*sys.argv[2:]))
{"bvh": make_bvh, "acclaim": make_acclaim}[sys.argv[2]](random.Random(int(sys.argv[3])), sys.argv[4])
