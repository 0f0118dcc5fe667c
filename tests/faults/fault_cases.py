"""The cases of faults.py: small slopes and blocks of every model, scheme and kind of mesh that reach all that a checkpoint keeps."""

ELASTIC = {"E": 2e4, "nu": 0.3}
CLAY = {"kappa": 0.02, "lambda": 0.12, "nu": 0.3, "p_e": 5.0, "M": 1.0}
STRUCTURED = CLAY | {"M_c": 1.3, "k": 0.78, "alpha": 1.0, "xi": 0.01, "c_R": 60.0, "c_beta": 5.0, "c_b": 20.0, "R_bf": 1.0, "c_a": 3.0,
                     "p_atm": 101.325}
BONDED = "{ R_b = 3.0, OCR = 1.3, a = 0.5, beta = \"isotropic\" }"
# model: (constants, what the region says besides)
MODELS = {
    "linear-elastic": (ELASTIC, ""),
    "neo-hookean": (ELASTIC, ""),
    "von-mises": (ELASTIC | {"s_u": 24.0, "s_u_residual": 8.0, "epsp_residual": 0.1}, ""),
    "tresca": (ELASTIC | {"s_u": 24.0}, ""),
    "mohr-coulomb": (ELASTIC | {"c": 3.0, "phi": 25.0, "psi": 3.0, "c_residual": 1.0, "epsp_residual": 0.1}, ""),
    "drucker-prager": (ELASTIC | {"c": 3.0, "phi": 25.0, "psi": 3.0}, ""),
    "modified-cam-clay": (CLAY | {"p_atm": 101.325}, "initial = { OCR = 1.2 }"),
    "subloading": (STRUCTURED, f"initial = {BONDED}"),
    "viscoplastic-subloading": (STRUCTURED | {"mu": 10.0, "n": 10.0, "R_m": 1.5}, f"initial = {BONDED}"),
}


def material(model, more=""):
    constants = "\n".join(f"{key} = {value}" for key, value in MODELS[model][0].items())
    return f'[[material]]\nname = "soil"\nmodel = "{model}"\ndensity = 1.8\n{constants}\n{more}\n'


def umat(library):
    return (f'[[material]]\nname = "soil"\nmodel = "umat"\ndensity = 1.8\nlibrary = "{library}"\nconstants = [2e4, 0.3, 60.0, 500.0]\n'
            'state = [{ name = "back", kind = "tensor" }, { name = "epsp", kind = "strain" }, { name = "epsp_eq", kind = "scalar" }]\n')


PLANE = """title = "a slope that is cut"

[mesh]
grid = { size = [16.0, 8.0], element = 1.0 }

%(method)s
%(material)s
[[region]]
name = "slope"
material = "soil"
polygon = [[0.0, 0.0], [16.0, 0.0], [16.0, 2.0], [10.0, 2.0], [6.0, 6.0], [0.0, 6.0]]
spacing = 0.5
K0 = 0.6
%(initial)s

[[boundary]]
nodes = "bottom"
fix = ["x", "y"]
%(sides)s
[[boundary]]
nodes = "left"
fix = ["x"]
%(sides)s
[[boundary]]
nodes = "right"
fix = ["x"]
%(right)s
[[stage]]
name = "settle"
duration = 0.3
damping = 0.7
%(settle)s

[[stage]]
name = "cut"
duration = 0.5
zero_displacement = true
remove = { polygon = [[7.0, 2.0], [17.0, 2.0], [17.0, 7.0], [7.0, 7.0]], lifts = 3, over = 0.2 }

[output]
every = 0.11
history = 0.013
"""

