// What a change of element does to the stored energy. The weight w = V / Σ Ω_p of a full element is that of its points
// (transfer/quadrature.hpp): where one leaves, the elements that it leaves and enters weight the stored energy of all
// their points anew,
//     Σ ½ Σ_p Δ(w_p Ω_p) σ_p : C⁻¹ : σ_p,
// and so do elements around one that gets its first point or loses its last. No force works in this, and no sum of work
// has it: it is energy that comes from nowhere. docs/theory.md, "Energy ledger".
#pragma once

#include "scarp/step/step.hpp"

namespace scarp::step {

/// Notes the elements whose quadrature will change, after points have got new elements and before they are in their
/// order.
template <int Dim>
void find_changed_elements(Body<Dim>& body, VelocityField<Dim>& field);

/// Books the energy stored in these elements, by the quadrature of the points that are in them by the present order:
/// with the sign −1 before points are in their new order, and 1 after that.
template <int Dim>
void record_energy_of_changed_elements(const Body<Dim>& body, VelocityField<Dim>& field, const StepSettings& settings,
                                       double sign);

}  // namespace scarp::step
