// Whether what a step leaves is still the motion of soil. The step's own sums say so as a rule, at no cost: what is not
// finite at a point makes them so, too. Where they give cause, and now and then, all points are looked at.
#pragma once

#include "scarp/step/body.hpp"
#include "scarp/step/totals.hpp"

namespace scarp::step {

/// A point has between a thousandth and a million times the volume that it started with. (Single grains of soil that
/// has opened may well be stretched a thousand times: their law knows that they are, and forgets nothing.)
inline constexpr double least_stretch = 1e-3, most_stretch = 1e6;
/// Steps from one look at all points to the next.
inline constexpr int look_every = 256;

/// Looks at the body after a step of dt [s], which did `totals`. Throws RunError for the first point by region and id
///  - at which an array of the points, or of the state of their law, is not finite: at once where that reaches a sum
///    over the body (position, velocity, mass, volume, stress that nodes feel) or fails its stress update, else with
///    the next look;
///  - whose volume is not positive: at once; or not within its bounds: with the next look;
///  - that crosses more than an element in the step, |v| dt > h, the least height of its element: at once.
template <int Dim>
void refuse_nonsense(Body<Dim>& body, double dt, const StepTotals<Dim>& totals);

/// Throws RunError for the first of the points that have left the mesh which is nowhere: it is not to be taken out.
template <int Dim>
void refuse_nowhere(const VelocityField<Dim>& field);

}  // namespace scarp::step
