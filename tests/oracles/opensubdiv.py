"""Write tests/golden/opensubdiv.json: refined positions by OpenSubdiv 3.5.

sudo apt-get install libosd-dev g++
g++ -O1 -o /tmp/opensubdiv tests/oracles/opensubdiv.cpp -losdCPU
python tests/oracles/opensubdiv.py /tmp/opensubdiv > tests/golden/opensubdiv.json
"""

import json
import random
import subprocess
import sys
from itertools import product

CUBE = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
OCTAHEDRON = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
GRID = [[5 * i + j, 5 * i + j + 5, 5 * i + j + 6, 5 * i + j + 1] for i, j in product(range(3), range(4))]
HOLED = [GRID[k] for k in range(len(GRID)) if k not in (1, 7)]
SPLIT = [triangle for a, b, c, d in HOLED for triangle in ([a, b, c], [a, c, d])]
PRISM = [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9], *([k, (k + 1) % 5, (k + 1) % 5 + 5, k + 5] for k in range(5))]
BIPYRAMID = [f for k in range(7) for f in ([k, (k + 1) % 7, 7], [(k + 1) % 7, k, 8])]

CATMARK, LOOP = 0, 1
EDGE, EDGE_AND_CORNER = 0, 1
CASES = {
    # name: scheme, boundary, faces, {edge: sharpness}, {vertex: sharpness}; sharpness is float32 there, so dyadic
    "cube": (CATMARK, EDGE, CUBE, {}, {}),
    "cube, a crease loop of 0.5": (CATMARK, EDGE, CUBE, dict.fromkeys([(0, 1), (1, 3), (3, 2), (2, 0)], 0.5), {}),
    "cube, a crease loop of 2.75": (CATMARK, EDGE, CUBE, dict.fromkeys([(0, 1), (1, 3), (3, 2), (2, 0)], 2.75), {}),
    "cube, an infinite crease loop": (CATMARK, EDGE, CUBE, dict.fromkeys([(0, 1), (1, 3), (3, 2), (2, 0)], 10), {}),
    "cube, mixed creases": (
        CATMARK, EDGE, CUBE, {(0, 1): 0.5, (1, 3): 1.25, (3, 2): 2.75, (3, 7): 10, (7, 6): 1, (6, 4): 0.25}, {},
    ),
    "cube, darts": (CATMARK, EDGE, CUBE, {(0, 1): 10, (1, 3): 10, (7, 6): 1.25}, {}),
    "cube, corners": (CATMARK, EDGE, CUBE, {(0, 1): 1.25}, {0: 0.5, 3: 1.25, 5: 10, 6: 2.75}),
    "pentagonal prism": (CATMARK, EDGE, PRISM, {(0, 1): 1.25, (1, 2): 2.75, (2, 7): 0.5}, {8: 1.25}),
    "holed grid": (CATMARK, EDGE, HOLED, {(12, 13): 1.25}, {}),
    "holed grid, corners": (CATMARK, EDGE_AND_CORNER, HOLED, {(7, 12): 2.75, (12, 17): 0.5}, {13: 1.25}),
    "octahedron": (LOOP, EDGE, OCTAHEDRON, {}, {}),
    "octahedron, a crease loop of 1.25": (
        LOOP, EDGE, OCTAHEDRON, dict.fromkeys([(0, 2), (2, 1), (1, 3), (3, 0)], 1.25), {},
    ),
    "octahedron, mixed creases": (
        LOOP, EDGE, OCTAHEDRON, {(0, 2): 0.5, (2, 1): 1.25, (1, 4): 2.75, (4, 0): 10, (4, 3): 0.75}, {5: 1.25},
    ),
    "bipyramid, darts and corners": (LOOP, EDGE, BIPYRAMID, {(7, 0): 10, (7, 1): 0.5, (2, 3): 1}, {8: 2.75, 5: 0.5}),
    "holed triangles": (LOOP, EDGE, SPLIT, {(12, 13): 1.25}, {}),
    "holed triangles, corners": (LOOP, EDGE_AND_CORNER, SPLIT, {(7, 12): 2.75, (12, 17): 0.5}, {13: 1.25}),
}  # fmt: skip


def main(program: str) -> None:
    cases = {}
    for name, (scheme, boundary, faces, creases, corners) in CASES.items():
        draw = random.Random(name)
        points = [[draw.randrange(-64, 64) / 16 for _ in range(3)] for _ in range(1 + max(map(max, faces)))]
        levels = 3 if "cube, a crease" in name or scheme == LOOP else 2
        lists = [points, [[len(f), *f] for f in faces], [[*e, s] for e, s in creases.items()], list(corners.items())]
        words = [scheme, boundary, levels]
        for one in lists:
            words += [len(one), *(x for line in one for x in line)]
        answer = subprocess.run([program], input=" ".join(map(str, words)), capture_output=True, text=True, check=True)
        cases[name] = {
            "scheme": ("catmull-clark", "loop")[scheme],
            "boundary": ("edge", "edge-and-corner")[boundary],
            "points": points, "faces": faces, "creases": lists[2], "corners": lists[3],
            "levels": blocks(answer.stdout)[:-1], "limits": blocks(answer.stdout)[-1],
        }  # fmt: skip
    lines = (f"{json.dumps(name)}: {json.dumps(case, separators=(',', ':'))}" for name, case in cases.items())
    print("{\n" + ",\n".join(lines) + "\n}")


def blocks(text: str) -> list[list[list[float]]]:
    lines = iter(text.split("\n"))
    return [[[float.fromhex(x) for x in next(lines).split()] for _ in range(int(n))] for n in lines if n]


if __name__ == "__main__":
    main(sys.argv[1])
