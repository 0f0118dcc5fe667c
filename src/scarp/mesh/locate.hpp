// Finding the element of a point, the old element and its neighbours first (the report's second contribution).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/shapes.hpp"

namespace scarp {

/// Where searches ended and what they cost. Every search counts once among the first five.
struct SearchCounts {
  std::int64_t own = 0;           ///< found in the element it was in
  std::int64_t surrounding = 0;   ///< found in an element around that one
  std::int64_t walked = 0;        ///< found by walking on
  std::int64_t searched_all = 0;  ///< found only by searching all elements
  std::int64_t lost = 0;          ///< in no element
  std::int64_t elements_examined = 0;
  std::int64_t most_examined = 0;  ///< by a single search

  std::int64_t searches() const { return own + surrounding + walked + searched_all + lost; }

  SearchCounts& operator+=(const SearchCounts& other) {
    own += other.own;
    surrounding += other.surrounding;
    walked += other.walked;
    searched_all += other.searched_all;
    lost += other.lost;
    elements_examined += other.elements_examined;
    most_examined = std::max(most_examined, other.most_examined);
    return *this;
  }

  /// f({key, unit, meaning}, member) for each (run/archive.hpp).
  template <class Entry, class Self, class F>
  static void each_saved(Self& s, F&& f) {
    f(Entry{"own", "", "points found in the element they were in"}, s.own);
    f(Entry{"surrounding", "", "points found in an element around that one"}, s.surrounding);
    f(Entry{"walked", "", "points found by walking on"}, s.walked);
    f(Entry{"searched_all", "", "points found by searching all elements"}, s.searched_all);
    f(Entry{"lost", "", "points in no element"}, s.lost);
    f(Entry{"elements_examined", "", "by all searches"}, s.elements_examined);
    f(Entry{"most_examined", "", "by a single search"}, s.most_examined);
  }

  /// Counts one search that ended as `how` (a member above) after `steps` elements.
  void add(std::int64_t SearchCounts::*how, int steps) {
    ++(this->*how);
    elements_examined += steps;
    most_examined = std::max<std::int64_t>(most_examined, steps);
  }
};

/// The place of a point in the mesh.
template <int Dim>
struct Location {
  int element = -1;  ///< -1: outside the mesh
  Vec<Dim> xi{};     ///< local coordinates in that element
  int steps = 0;     ///< elements examined to find it
};

/// Finds the element of a point. Holds a reference to the mesh, which must outlive it and stay as it is. All searches
/// are const and without scratch, so any number of threads may share one Locator, each with its own SearchCounts.
///
/// A point outside an element by less than `tolerance()` of the element's height counts as inside. A point on a
/// shared edge or face stays in its element (the hint) when that contains it; otherwise it goes to the lowest element
/// index of those that contain it, so the answer does not depend on the way there.
template <int Dim>
class Locator {
 public:
  explicit Locator(const Mesh<Dim>& mesh);
  explicit Locator(Mesh<Dim>&&) = delete;

  /// A walk gives up after this many elements, some ten element widths beyond the old neighbourhood in the plane and
  /// three or more in space.
  static constexpr int walk_limit = Dim == 2 ? 128 : 512;

  /// The element of x: `hint` (its last element, or -1 when there is none) first, then the elements around it in
  /// ascending order, then a walk from the nearest of these, and only then all elements. On a structured grid
  /// the element follows directly from x, and is counted as what it is to the hint.
  Location<Dim> find(const Vec<Dim>& x, int hint, SearchCounts& counts) const {
    if (mesh_->grid) return find_in_grid(x, hint, counts);
    if (hint >= 0) [[likely]] {
      Location<Dim> own{hint, {}, 1};
      if (examine(hint, x, own.xi) <= tolerance_) [[likely]] {
        counts.add(&SearchCounts::own, 1);
        return own;
      }
    }
    return find_beyond(x, hint, counts);
  }

  /// The element of a point that has no last element.
  Location<Dim> find_anywhere(const Vec<Dim>& x) const {
    SearchCounts not_asked;
    return find(x, -1, not_asked);
  }

