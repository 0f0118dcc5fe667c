"""Geometry from a case file into the frames: the inside of a surface, points, and the background mesh. Usage:
frames_test.py PROGRAM [TEST ...]

Oracles: volume, centroid and cells of a truncated pyramid in closed form; the lattice of the grid. All of them need nothing of the program but its
files, which are read as a user would (python/scarp/vtu.py).
"""

import itertools
import json
import os
import struct
import sys

import cases
from cases import COLUMN, COLUMN_IN_SPACE, ProgramTest, contents, place, read, replaced

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python", "scarp"))
import vtu  # noqa: E402  (the project's own reader of frames)


def pyramid():
    """Triangles of a truncated pyramid that stands on z = 0: squares of 3 m and 1.5 m about (2, 2), 1.5 m high, so that its sides rise two in one."""
    bottom = [(0.5, 0.5, 0), (3.5, 0.5, 0), (3.5, 3.5, 0), (0.5, 3.5, 0)]
    top = [(1.25, 1.25, 1.5), (2.75, 1.25, 1.5), (2.75, 2.75, 1.5), (1.25, 2.75, 1.5)]
    faces = [bottom[::-1], top] + [[bottom[k], bottom[(k + 1) % 4], top[(k + 1) % 4], top[k]] for k in range(4)]
    return [triangle for a, b, c, d in faces for triangle in ((a, b, c), (a, c, d))]


def ascii_stl(triangles):
    facets = "".join(" facet normal 0 0 0\n  outer loop\n" + "".join(f"   vertex {x} {y} {z}\n" for x, y, z in triangle) +
                     "  endloop\n endfacet\n" for triangle in triangles)
    return f"solid hill\n{facets}endsolid hill\n"


def binary_stl(triangles):
    return bytes(80) + struct.pack("<I", len(triangles)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *itertools.chain(*triangle), 0) for triangle in triangles)


# The column's ground in that pyramid, and a few steps of its time.
HILL = replaced(COLUMN_IN_SPACE, "size = [1.0, 0.5, 4.0]", "size = [4.0, 4.0, 2.0]")
HILL = replaced(HILL, "polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0], [0.0, 3.0]]\ny = [0.0, 0.5]", 'stl = "hill.stl"')
HILL = replaced(HILL, "duration = 0.2", "duration = 0.02")


class Frames(ProgramTest):
    def frames(self, folder):
        return [vtu.read_vtu(path) for _, path in vtu.read_pvd(self.path(folder, "points.pvd"))]

    def expect_near(self, found, expected, tolerance):
        self.assertLessEqual(np.abs(np.subtract(found, expected)).max(), tolerance)


