#include "scarp/boundary/conditions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

#include "scarp/base/error.hpp"
#include "scarp/mesh/near.hpp"

namespace scarp {

template <int Dim>
void fix(Conditions<Dim>& conditions, std::span<const int> nodes, int component) {
  for (const int n : nodes) conditions.fixed[n] = static_cast<std::uint8_t>(conditions.fixed[n] | (1u << component));
}

template <int Dim>
void wall(Conditions<Dim>& conditions, const Mesh<Dim>& mesh, std::span<const int> nodes, int component,
          double friction) {
  const auto count = static_cast<std::size_t>(mesh.node_count());
  ZeroPages<char> chosen(count), below(count), above(count);
  for (const int n : nodes) chosen[n] = 1;
  for_elements_near(mesh, box_around(mesh, nodes), [&](int e) {
    double centre = 0;
    const auto local = mesh.element_nodes(e);
    for (const int n : local) centre += mesh.node(n)[component] / static_cast<double>(local.size());
    for (const int n : local) {
      if (chosen[n]) (centre > mesh.node(n)[component] ? above : below)[n] = 1;
    }
  });
  for (const int n : nodes) {
    if (above[n] && below[n]) {
      throw InputError("a wall with friction lies on the boundary of the mesh, with the mesh on one side",
                       fmt::format("the node at ({:g}) with elements on both sides", fmt::join(mesh.node(n), ", ")),
                       "name nodes of one side of the mesh, or leave friction out");
    }
    conditions.normal.set(n, component);
    conditions.inward[n] = above[n] ? 1.0 : -1.0;
    conditions.friction[n] = friction;
  }
}

namespace {

/// Coulomb friction up to m `limit` against the motion of the components that are not in `others`.
template <int Dim>
void resist_sliding(unsigned others, double limit, double m, const Vec<Dim>& v, double dt, Vec<Dim>& a,
                    Reaction<Dim>& reaction) {
  double slip2 = 0;  // velocity along the wall if nothing held it
  for (int j = 0; j < Dim; ++j) {
    if (!(others & (1u << j))) slip2 += (v[j] + a[j] * dt) * (v[j] + a[j] * dt);
  }
  const double slip = std::sqrt(slip2);
  const bool sticks = limit * dt >= slip;
  const double share = sticks ? 1.0 : limit * dt / slip;
  for (int j = 0; j < Dim; ++j) {
    if (others & (1u << j)) continue;
    const double change = -share * (v[j] + a[j] * dt) / dt;
    a[j] += change;
    reaction.friction[j] = m * change;
    if (sticks) reaction.held = static_cast<std::uint8_t>(reaction.held | (1u << j));
  }
}

/// The wall takes the acceleration into it, and nothing else.
template <int Dim>
void push_back(const Conditions<Dim>& conditions, int n, double m, const Vec<Dim>& v, double dt, Vec<Dim>& a,
               Reaction<Dim>& reaction) {
  const int normal = conditions.normal[n];
  const double pushed = -conditions.inward[n] * a[normal];  // acceleration into the wall that it has to take
  if (!(pushed > 0)) return;
  a[normal] = 0;
  reaction.held = static_cast<std::uint8_t>(1u << normal);
  resist_sliding<Dim>(1u << normal, conditions.friction[n] * pushed, m, v, dt, a, reaction);
}

/// W1: the motion into the wall comes to rest, and friction takes the whole of the force R that does it. What the node
/// keeps of it, m a_N = −m v_N / dt, takes energy.
template <int Dim>
void bring_to_rest(const Conditions<Dim>& conditions, int n, double m, const Vec<Dim>& v, double dt, Vec<Dim>& a,
                   Reaction<Dim>& reaction) {
  if (!reaches_wall<Dim>(conditions, n, v, dt, a)) return;
  const int normal = conditions.normal[n];
  const double old = a[normal];
  a[normal] = -v[normal] / dt;
  reaction.held = static_cast<std::uint8_t>(1u << normal);
  reaction.friction[normal] = m * a[normal];
  const double R_per_mass = conditions.inward[n] * (a[normal] - old);
  resist_sliding<Dim>((1u << normal) | conditions.fixed[n], conditions.friction[n] * R_per_mass, m, v, dt, a, reaction);
}

}  // namespace

template <int Dim>
Reaction<Dim> constrain_acceleration(const Conditions<Dim>& conditions, WallRule rule, int n, double m,
                                     const Vec<Dim>& v, double dt, Vec<Dim>& a) {
  Reaction<Dim> reaction;
  if (conditions.normal[n] >= 0) {
    const auto push = rule == WallRule::by_motion ? bring_to_rest<Dim> : push_back<Dim>;
    push(conditions, n, m, v, dt, a, reaction);
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
void constrain_velocity(const Conditions<Dim>& conditions, WallRule rule, int n, std::uint8_t held, Vec<Dim>& v) {
  const int normal = conditions.normal[n];
  const unsigned set = set_components(conditions, rule, n, held);
  if (rule == WallRule::by_acceleration && normal >= 0 && conditions.inward[n] * v[normal] < 0) v[normal] = 0;
  for (int j = 0; j < Dim; ++j) {
    if (set & (1u << j)) v[j] = 0;
  }
}

template void fix<2>(Conditions<2>&, std::span<const int>, int);
template void fix<3>(Conditions<3>&, std::span<const int>, int);
template void wall<2>(Conditions<2>&, const Mesh<2>&, std::span<const int>, int, double);
template void wall<3>(Conditions<3>&, const Mesh<3>&, std::span<const int>, int, double);
template Reaction<2> constrain_acceleration<2>(const Conditions<2>&, WallRule, int, double, const Vec<2>&, double,
                                               Vec<2>&);
template Reaction<3> constrain_acceleration<3>(const Conditions<3>&, WallRule, int, double, const Vec<3>&, double,
                                               Vec<3>&);
template void constrain_velocity<2>(const Conditions<2>&, WallRule, int, std::uint8_t, Vec<2>&);
template void constrain_velocity<3>(const Conditions<3>&, WallRule, int, std::uint8_t, Vec<3>&);

}  // namespace scarp
