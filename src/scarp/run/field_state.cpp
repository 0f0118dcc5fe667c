#include "scarp/run/field_state.hpp"

#include <algorithm>

#include "scarp/base/error.hpp"

namespace scarp::run {

template <int Dim>
LeftBySteps<Dim> left_by_steps(const Body<Dim>& body, const VelocityField<Dim>& field) {
  LeftBySteps<Dim> left;
  const auto& bounds = field.buffers.bounds;
  left.element = field.active.element;
  left.weight = field.buffers.weight;
  left.least_mass = field.least_mass;
  left.averages = field.averages.steps;
  if (!bounds.least_per_mass.empty()) {
    for (const int e : left.element) left.least_per_mass.push_back(bounds.least_per_mass[e]);
  }
  left.due = bounds.due;
  left.age = bounds.age;
  const auto& [release, sides] = field.outside;
  for (int n = 0; n < static_cast<int>(release.mass.size()); ++n) {
    if (!(release.mass[n] > 0)) continue;
    left.release_node.push_back(n);
    left.imbalance.push_back(release.imbalance[n]);
    left.release_mass.push_back(release.mass[n]);
  }
  left.side_node.resize(sides.node.size());
  for (int n = 0; sides.active() && n < body.mesh->node_count(); ++n) {
    if (sides.holds(n)) left.side_node[static_cast<std::size_t>(sides.of_node[n])] = n;
  }
  for (std::size_t i = 0; i < sides.node.size(); ++i) {
    const auto& its = sides.node[i];
    left.fixed.push_back(body.conditions.fixed[left.side_node[i]]);
    left.R.push_back(its.R);
    left.C.push_back(its.C);
    left.C_soil.push_back(its.C_soil);
    left.k.push_back(its.k);
    left.u.push_back(its.u);
    left.gamma.push_back(its.gamma);
    left.side_mass.push_back(its.mass);
  }
  return left;
}

template <int Dim>
void check_left(const Loader& load, const LeftBySteps<Dim>& left, const Mesh<Dim>& mesh) {
  const auto within = [](const std::vector<int>& numbers, int count) {
    return std::all_of(numbers.begin(), numbers.end(), [count](int n) { return n >= 0 && n < count; });
  };
  const std::size_t elements = left.element.size(), held = left.release_node.size(), sides = left.side_node.size();
  const auto sides_have = [sides](const auto&... each) { return ((each.size() == sides) && ...); };
  const bool fits = within(left.element, mesh.element_count()) && within(left.due, mesh.element_count()) &&
                    within(left.release_node, mesh.node_count()) && within(left.side_node, mesh.node_count()) &&
                    left.weight.size() == elements &&
                    (left.least_per_mass.empty() || left.least_per_mass.size() == elements) &&
                    left.imbalance.size() == held && left.release_mass.size() == held &&
                    sides_have(left.fixed, left.R, left.C, left.C_soil, left.k, left.u, left.gamma, left.side_mass);
  if (!fits)
    throw InputError("what this file keeps of elements and nodes does not fit the mesh, or itself", load.file_name(),
                     "take a checkpoint of the same mesh, and let arrays of one group have one length");
}

template <int Dim>
void put_back(const LeftBySteps<Dim>& left, Body<Dim>& body, VelocityField<Dim>& field) {
  auto& bounds = field.buffers.bounds;
  field.least_mass = left.least_mass;
  field.averages.steps = left.averages;
  bounds.age = left.age;
  for (std::size_t i = 0; i < left.element.size(); ++i) {
    const int e = left.element[i], slot = field.active.slot[e];
    if (slot < 0) continue;  // its points were moved in the file
    field.buffers.weight[slot] = left.weight[i];
    if (!left.least_per_mass.empty() && !bounds.least_per_mass.empty())
      bounds.least_per_mass[e] = left.least_per_mass[i];
  }
  if (!bounds.is_due.empty() && !left.least_per_mass.empty()) {
    for (const int e : bounds.due) bounds.is_due[e] = 0;
    bounds.due = left.due;
    for (const int e : bounds.due) bounds.is_due[e] = 1;
  }
  auto& [release, sides] = field.outside;
  if (!left.release_node.empty()) {
    release.imbalance.assign(body.mesh->node_count(), {});
    release.mass.assign(body.mesh->node_count(), 0.0);
    for (std::size_t i = 0; i < left.release_node.size(); ++i) {
      release.imbalance[left.release_node[i]] = left.imbalance[i];
      release.mass[left.release_node[i]] = left.release_mass[i];
    }
  }
  if (!left.side_node.empty()) sides.of_node.resize(body.mesh->node_count());
  for (std::size_t i = 0; i < left.side_node.size(); ++i) {
    const int n = left.side_node[i];
    body.conditions.fixed[n] = left.fixed[i];
    sides.of_node.set(n, static_cast<int>(i));
    auto& its = sides.node.emplace_back();
    its.R = left.R[i];
    its.C = left.C[i];
    its.C_soil = left.C_soil[i];
    its.k = left.k[i];
    its.u = left.u[i];
    its.gamma = left.gamma[i];
    its.mass = left.side_mass[i];
  }
}

template LeftBySteps<2> left_by_steps<2>(const Body<2>&, const VelocityField<2>&);
template void check_left<2>(const Loader&, const LeftBySteps<2>&, const Mesh<2>&);
template void put_back<2>(const LeftBySteps<2>&, Body<2>&, VelocityField<2>&);
template LeftBySteps<3> left_by_steps<3>(const Body<3>&, const VelocityField<3>&);
template void check_left<3>(const Loader&, const LeftBySteps<3>&, const Mesh<3>&);
template void put_back<3>(const LeftBySteps<3>&, Body<3>&, VelocityField<3>&);

}  // namespace scarp::run