class Surfaces(Frames):
    VOLUME, HEIGHT_OF_CENTROID = 7.875, 33 / 56  # h/3 (A + √(A a) + a), h/4 (A + 2 √(A a) + 3 a)/(A + √(A a) + a)

    def setUp(self):
        super().setUp()
        self.write("hill.toml", HILL)
        self.write("hill.stl", ascii_stl(pyramid()))

    def test_the_points_of_a_surface_are_its_volume(self):
        text = self.scarp("check", "hill.toml").stdout
        # Two layers of cells to a step of the sides: they cut a quarter off the outer cells of the lower one (and 5/12 off
        # those at edges), three quarters off those of the upper one, which then have less than the least share of a cell and no point.
        points = 12**2 + 2 * 10**2 + 2 * 8**2 + 6**2
        self.assertIn(f"{points} points, volume 7.875 m3, mass 15.75", text)
        self.scarp("run", "hill.toml", "--quiet", "--out", "r")
        first = self.frames("r")[0]
        volume, x = first["volume"], first["Points"]
        self.assertEqual(len(volume), points)
        # Round-off of some hundred sums.
        self.assertAlmostEqual(volume.sum(), self.VOLUME, delta=1e-12)
        self.assertAlmostEqual((volume * first["density"]).sum(), 2 * self.VOLUME, delta=1e-12)
        self.expect_near(volume @ x / self.VOLUME, [2, 2, self.HEIGHT_OF_CENTROID], 1e-12)
        # The weight of the soil above each point, up to the slanted sides.
        beside = 1.5 - np.abs(x[:, :2] - 2).max(axis=1)  # from the nearest side of the base
        weight = 2 * 9.81 * (np.minimum(1.5, 2 * beside) - x[:, 2])
        self.assertGreater(weight.min(), 0)  # all of them inside
        for component, share in ((2, 1), (0, 1 / 3), (1, 1 / 3)):
            self.expect_near(first["stress"][:, component], share * weight, 1e-12 * weight.max())

    def test_a_surface_runs(self):
        self.scarp("run", "hill.toml", "--quiet", "--out", "r")
        summary = json.loads(read(self.path("r", "summary.json")))
        self.assertEqual((summary["status"], summary["dimension"], summary["points"]), ("done", 3, 508))
        self.assertIn(summary["steps"], range(3, 20))
        self.assertLess(abs(summary["mass_error"]), 1e-13)
        first, last = self.frames("r")
        self.assertEqual(list(last["id"]), list(range(508)))
        self.assertAlmostEqual((last["volume"] * last["density"]).sum(), 2 * self.VOLUME, delta=1e-12)
        self.expect_near(last["Points"] - first["Points"], last["displacement"], 1e-14)
        # Nothing carries K0 at the sides: they spread, all alike but for the order of sums, and by no more than if the thrust on a
        # section through the middle, K0 ρ g ∫ H²/2 = 14.72 kN, moved a half of its own all the time (dt takes it to 1 + 1/steps of that).
        mass = last["volume"] * last["density"]
        u = last["displacement"][:, :2]
        spread = mass @ (u * np.sign(first["Points"][:, :2] - 2))
        self.assertGreater(spread.min(), 0)
        self.assertLess(spread.max(), 2 * 14.72 * 0.5 * 0.02**2 * (1 + 1 / summary["steps"]))
        self.expect_near(mass @ u, 0, 1e-10 * spread.min())
        for values in last.values():
            self.assertTrue(np.isfinite(values).all())

    def test_both_kinds_of_file_give_the_same(self):
        self.scarp("run", "hill.toml", "--quiet", "--out", "ascii")
        self.write("hill.stl", binary_stl(pyramid()))
        self.scarp("run", "hill.toml", "--quiet", "--out", "binary")
        ours, theirs = contents(self.path("ascii")), contents(self.path("binary"))
        for files in (ours, theirs):
            del files["summary.json"]  # times of the machine
        self.expect_same(ours, theirs)

    def test_the_kept_case_finds_the_surface(self):
        os.mkdir(self.path("project"))
        for name in ("hill.toml", "hill.stl"):
            os.rename(self.path(name), self.path("project", name))
        for out, overrides in (("project/r", []), ("project/deep/er", []), ("away", []), ("project/set", ["--set", "output.every=1"])):
            with self.subTest(out=out):
                self.scarp("run", "project/hill.toml", "--quiet", "--out", out, *overrides)
                self.scarp("run", f"{out}/case.toml", "--quiet", "--out", "again")
                ours, theirs = contents(self.path(out)), contents(self.path("again"))
                for files in (ours, theirs):
                    del files["summary.json"], files["case.toml"]  # times of the machine; names of files
                self.expect_same(ours, theirs)
        # The project is moved with its results; results elsewhere are moved alone.
        os.rename(self.path("away"), self.path("moved"))
        self.scarp("run", "moved/case.toml", "--quiet", "--out", "again")
        os.rename(self.path("project"), self.path("archive"))
        self.scarp("run", "archive/r/case.toml", "--quiet", "--out", "again")

    def test_a_hole_is_refused(self):
        self.write("hill.stl", ascii_stl(pyramid()[:-1]))
        self.refused("run", "hill.toml", "--quiet", "--out", "r", parts=["hill.stl:", "not closed"])
        missing = replaced(HILL, "hill.stl", "nosuch.stl")
        self.write("hill.toml", missing)
        self.refused("run", "hill.toml", "--quiet", "--out", "r", parts=["hill.toml:" + place(missing, "stl ="), "nosuch.stl"])
        self.assertFalse(os.path.exists(self.path("r")))


