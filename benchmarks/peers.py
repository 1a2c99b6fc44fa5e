"""Other engines for Python, each only if it is there: ``python -m benchmarks.peers NAME MESH LEVELS ROUNDS``.

Prints the number of faces and the least seconds from arrays to arrays.  It is run by
the Python that BENCHMARK_PEERS names (this one, if it names none), so that they can be installed
apart:

    python -m venv peers; peers/bin/pip install pymeshlab trimesh pyvista open3d libigl bpy
    BENCHMARK_PEERS=peers/bin/python python -m benchmarks
"""

import sys
import time
from pathlib import Path

import numpy as np

from benchmarks.files import read


def by_trimesh(points, faces, levels):
    from trimesh.remesh import subdivide_loop

    return subdivide_loop(points, faces, iterations=levels)


def by_pymeshlab(points, faces, levels):
    import pymeshlab

    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(points, faces))
    meshes.meshing_surface_subdivision_loop(iterations=levels, threshold=pymeshlab.PercentageValue(0))
    return meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()


def by_pyvista(points, faces, levels):
    import pyvista

    cells = np.column_stack([np.full(len(faces), 3), faces])
    fine = pyvista.PolyData(points, cells).subdivide(levels, "loop")
    return fine.points, fine.faces.reshape(-1, 4)


def by_open3d(points, faces, levels):
    import open3d

    vector = open3d.utility
    mesh = open3d.geometry.TriangleMesh(vector.Vector3dVector(points), vector.Vector3iVector(faces.astype(np.int32)))
    fine = mesh.subdivide_loop(levels)
    return np.asarray(fine.vertices), np.asarray(fine.triangles)


def by_libigl(points, faces, levels):
    import igl

    return igl.loop(points, faces, levels)


def by_bpy(points, faces, levels):
    import bpy

    mesh = bpy.data.meshes.new("control")
    mesh.from_pydata(points.tolist(), [], faces.tolist())
    thing = bpy.data.objects.new("control", mesh)
    bpy.context.collection.objects.link(thing)
    modifier = thing.modifiers.new("subsurf", "SUBSURF")
    modifier.levels, modifier.use_limit_surface = levels, False
    fine = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    made = np.empty(3 * len(fine.vertices), np.float32), np.empty(len(fine.loops), np.int32)
    fine.vertices.foreach_get("co", made[0])
    fine.loops.foreach_get("vertex_index", made[1])
    bpy.data.objects.remove(thing)
    return made[0].reshape(-1, 3), made[1].reshape(-1, 4)


PEERS = {
    "pymeshlab": (by_pymeshlab, "loop"),
    "trimesh": (by_trimesh, "loop"),
    "pyvista": (by_pyvista, "loop"),
    "open3d": (by_open3d, "loop"),
    "libigl": (by_libigl, "loop"),
    "bpy": (by_bpy, "catmull-clark"),
}

if __name__ == "__main__":
    name, path, levels, rounds = sys.argv[1:]
    control = read(Path(path))
    times = []
    for _ in range(int(rounds)):
        start = time.process_time()
        _, faces = PEERS[name][0](control.points, control.faces, int(levels))
        times.append(time.process_time() - start)
    print(len(faces), min(times))
