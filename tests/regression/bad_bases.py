"""Good files that the table of bad cases spoils, and how the program is called on them."""

from cases import COLUMN, COLUMN_IN_SPACE, LAB, SLOPE, replaced

GRID = "grid = { size = [1.0, 4.0], element = 0.5 }"
POLYGON = "polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0], [0.0, 3.0]]"
ON_MESH = replaced(COLUMN, GRID, 'file = "mesh.msh"')
IN_HILL = replaced(COLUMN_IN_SPACE, POLYGON + "\ny = [0.0, 0.5]", 'stl = "hill.stl"')
GMSH_2 = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
3 1 4 0
4 0 4 0
$EndNodes
$Elements
1
1 3 2 0 1 1 2 3 4
$EndElements
"""
GMSH_4 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$Nodes
1 4 1 4
2 1 0 4
1
2
3
4
0 0 0
1 0 0
1 4 0
0 4 0
$EndNodes
$Elements
1 1 1 1
2 1 3 1
1 1 2 3 4
$EndElements
"""
STL = "solid hill\n" + "".join(
    " facet normal 0 0 0\n  outer loop\n" + "".join(f"   vertex {corner}\n" for corner in triangle) + "  endloop\n endfacet\n"
    for triangle in (("0 0 0", "0 0.5 0", "1 0 0"), ("0 0 0", "1 0 0", "0 0 1"), ("0 0 0", "0 0 1", "0 0.5 0"), ("1 0 0", "0 0.5 0", "0 0 1"))
) + "endsolid hill\n"
STRAINS = LAB[: LAB.index("[[stage]]")] + '[[stage]]\ntype = "strain-path"\nfile = "strains.csv"\n'

# name: (file that is spoilt, its good text, command, other files)
BASES = {
    "column": ("bad.toml", COLUMN, ["check", "bad.toml"], {}),
    "space": ("bad.toml", COLUMN_IN_SPACE, ["check", "bad.toml"], {}),
    "slope": ("bad.toml", SLOPE, ["check", "bad.toml"], {}),
    "lab": ("bad.toml", LAB, ["lab", "bad.toml"], {}),
    "gmsh2": ("mesh.msh", GMSH_2, ["check", "case.toml"], {"case.toml": ON_MESH}),
    "gmsh4": ("mesh.msh", GMSH_4, ["check", "case.toml"], {"case.toml": ON_MESH}),
    "stl": ("hill.stl", STL, ["check", "case.toml"], {"case.toml": IN_HILL}),
    "csv": ("strains.csv", "", ["lab", "test.toml"], {"test.toml": STRAINS}),
    "set": ("case.toml", COLUMN, ["check", "case.toml", "--set"], {}),
}


def spoilt(base, old, new):
    """(files, words of the command line, what a message begins with) for a row; @ in `new` is the place of the fault."""
    name, good, words, files = BASES[base]
    if base == "set":
        return {name: good}, [*words, new], f"--set {new}: "
    text = replaced(good, old, new) if old else new
    place = name
    if "@" in text:
        before, after = text.split("@")
        text = before + after
        place += f":{before.count(chr(10)) + 1}"
        if name in ("bad.toml", "strains.csv"):
            place += f":{len(before) - (before.rfind(chr(10)) + 1) + 1}"
    return {**files, name: text}, words, place + ": "
