// Forces from outside on the nodes of a field, besides gravity, damping and the conditions of the mesh, which all soil
// has. A new one - a traction, a spring, an earthquake's - is a member here; it enters the nodes in add_forces(), its
// work is booked in record_works(), and its energy gets a line in energies.hpp (node_forces.hpp has the rest).
#pragma once

#include "scarp/base/vec.hpp"
#include "scarp/step/energies.hpp"
#include "scarp/step/release.hpp"
#include "scarp/step/sides.hpp"

namespace scarp {

template <int Dim>
struct OutsideForces {
  Release<Dim> release;
  Sides<Dim> sides;

  bool active() const { return release.active() || sides.active(); }

  /// Adds them to the force F on node n of the mesh, where the field has mass m there [kN].
  void add_forces(int n, double m, Vec<Dim>& F) const {
    for (int j = 0; j < Dim; ++j) {
      if (sides.holds(n)) F[j] += sides.force(n, j, m);
      if (release.active()) F[j] += release.force(n, j, m);
    }
  }

  /// Books their work on node n along `path` [m], where the components in `set` do not move, and takes the sides along.
  void record_works(int n, double m, unsigned set, const Vec<Dim>& F_dashpot, const Vec<Dim>& path, Energies& totals) {
    if (release.active()) totals.work_release += work_of<Dim>(release, n, m, set, path);
    if (!sides.holds(n)) return;
    const auto work = sides.move(n, m, set, F_dashpot, path);
    totals.work_boundary += work.held;
    totals.dissipation_absorbing += work.dashpot;
    totals.stored_sides += work.spring;
  }
};

}  // namespace scarp