# The column stands in a grid of other numbers, lengths and origins along each axis.
PLANE = replaced(COLUMN, "size = [1.0, 4.0], element = 0.5", "origin = [-0.5, 0.0], size = [2.0, 4.5], elements = [4, 3]")
PLANE = replaced(PLANE, "duration = 0.2", "duration = 0.02")
SPACE = replaced(COLUMN_IN_SPACE, "size = [1.0, 0.5, 4.0], element = 0.5",
                 "origin = [-0.5, -0.25, 0.0], size = [2.0, 1.2, 4.5], elements = [4, 2, 3]")
SPACE = replaced(SPACE, "duration = 0.2", "duration = 0.02")


def lattice(*axes):
    """Every place of these values along the axes, the first axis fastest, as points in space."""
    places = [place[::-1] for place in itertools.product(*axes[::-1])]
    return np.array([place + (0.0,) * (3 - len(axes)) for place in places])


class Meshes(Frames):
    """mesh.vtu shows the elements, and frames the points, whatever the shape functions: nodes of B-splines are control points, more than there are
    corners and elsewhere."""

    QUARTERS = 0.25 * (np.arange(12) + 0.5)  # places of points along the column

    def expect_elements(self, mesh, corners, firsts, steps, cell_type):
        """The mesh has these corners; each element those at these steps from its first one, in the order of VTK's cell type."""
        self.expect_near(mesh["Points"], corners, 1e-15)  # a rounding or two of some metres
        self.assertEqual(mesh["connectivity"].tolist(), [first + step for first in firsts for step in steps])
        self.assertEqual(mesh["offsets"].tolist(), [len(steps) * (e + 1) for e in range(len(firsts))])
        self.assertEqual(mesh["types"].tolist(), [cell_type] * len(firsts))

    def expect_points(self, frames, places, volume):
        """Points begin at these places, in this order, with this volume, and go where their displacement says."""
        first, last = frames
        self.expect_near(first["Points"], places, 1e-15)
        self.expect_near(first["volume"], volume, 1e-16)
        self.expect_near(first["displacement"], 0, 0)
        self.expect_near(last["Points"], first["Points"] + last["displacement"], 1e-15)
        self.assertGreater(np.linalg.norm(last["displacement"], axis=1).min(), 0)  # all have moved
        for frame in frames:
            count = len(places)
            self.assertEqual(frame["connectivity"].tolist(), list(range(count)))
            self.assertEqual(frame["offsets"].tolist(), list(range(1, count + 1)))
            self.assertEqual(frame["types"].tolist(), [1] * count)

    def expect_geometry(self, text, places, volume, *elements):
        """The case with each shape shows these points, and these elements as expect_elements() takes them."""
        self.write("case.toml", text)
        corners, firsts = elements[:2]
        for shape in ("linear", "gimp", "b-spline"):
            with self.subTest(shape=shape):
                self.scarp("run", "case.toml", "--quiet", "--out", shape, "--set", f"method.shape={shape}")
                self.expect_elements(vtu.read_vtu(self.path(shape, "mesh.vtu")), *elements)
                self.expect_points(self.frames(shape), places, volume)
                # ParaView sizes its arrays by the heads; the reader here does not look at them.
                for name, points, cells in (("mesh", len(corners), len(firsts)), ("points_00000", len(places), len(places))):
                    self.assertIn(f'<Piece NumberOfPoints="{points}" NumberOfCells="{cells}">'.encode(),
                                  read(self.path(shape, name + ".vtu")))

    def test_a_plane_grid_with_every_shape(self):
        self.expect_geometry(PLANE, lattice(self.QUARTERS[:4], self.QUARTERS), 0.25**2,
                             lattice(np.linspace(-0.5, 1.5, 5), np.linspace(0, 4.5, 4)),
                             [x + 5 * y for y in range(3) for x in range(4)], [0, 1, 6, 5], 9)

    def test_a_grid_in_space_with_every_shape(self):
        layers = lattice(self.QUARTERS[:4], self.QUARTERS, self.QUARTERS[:2])[:, [0, 2, 1]]  # of the polygon, along y
        self.expect_geometry(SPACE, layers, 0.25**3,
                             lattice(np.linspace(-0.5, 1.5, 5), np.linspace(-0.25, 0.95, 3), np.linspace(0, 4.5, 4)),
                             [x + 5 * (y + 3 * z) for z in range(3) for y in range(2) for x in range(4)],
                             [0, 1, 6, 5, 15, 16, 21, 20], 12)


if __name__ == "__main__":
    cases.main()
