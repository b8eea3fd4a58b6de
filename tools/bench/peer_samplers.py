"""Samples a mesh with one sampler of another project, for tools/bench/peers, which runs this in its environment.

usage: peer_samplers.py SAMPLER MESH COUNT DISTANCE SEED OUT.npy
Writes the points to OUT.npy and prints the seconds of the call that samples.
"""
import sys
import time

import numpy as np
import trimesh


def open3d_elimination(mesh, count, distance, seed):
    import open3d
    open3d.utility.random.seed(seed)
    surface = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(mesh.vertices),
                                           open3d.utility.Vector3iVector(mesh.faces))
    return lambda: np.asarray(surface.sample_points_poisson_disk(count).points)


def trimesh_even(mesh, count, distance, seed):
    return lambda: trimesh.sample.sample_surface_even(mesh, count, radius=distance, seed=seed)[0]


def meshlab(mesh, distance, **options):
    import pymeshlab
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(mesh.vertices, mesh.faces))

    def call():
        meshes.generate_sampling_poisson_disk(radius=pymeshlab.PureValue(distance), **options)
        return meshes.current_mesh().vertex_matrix()
    return call


def meshlab_poisson(mesh, count, distance, seed):
    return meshlab(mesh, distance)


def meshlab_geodesic(mesh, count, distance, seed):
    return meshlab(mesh, distance, approximategeodesicdistance=True)


def igl_blue_noise(mesh, count, distance, seed):
    import igl
    return lambda: igl.blue_noise(mesh.vertices, mesh.faces, distance)[2]


def igl_uniform(mesh, count, distance, seed):
    import igl
    return lambda: igl.random_points_on_mesh(count, mesh.vertices, mesh.faces)[2]


def point_cloud_utils(mesh, distance, seed, **options):
    import point_cloud_utils as pcu

    def call():
        face, weights = pcu.sample_mesh_poisson_disk(mesh.vertices, mesh.faces, -1, distance,
                                                     random_seed=seed + 1, **options)
        return pcu.interpolate_barycentric_coords(mesh.faces, face, weights, mesh.vertices)
    return call


def pcu_geodesic(mesh, count, distance, seed):
    return point_cloud_utils(mesh, distance, seed)


def pcu_straight(mesh, count, distance, seed):
    return point_cloud_utils(mesh, distance, seed, use_geodesic_distance=False)


def main():
    name, path, count, distance, seed, output = sys.argv[1:]
    mesh = trimesh.load(path, process=False, force="mesh")
    mesh = trimesh.Trimesh(np.ascontiguousarray(mesh.vertices, np.float64),
                           np.ascontiguousarray(mesh.faces, np.int64), process=False)
    call = globals()[name](mesh, int(count), float(distance), int(seed))
    start = time.perf_counter()
    points = call()
    seconds = time.perf_counter() - start
    np.save(output, np.asarray(points, np.float64))
    print(seconds)


if __name__ == "__main__":
    main()
