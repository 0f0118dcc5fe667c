// The imbalance with which a stage starts, held back at the nodes and let go little by little: soil that is set down in
// a state out of equilibrium otherwise falls into it, and remembers the fall.
#pragma once

#include <algorithm>
#include <vector>

#include "scarp/base/vec.hpp"
#include "scarp/step/forward.hpp"

namespace scarp {

/// The force on node n is −share r0 min(1, m / m0), with r0 the imbalance of its free components and m0 its mass where
/// the stage starts: soil that leaves the node takes its part with it.
template <int Dim>
struct Release {
  std::vector<Vec<Dim>> imbalance;  ///< of each node: r0 / m0 [m/s2]
  std::vector<double> mass;         ///< of each node: m0
  double share = 0;                 ///< of it that is still held back, 1 to 0; the arrays are empty before the first

  bool active() const { return share > 0; }
  double force(int n, int j, double m) const { return -share * imbalance[n][j] * std::min(m, mass[n]); }
};

/// Work in a step of the force that node n of mass m is still held back with, on `path`, where the components in
/// `set` do not move [kJ].
template <int Dim>
double work_of(const Release<Dim>& release, int n, double m, unsigned set, const Vec<Dim>& path) {
  double work = 0;
  for (int j = 0; j < Dim; ++j) {
    if (!(set & (1u << j))) work += release.force(n, j, m) * path[j];
  }
  return work;
}

/// Holds back all of the present imbalance: F_grav − F_int of the components that are not fixed, less what walls take
/// of it at rest.
template <int Dim>
void hold_imbalance(Body<Dim>& body, const StepSettings& settings);

}  // namespace scarp
