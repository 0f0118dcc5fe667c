// What a step leaves at elements and nodes for the next one, in a checkpoint. For body_state.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/run/archive.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// Of one field, at the elements and nodes that it concerns.
template <int Dim>
struct LeftBySteps {
  std::vector<int> element, due;
  Column weight, least_per_mass;
  int age = 0, averages = 0;
  double least_mass = 0;
  std::vector<int> release_node;
  std::vector<Vec<Dim>> imbalance;
  Column release_mass;
  std::vector<int> side_node;
  std::vector<std::uint8_t> fixed;
  std::vector<Vec<Dim>> R, C, C_soil, k, u, gamma;
  Column side_mass;

  template <class Self, class F>
  static void each_saved(Self& l, F&& f) {
    f(Entry{"least_mass", "Mg", "nodes with less are left out"}, l.least_mass);
    f(Entry{"averages", "", "steps since the last average over lengths"}, l.averages);
    const auto elements = f.within("elements");
    elements(Entry{"element", "", "numbers of the elements that hold points"}, l.element);
    elements(Entry{"weight", "", "w of their quadrature in the last step"}, l.weight);
    elements(
        Entry{"least_per_mass", "1/s2", "what nodes say of the time step, where there are triangles or tetrahedra"},
        l.least_per_mass);
    elements(Entry{"due", "", "elements of which that is to be found in the next step"}, l.due);
    elements(Entry{"age", "", "steps since it was found for all"}, l.age);
    const auto release = f.within("release");
    release(Entry{"node", "", "nodes at which the imbalance at the start of the stage is held back"}, l.release_node);
    release(Entry{"imbalance", "m/s2", "force held back at full share, over the mass"}, l.imbalance);
    release(Entry{"mass", "Mg", "of the nodes then"}, l.release_mass);
    const auto sides = f.within("sides");
    sides(Entry{"node", "", "nodes of absorbing sides"}, l.side_node);
    sides(Entry{"fixed", "", "bit j set where component j is held all the same"}, l.fixed);
    sides(Entry{"R", "kN", "force with which the node was held"}, l.R);
    sides(Entry{"C", "kN s/m", "impedance of the soil beyond, times area"}, l.C);
    sides(Entry{"C_soil", "kN s/m", "of the soil in front"}, l.C_soil);
    sides(Entry{"k", "kN/m", "stiffness of the soil beyond"}, l.k);
    sides(Entry{"u", "m", "how far the node has gone"}, l.u);
    sides(Entry{"gamma", "", "share of the node's velocity with which the side goes"}, l.gamma);
    sides(Entry{"mass", "Mg", "of the node when it was let go"}, l.side_mass);
  }
};

template <int Dim>
LeftBySteps<Dim> left_by_steps(const Body<Dim>& body, const VelocityField<Dim>& field);

/// Throws InputError where numbers are none of the mesh's, or arrays that belong together have different lengths.
template <int Dim>
void check_left(const Loader& load, const LeftBySteps<Dim>& left, const Mesh<Dim>& mesh);

/// Puts it back, after reorder() has taken all elements for new ones.
template <int Dim>
void put_back(const LeftBySteps<Dim>& left, Body<Dim>& body, VelocityField<Dim>& field);

}  // namespace scarp::run
