// Elastic energy that the stress of points stands for.
#pragma once

#include "scarp/points/lanes.hpp"
#include "scarp/points/points.hpp"

namespace scarp::exec {

/// Σ Ω_p ½ σ : C⁻¹ : σ over some points of a block [kJ], with the isotropic moduli that their law has at their present
/// stress: those of its stiffness to compression waves and its Poisson's ratio. Zero of laws that declare none (umat).
template <int Dim>
double elastic_energy(const Block<Dim>& block, PointRange range);

}  // namespace scarp::exec