SPACE = """title = "a bank that is cut"
dimension = 3

[mesh]
grid = { size = [8.0, 2.0, 6.0], element = 1.0 }

%(method)s
%(material)s
[[region]]
name = "bank"
material = "soil"
polygon = [[0.0, 0.0], [8.0, 0.0], [8.0, 1.0], [5.0, 4.0], [0.0, 4.0]]
y = [0.0, 2.0]
spacing = 0.5
K0 = 0.6
%(initial)s

[[boundary]]
nodes = "bottom"
fix = ["x", "y", "z"]

[[boundary]]
nodes = "left"
fix = ["x"]

[[boundary]]
nodes = "right"
fix = ["x"]

[[boundary]]
nodes = "front"
fix = ["y"]

[[boundary]]
nodes = "back"
fix = ["y"]

[[stage]]
name = "settle"
duration = 0.1
damping = 0.7

[[stage]]
name = "cut"
duration = 0.2
zero_velocity = true
remove = { box = [[4.0, 0.0, 1.0], [9.0, 3.0, 5.0]] }

[output]
every = 0.04
history = 0.007
"""


def plane(model="subloading", method="", more="", **parts):
    fill = {"method": method, "material": material(model, more), "initial": MODELS[model][1], "sides": "", "right": "friction = 0.2", "settle": ""}
    return PLANE % (fill | parts)


def space(model="subloading", method="", **parts):
    return SPACE % ({"method": method, "material": material(model), "initial": MODELS[model][1]} | parts)


def triangles(file):
    """The text of a mesh of Gmsh 2.2 over [0, 16] x [0, 8], split squares of one metre, with sides named."""
    nx, ny = 16, 8
    node = lambda i, j: j * (nx + 1) + i + 1
    nodes = [f"{node(i, j)} {i} {j} 0" for j in range(ny + 1) for i in range(nx + 1)]
    elements, sides = [], {1: [(node(i, 0), node(i + 1, 0)) for i in range(nx)], 2: [(node(0, j), node(0, j + 1)) for j in range(ny)],
                           3: [(node(nx, j), node(nx, j + 1)) for j in range(ny)]}
    for tag, lines in sides.items():
        elements += [f"1 2 {tag} {tag} {a} {b}" for a, b in lines]
    for j in range(ny):
        for i in range(nx):
            a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
            elements += [f"2 2 4 4 {a} {b} {c}", f"2 2 4 4 {a} {c} {d}"]
    numbered = [f"{k} {text}" for k, text in enumerate(elements, 1)]
    names = ['1 1 "bottom"', '1 2 "left"', '1 3 "right"', '2 4 "ground"']
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames", "$Nodes",
                      str(len(nodes)), *nodes, "$EndNodes", "$Elements", str(len(numbered)), *numbered, "$EndElements", ""])


def cases(umat_library=None):
    """{name: text of the case}; those on triangles need triangles.msh beside them."""
    on_triangles = 'file = "triangles.msh"'
    all_cases = {f"plane-{model}": plane(model) for model in MODELS} | {f"space-{model}": space(model) for model in MODELS}
    absorbing = 'absorbing = true\nfrom = "cut"\n'
    more = {
        "report": plane(method='[method]\nscheme = "report"\nflip = 0.95\nleaving = "remove"\n'),
        "apic": plane("mohr-coulomb", method='[method]\nscheme = "apic"\n'),
        "b-spline": plane(method='[method]\nshape = "b-spline"\n'),
        "gimp": plane("modified-cam-clay", method='[method]\nshape = "gimp"\n'),
        "axisymmetric": "axisymmetric = true\n" + plane("mohr-coulomb"),
        "length": plane("mohr-coulomb", more="length = 2.5"),
        "absorbing": plane(sides=absorbing, right=absorbing),
        "release": plane("drucker-prager", settle="release = 0.2\nrest = { required = false, unbalanced = 0.5, kinetic = 1e-3, rate = 1.0 }"),
        "triangles": plane().replace("grid = { size = [16.0, 8.0], element = 1.0 }", on_triangles),
        "triangles-length": plane("von-mises", more="length = 3.0").replace("grid = { size = [16.0, 8.0], element = 1.0 }", on_triangles),
        "space-b-spline": space(method='[method]\nshape = "b-spline"\n'),
        "space-report": space("mohr-coulomb", method='[method]\nscheme = "report"\nleaving = "remove"\n'),
    }
    if umat_library:
        more["umat"] = plane(material=umat(umat_library), initial="")
        more["space-umat"] = space(material=umat(umat_library), initial="")
    return all_cases | more
