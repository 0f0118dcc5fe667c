#include "scarp/boundary/conditions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

#include "scarp/base/error.hpp"

namespace scarp {

template <int Dim>
void fix(Conditions<Dim>& conditions, std::span<const int> nodes, int component) {
  for (const int n : nodes) conditions.fixed[n] = static_cast<std::uint8_t>(conditions.fixed[n] | (1u << component));
}

template <int Dim>
void wall(Conditions<Dim>& conditions, const Mesh<Dim>& mesh, std::span<const int> nodes, int component,
          double friction) {
  std::vector<char> chosen(mesh.node_count(), 0), below(mesh.node_count(), 0), above(mesh.node_count(), 0);
  for (const int n : nodes) chosen[n] = 1;
  for (int e = 0; e < mesh.element_count(); ++e) {
    double centre = 0;
    const auto local = mesh.element_nodes(e);
    for (const int n : local) centre += mesh.nodes[n][component] / static_cast<double>(local.size());
    for (const int n : local) {
      if (chosen[n]) (centre > mesh.nodes[n][component] ? above : below)[n] = 1;
    }
  }
  for (const int n : nodes) {
    if (above[n] && below[n]) {
      throw InputError("a wall with friction lies on the boundary of the mesh, with the mesh on one side",
                       fmt::format("the node at ({:g}) with elements on both sides", fmt::join(mesh.nodes[n], ", ")),
                       "name nodes of one side of the mesh, or leave friction out");
    }
    conditions.normal[n] = static_cast<std::int8_t>(component);
    conditions.inward[n] = above[n] ? 1.0 : -1.0;
    conditions.friction[n] = friction;
  }
}

namespace {

/// Coulomb friction of a wall that takes the acceleration `pushed` along its normal.
template <int Dim>
void resist_sliding(int normal, double limit, double m, const Vec<Dim>& v, double dt, Vec<Dim>& a,
                    Reaction<Dim>& reaction) {
  double slip2 = 0;  // velocity along the wall if nothing held it
  for (int j = 0; j < Dim; ++j) {
    if (j != normal) slip2 += (v[j] + a[j] * dt) * (v[j] + a[j] * dt);
  }
  const double slip = std::sqrt(slip2);
  const bool sticks = limit * dt >= slip;
  const double share = sticks ? 1.0 : limit * dt / slip;
  for (int j = 0; j < Dim; ++j) {
    if (j == normal) continue;
    const double change = -share * (v[j] + a[j] * dt) / dt;
    a[j] += change;
    reaction.friction[j] = m * change;
    if (sticks) reaction.held = static_cast<std::uint8_t>(reaction.held | (1u << j));
  }
}

}  // namespace

template <int Dim>
Reaction<Dim> constrain_acceleration(const Conditions<Dim>& conditions, int n, double m, const Vec<Dim>& v, double dt,
                                     Vec<Dim>& a) {
  Reaction<Dim> reaction;
  const int normal = conditions.normal[n];
  if (normal >= 0) {
    const double pushed = -conditions.inward[n] * a[normal];  // acceleration into the wall that it has to take
    if (pushed > 0) {
      a[normal] = 0;
      reaction.held = static_cast<std::uint8_t>(1u << normal);
      resist_sliding<Dim>(normal, conditions.friction[n] * pushed, m, v, dt, a, reaction);
    }
  }
  for (int j = 0; j < Dim; ++j) {
    if (!(conditions.fixed[n] & (1u << j))) continue;
    a[j] = 0;
    reaction.friction[j] = 0;
    reaction.held = static_cast<std::uint8_t>(reaction.held | (1u << j));
  }
  return reaction;
}

template <int Dim>
void constrain_velocity(const Conditions<Dim>& conditions, int n, std::uint8_t held, Vec<Dim>& v) {
  const int normal = conditions.normal[n];
  if (normal >= 0 && conditions.inward[n] * v[normal] < 0) v[normal] = 0;
  for (int j = 0; j < Dim; ++j) {
    if (held & (1u << j)) v[j] = 0;
  }
}

template void fix<2>(Conditions<2>&, std::span<const int>, int);
template void fix<3>(Conditions<3>&, std::span<const int>, int);
template void wall<2>(Conditions<2>&, const Mesh<2>&, std::span<const int>, int, double);
template void wall<3>(Conditions<3>&, const Mesh<3>&, std::span<const int>, int, double);
template Reaction<2> constrain_acceleration<2>(const Conditions<2>&, int, double, const Vec<2>&, double, Vec<2>&);
template Reaction<3> constrain_acceleration<3>(const Conditions<3>&, int, double, const Vec<3>&, double, Vec<3>&);
template void constrain_velocity<2>(const Conditions<2>&, int, std::uint8_t, Vec<2>&);
template void constrain_velocity<3>(const Conditions<3>&, int, std::uint8_t, Vec<3>&);

}  // namespace scarp
