// From the mesh to the basis of its elements, as a type.
#pragma once

#include "scarp/mesh/axisymmetric.hpp"
#include "scarp/mesh/basis.hpp"
#include "scarp/mesh/basis_concept.hpp"
#include "scarp/mesh/grid_bases.hpp"

namespace scarp {
namespace detail {

// A basis that is added below is added here: it is told what it lacks.
template <int Dim>
constexpr bool grids_are_complete() {
  return basis::is_complete<GridLinear<Dim>>() && basis::is_complete<GridGimp<Dim>>() &&
         basis::is_complete<GridSpline<Dim>>();
}
static_assert(grids_are_complete<2>() && grids_are_complete<3>());
static_assert(basis::is_complete<Linear<T3>>() && basis::is_complete<Linear<Q4>>() &&
              basis::is_complete<Linear<T4>>() && basis::is_complete<Linear<H8>>());
static_assert(basis::is_complete<Axisymmetric<GridLinear<2>>>() && basis::is_complete<Axisymmetric<GridSpline<2>>>() &&
              basis::is_complete<Axisymmetric<Linear<T3>>>() && basis::is_complete<Axisymmetric<Linear<Q4>>>());

template <int Dim, class F>
[[gnu::always_inline]] inline void with_flat_basis(const Mesh<Dim>& mesh, const int* elements, int first, int last,
                                                   F&& f) {
  const auto all = [&](auto basis) {
    for (int slot = first; slot < last; ++slot) f(basis, slot, elements[slot]);
  };
  if (mesh.grid) {
    switch (mesh.grid->functions) {
      case GridFunctions::linear:
        return all(GridLinear<Dim>{});
      case GridFunctions::gimp:
        return all(GridGimp<Dim>{});
      case GridFunctions::b_spline:
        return all(GridSpline<Dim>{});
    }
  }
  for (int slot = first; slot < last; ++slot) {
    const int e = elements[slot];
    with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) { f(Linear<Shape>{}, slot, e); });
  }
}

}  // namespace detail

/// f(basis, slot, element) for slots first ... last - 1 of a list of elements. The choice is made once for all on a
/// grid, once per element elsewhere. Inlined, so that what f captures stays in registers. A case asks for no body of
/// revolution of points that are boxes.
template <int Dim, class F>
[[gnu::always_inline]] inline void with_basis(const Mesh<Dim>& mesh, const int* elements, int first, int last, F&& f) {
  if constexpr (Dim == 2) {
    if (mesh.axisymmetric) {
      detail::with_flat_basis(mesh, elements, first, last, [&]<class Plane>(Plane, int slot, int e) {
        if constexpr (!Plane::has_domains) f(Axisymmetric<Plane>{}, slot, e);
      });
      return;
    }
  }
  detail::with_flat_basis(mesh, elements, first, last, f);
}

}  // namespace scarp
