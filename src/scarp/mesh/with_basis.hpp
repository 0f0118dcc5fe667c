// From the mesh to the basis of its elements, as a type.
#pragma once

#include "scarp/mesh/axisymmetric.hpp"
#include "scarp/mesh/basis.hpp"

namespace scarp {
namespace detail {

template <int Dim, class F>
inline void with_flat_basis(const Mesh<Dim>& mesh, const int* elements, int first, int last, F&& f) {
  if (mesh.grid) {
    for (int slot = first; slot < last; ++slot) f(GridLinear<Dim>{}, slot, elements[slot]);
    return;
  }
  for (int slot = first; slot < last; ++slot) {
    const int e = elements[slot];
    with_shape<Dim>(mesh.types[e], [&]<class Shape>(Shape) { f(Linear<Shape>{}, slot, e); });
  }
}

}  // namespace detail

/// f(basis, slot, element) for slots first ... last - 1 of a list of elements.
template <int Dim, class F>
inline void with_basis(const Mesh<Dim>& mesh, const int* elements, int first, int last, F&& f) {
  if constexpr (Dim == 2) {
    if (mesh.axisymmetric) {
      detail::with_flat_basis(mesh, elements, first, last,
                              [&]<class Plane>(Plane, int slot, int e) { f(Axisymmetric<Plane>{}, slot, e); });
      return;
    }
  }
  detail::with_flat_basis(mesh, elements, first, last, f);
}

}  // namespace scarp
