"""`scarp plot` of a folder of results. Usage: pictures_test.py PROGRAM [TEST ...]"""

import os

import cases
from cases import COLUMN, ProgramTest, contents, read


class Pictures(ProgramTest):
    NAMES = ("configurations.png", "fields.png", "history.png")

    def setUp(self):
        super().setUp()
        self.write("column.toml", COLUMN)
        self.scarp("run", "column.toml", "--quiet", "--out", "r")

    def test_draws_its_pictures(self):
        self.scarp("plot", "r", "--panels", "2")
        for name in self.NAMES:
            picture = read(self.path("r", name))
            self.assertTrue(picture.startswith(b"\x89PNG\r\n\x1a\n"), name)
            self.assertGreater(len(picture), 5000, name)
        # A new run takes the old pictures away: they would show other results.
        self.scarp("run", "column.toml", "--quiet", "--out", "r")
        self.assertFalse(set(self.NAMES) & set(os.listdir(self.path("r"))))

    def test_draws_elsewhere(self):
        before = contents(self.path("r"))
        self.scarp("plot", "r", "--out", "pictures", "--times", "0.0,0.1", "--field", "velocity", "--range", "0,0.1")
        self.assertEqual(sorted(os.listdir(self.path("pictures"))), sorted(self.NAMES))
        self.expect_same(before, contents(self.path("r")))

    def test_refuses_what_is_not_there(self):
        os.mkdir(self.path("empty"))
        frame = read(self.path("r", "points_00000.vtu"))
        os.mkdir(self.path("short"))
        for name, content in contents(self.path("r")).items():
            self.write(f"short/{name}", content[: len(frame) // 2] if name.endswith(".vtu") else content)
        for words, part in [
            (["empty"], "empty holds no results of scarp: points.pvd is missing"),
            (["nosuch"], "there is no folder nosuch"),
            (["column.toml"], "there is no folder column.toml"),
            (["r", "--field", "nosuch"], "no field nosuch; they have "),
            (["short"], "cut short"),
            (["r", "--panels", "1"], "--panels is at least 2"),
            (["r", "--range", "1"], "--range takes two numbers"),
        ]:
            with self.subTest(words=words):
                done = self.scarp("plot", *words, status=2)
                self.assertIn("scarp plot: ", done.stderr)
                self.assertIn(part, done.stderr)
                self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    cases.main()