  /// The elements that x lies in or at the side of, ascending, where e is one of them.
  std::vector<int> elements_at(const Vec<Dim>& x, int e) const;

  /// Does the mesh end at that side of an element? Sides as a basis counts them (mesh/basis.hpp).
  bool ends_at(int e, int side) const {
    if (!mesh_->grid) return (outer_[e] >> side & 1u) != 0;
    const int d = side / 2, at = mesh_->grid->cell(e)[d];
    return side % 2 == 0 ? at == 0 : at + 1 == mesh_->grid->elements[d];
  }

  /// As a part of an element's height: 1e-10, or more where the coordinates' own round-off is larger than that.
  double tolerance() const { return tolerance_; }

 private:
  /// Is x in a cell of the grid, or beyond it by no more than the tolerance?
  bool cell_holds(int e, const Vec<Dim>& x) const {
    const auto at = mesh_->grid->cell(e);
    bool holds = true;
    for (int k = 0; k < Dim; ++k) {
      const double s = (x[k] - mesh_->grid->origin[k]) * inverse_spacing_[k] - at[k];
      holds = holds && s >= -tolerance_ && s <= 1 + tolerance_;
    }
    return holds;
  }

  /// How far x is beyond element e's boundary (NaN when x is), and its local coordinates there.
  double examine(int e, const Vec<Dim>& x, Vec<Dim>& xi) const {
    return with_shape<Dim>(mesh_->type_of(e), [&]<class Shape>(Shape) {
      xi = Shape::local_coordinates(node_positions<Shape>(*mesh_, e), x);
      return Shape::beyond(xi);
    });
  }

  Location<Dim> find_in_grid(const Vec<Dim>& x, int hint, SearchCounts& counts) const {
    const Grid<Dim>& grid = *mesh_->grid;
    Vec<Dim> s;  // position in elements from the origin
    for (int k = 0; k < Dim; ++k) s[k] = (x[k] - grid.origin[k]) * inverse_spacing_[k];
    if (hint >= 0) {
      const std::array<int, Dim> own = grid.cell(hint);
      bool same = true;
      for (int k = 0; k < Dim; ++k) same = same && s[k] >= own[k] - tolerance_ && s[k] <= own[k] + 1 + tolerance_;
      if (same) [[likely]] {
        counts.add(&SearchCounts::own, 1);
        return place(hint, own, s, 1);
      }
    }
    return find_in_other_cell(s, hint, counts);
  }

  static Location<Dim> place(int e, const std::array<int, Dim>& index, const Vec<Dim>& s, int steps) {
    Location<Dim> at{e, {}, steps};
    for (int k = 0; k < Dim; ++k) at.xi[k] = 2 * (s[k] - index[k]) - 1;
    return at;
  }

  Location<Dim> find_in_other_cell(const Vec<Dim>& s, int hint, SearchCounts& counts) const;
  Location<Dim> find_beyond(const Vec<Dim>& x, int hint, SearchCounts& counts) const;
  Location<Dim> walk(const Vec<Dim>& x, int hint, int& steps) const;
  Location<Dim> search_all(const Vec<Dim>& x, int& steps) const;
  void prefer_lowest(const Vec<Dim>& x, Location<Dim>& found) const;
  bool bin_of(const Vec<Dim>& x, std::array<int, Dim>& bin) const;
  int bin_index(const std::array<int, Dim>& bin) const;
  void build_bins();
  void find_outer_sides();
  int choose_bins(int elements);
  template <class F>
  void for_bins_in(const Vec<Dim>& low, const Vec<Dim>& high, F&& f) const;

  const Mesh<Dim>* mesh_;
  double tolerance_ = 0;
  Vec<Dim> inverse_spacing_{};
  std::vector<std::uint8_t> outer_;  ///< of each element: bit s set where the mesh ends at side s; empty in a grid

  // All elements by the boxes that they touch: bins of equal size over the mesh, each with its elements ascending.
  Vec<Dim> low_{}, high_{}, inverse_bin_{};
  std::array<int, Dim> bins_{};
  std::vector<int> bin_offsets_, bin_elements_;
};

extern template class Locator<2>;
extern template class Locator<3>;

}  // namespace scarp
