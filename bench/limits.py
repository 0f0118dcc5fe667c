"""What the machine allows at best: the bytes that a step cannot do without, at the bandwidth of the memory, or its
operations, at the peak of the arithmetic, whichever takes longer. docs/benchmarks.md derives the counts."""

# case: (dimension, nodes of an element, columns of the law's state besides stress, local coordinates stored?, the law)
CASES = {
    "q4-elastic": (2, 4, 0, False, "linear-elastic"),
    "mesh-elastic": (2, 4, 0, True, "linear-elastic"),
    "mesh-elastic-t3": (2, 3, 0, True, "linear-elastic"),
    "bspline-elastic": (2, 9, 0, False, "linear-elastic"),
    "q4-subloading": (2, 4, 10, False, "subloading"),
    "slope-cut-failing": (2, 4, 10, True, "subloading"),
    "h8-elastic": (3, 8, 0, False, "linear-elastic"),
    "h8-subloading": (3, 8, 14, False, "subloading"),
}


def least_bytes(dim, nodes, state, stores_local, points_per_element):
    """Read and written per point and step, each once in each sweep that needs it, 8 bytes a number."""
    stress = 4 if dim == 2 else 6
    used_stress = 3 if dim == 2 else 6  # of a plane, σ_zz gives no force
    to_nodes = 2 + 2 * dim + used_stress  # read m, Ω; x, v; σ
    velocities = 1 + dim  # read m, x: momentum after the velocity update needs no v of the points
    # read m; read and write x, v, Ω, σ, ∫dε_q and the law's state; write two bytes of flags and counts
    motion = 1 + 2 * (2 * dim + 1 + stress + 1 + state)
    local = 4 * dim if stores_local else 0  # read in each sweep, written in the last
    numbers = to_nodes + velocities + motion + local
    indices = 3 * 4 + 4 + 2  # the order of the points in each sweep; their element; flags and substeps
    # A node's m, v, a and conditions: written, read, v written, read. An element's nodes: read in each sweep.
    node_share = (1.0 if nodes in (4, 8, 9) else 0.5) / points_per_element
    at_nodes = node_share * 8 * ((2 + 2 * dim) * 2 + dim * 2)
    return 8 * numbers + indices + at_nodes + 3 * 4 * nodes / points_per_element


def least_operations(dim, nodes, law):
    """Additions, multiplications, divisions and roots per point and step, `law` of them in the law; a b + c is two."""
    stress = 4 if dim == 2 else 6
    local = 2 * dim
    shape = {3: 2, 4: 6, 8: 26, 9: 2 * 8 + 9}[nodes]
    gradients = 0 if nodes == 3 else {4: 8, 8: 48, 9: 2 * 6 + 18}[nodes]
    to_nodes = local + shape + gradients + dim + stress + nodes * (2 + 2 * dim + 2 * dim * dim)
    velocities = local + shape + nodes * 2 * dim + dim + nodes * 2 * dim
    motion = local + shape + gradients + nodes * 2 * dim * dim + 2 * nodes * 2 * dim + 3 * dim + 2 * dim * dim
    volume, shear, work, speed = 4 * dim - 4, 4 * stress, 2 * stress + 2, 8 + 2 * dim
    return to_nodes + velocities + motion + volume + shear + work + speed + law


def of_case(record, machine, laws):
    """Fields of a record, from what the machine can do and the operations of the laws in each dimension: bytes and
    operations at least, the limit [ns per point and step] and how near to it the median is."""
    dim, nodes, state, stores_local, law = CASES[record["case"]]
    moved = least_bytes(dim, nodes, state, stores_local, record["points_per_element"])
    operations = least_operations(dim, nodes, laws[law][str(dim)])
    by_memory = 1e9 * moved / machine["bytes_per_second"]
    by_arithmetic = 1e9 * operations / machine["flops_per_second"]
    limit = max(by_memory, by_arithmetic)
    return {
        "least_bytes": moved,
        "least_operations": operations,
        "limit_ns": limit,
        "fraction_of_limit": limit / record["ns_per_point_step"],
    }
