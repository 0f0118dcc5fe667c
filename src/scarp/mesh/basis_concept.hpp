// What a basis must have (mesh/basis.hpp says what each is), as concepts: one that lacks a function is told which, in
// one line, where the bases are listed (mesh/with_basis.hpp).
#pragma once

#include <array>
#include <concepts>
#include <utility>

#include "scarp/mesh/basis.hpp"

namespace scarp {
namespace basis {

template <class B>
using Cell = typename B::Cell;
template <class B>
using Place = Vec<B::dim>;
template <class B>
using Values = std::array<double, B::nodes>;
template <class B>
using Gradients = std::array<Vec<B::dim>, B::nodes>;

template <class B>
concept HasNumbers = requires {
  { B::dim } -> std::convertible_to<int>;
  { B::nodes } -> std::convertible_to<int>;
  { B::sides } -> std::convertible_to<int>;
};
template <class B>
concept SaysOfItself = requires {
  { B::stores_local } -> std::convertible_to<bool>;
  { B::has_domains } -> std::convertible_to<bool>;
  { B::corrects } -> std::convertible_to<bool>;
};
template <class B>
concept HasCell = std::constructible_from < Cell<B>,
const Mesh<B::dim>&, int > ;

template <class B>
concept HasLocal = requires(const Cell<B>& cell, const Place<B>& x) {
  { cell.local(x) } -> std::same_as<Place<B>>;
};
template <class B>
concept HasLocalOfDomain = requires(const Cell<B>& cell, const Place<B>& x) {
  cell.local(x, 0.5);
};
template <class B>
concept HasFollow = requires(const Cell<B>& cell, const Place<B>& x, Place<B>& xi) {
  {
    cell.follow(x, xi, [](bool) { return true; })
    } -> std::same_as<bool>;
};
/// Whichever of these its points need.
template <class B>
concept FindsPoints = (B::stores_local && HasFollow<B>) ||
                      (!B::stores_local && HasLocal<B> && (!B::has_domains || HasLocalOfDomain<B>));

/// What shape() and gradients() take.
template <class B>
auto local_of(const Cell<B>& cell, const Place<B>& x) {
  if constexpr (B::has_domains) {
    return cell.local(x, 0.5);
  } else {
    return x;
  }
}
template <class B>
using Local = decltype(local_of<B>(std::declval<const Cell<B>&>(), std::declval<Place<B>>()));

template <class B>
concept HasInside = requires(const Cell<B>& cell, const Place<B>& xi, const std::array<double, B::sides>& each) {
  { cell.inside(xi, 0.0) } -> std::same_as<bool>;
  { cell.inside(xi, each) } -> std::same_as<bool>;
};
template <class B>
concept HasShape = requires(const Cell<B>& cell, const Local<B>& at, Values<B>& N) {
  cell.shape(at, N);
};
template <class B>
concept HasGradients = requires(const Cell<B>& cell, const Local<B>& at, Values<B>& N, Gradients<B>& g) {
  cell.gradients(at, N, g);
};
template <class B>
concept HasIntegrals = !B::corrects || requires(const Cell<B>& cell, double& V, Gradients<B>& g, Values<B>& h) {
  requires is_axisymmetric<B> || requires {
    cell.integrals(V, g);
  };
  requires !is_axisymmetric<B> || requires {
    cell.integrals(V, g, h);
  };
};
template <class B>
concept HasGauss = !B::corrects || requires(const Cell<B>& cell) {
  cell.for_gauss([](const Place<B>&, double) {});
};

/// Names what B lacks.
template <class B>
constexpr bool is_complete() {
  static_assert(HasNumbers<B>, "a basis needs dim, nodes and sides");
  static_assert(SaysOfItself<B>, "a basis says of itself stores_local, has_domains and corrects");
  static_assert(HasCell<B>, "a basis needs Cell(mesh, e): what it knows of element e");
  static_assert(FindsPoints<B>,
                "a basis needs follow(x, xi, wanted) where points store local coordinates, else local(x), and local(x, "
                "half) where they have domains");
  static_assert(HasInside<B>, "a basis needs inside(local, tolerance), of one tolerance and of one for each side");
  static_assert(HasShape<B>, "a basis needs shape(local, N): N_i");
  static_assert(HasGradients<B>, "a basis needs gradients(local, N, B): N_i and dN_i/dx");
  static_assert(HasIntegrals<B>, "a basis that is corrected needs integrals(V, g): its volume and the integral of B_i");
  static_assert(HasGauss<B>, "a basis that is corrected needs for_gauss(f)");
  return true;
}

}  // namespace basis

/// Functions that carry fields from the nodes to the points of an element and back.
template <class B>
concept Basis = basis::HasNumbers<B> && basis::SaysOfItself<B> && basis::HasCell<B> && basis::FindsPoints<B> &&
    basis::HasInside<B> && basis::HasShape<B> && basis::HasGradients<B> && basis::HasIntegrals<B> && basis::HasGauss<B>;

}  // namespace scarp
