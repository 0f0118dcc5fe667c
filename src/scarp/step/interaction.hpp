// What fields of velocity do to each other at the nodes that they share: contact, or the drag of water in soil.
#pragma once

#include <type_traits>

#include "scarp/base/vec.hpp"
#include "scarp/step/forward.hpp"

namespace scarp {

/// Between two or more fields of a body. Momentum that one of them loses the others must get. What is pushed is part of
/// a, so that in a scheme of two terms nodes and points move with P of it, and it works on P ½ (v^t + v^{t+dt}) dt:
/// what is to take energy from any motion must be formed with that in mind.
template <int Dim>
class Interaction {
 public:
  virtual ~Interaction() = default;

  /// Step 3, end: nodes have their mass, velocity v^t and acceleration by eq. 5 and the conditions; what acts between
  /// fields is added by push().
  virtual void act(Body<Dim>& body, double dt, const StepSettings& settings) const = 0;
};

namespace step {

/// Adds the force F [kN] of other fields to active node k of a field; its work is booked as Energies::work_interaction.
/// What the conditions hold is not moved by it.
template <int Dim>
void push(VelocityField<Dim>& field, int k, const std::type_identity_t<Vec<Dim>>& F, double dt,
          const StepSettings& settings);

/// v^{t+dt} of active node k, as acceleration and conditions have it so far.
template <int Dim>
Vec<Dim> coming_velocity(const VelocityField<Dim>& field, int k, const StepSettings& settings);

}  // namespace step
}  // namespace scarp
