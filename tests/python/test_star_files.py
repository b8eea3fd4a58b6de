"""Particles of RELION: STAR files, read by the package starfile."""

import os
import subprocess

import numpy as np
import pytest

import geodisk
from meshes import FACES, VERTICES

starfile = pytest.importorskip("starfile")


def turned_z(particles):
    """Where RELION has the z axis of each particle: rot, tilt and psi turn coordinates, z y z."""
    rotation = pytest.importorskip("scipy.spatial.transform").Rotation
    angles = particles[["rlnAngleRot", "rlnAngleTilt", "rlnAnglePsi"]].to_numpy()
    return rotation.from_euler("ZYZ", angles, degrees=True).inv().apply([0, 0, 1])


def coordinates(particles):
    return particles[["rlnCoordinateX", "rlnCoordinateY", "rlnCoordinateZ"]].to_numpy()


@pytest.mark.parametrize("frames", [False, True])
def test_particles_have_pixels_and_angles_of_the_normal(frames, tmp_path):
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.3, frames=frames)
    samples.save(tmp_path / "a.star", pixel_size=2.5)
    tables = starfile.read(tmp_path / "a.star")
    particles = tables["particles"]
    assert len(particles) == len(samples) > 50
    assert np.allclose(coordinates(particles) * 2.5, samples.points, rtol=0, atol=1e-12)
    assert np.allclose(turned_z(particles), samples.normals, atol=1e-6)
    assert float(np.ravel(tables["optics"]["rlnImagePixelSize"])[0]) == 2.5
    assert set(particles["rlnOpticsGroup"]) == {1}
    assert (particles["rlnAngleRot"] == 0).all() == (not frames)


def test_angles_are_those_of_frames(tmp_path):
    rotation = pytest.importorskip("scipy.spatial.transform").Rotation
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.3, frames="y")
    samples.save(tmp_path / "a.star")
    particles = starfile.read(tmp_path / "a.star")["particles"]
    angles = particles[["rlnAngleRot", "rlnAngleTilt", "rlnAnglePsi"]].to_numpy()
    found = rotation.from_euler("ZYZ", angles, degrees=True).inv().as_matrix()
    expected = rotation.from_quat(samples.attributes["frames"]).as_matrix()
    assert np.allclose(found, expected, atol=1e-6)
    assert np.allclose(found[:, :, 1], samples.normals, atol=1e-6)
    assert np.allclose(coordinates(particles), samples.points, rtol=0, atol=1e-12)


def test_angles_are_those_of_eulerangles(tmp_path):
    eulerangles = pytest.importorskip("eulerangles")
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.3, frames=True)
    samples.save(tmp_path / "a.star")
    particles = starfile.read(tmp_path / "a.star")["particles"]
    angles = particles[["rlnAngleRot", "rlnAngleTilt", "rlnAnglePsi"]].to_numpy()
    turns = eulerangles.euler2matrix(angles, axes="zyz", intrinsic=True, right_handed_rotation=True)
    # Those turn the particle to the reference.
    assert np.allclose(turns.transpose(0, 2, 1)[:, :, 2], samples.normals, atol=1e-6)


def test_a_pixel_size_is_for_star_alone(tmp_path):
    samples = geodisk.sample(VERTICES, FACES, min_distance=0.3)
    with pytest.raises(ValueError, match=r"pixel_size is for samples in \*\.star"):
        samples.save(tmp_path / "a.ply", pixel_size=2.0)
    with pytest.raises(ValueError, match="pixel_size is -1, not a positive number"):
        samples.save(tmp_path / "a.star", pixel_size=-1)
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif("GEODISK_COMMAND" not in os.environ, reason="needs the program")
def test_the_program_writes_the_same_particles(tmp_path):
    command = os.environ["GEODISK_COMMAND"]
    for name, more in {"a.star": ["--pixel-size", "0.5"], "a.npz": []}.items():
        subprocess.run(
            [command, "sample", "builtin:icosphere:2", "-d", "0.2", "-q", "-o", name, *more],
            cwd=tmp_path, check=True,
        )
    samples = geodisk.read(tmp_path / "a.npz")
    particles = starfile.read(tmp_path / "a.star")["particles"]
    assert np.allclose(coordinates(particles) / 2, samples.points, rtol=0, atol=1e-12)
    assert np.allclose(turned_z(particles), samples.normals, atol=1e-6)
    assert set(particles["rlnMicrographName"]) == set(particles["rlnTomoName"])
    refused = subprocess.run(
        [command, "sample", "builtin:cube", "-d", "0.2", "-o", "b.ply", "--pixel-size", "2"],
        cwd=tmp_path, capture_output=True, text=True,
    )
    assert refused.returncode == 2 and "--pixel-size is for samples in *.star" in refused.stderr
    assert not (tmp_path / "b.ply").exists()
