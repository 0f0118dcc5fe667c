// The material points: structure of arrays, one block per region, so that a block has one law.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "scarp/base/column.hpp"
#include "scarp/base/vec.hpp"
#include "scarp/base/zero_pages.hpp"
#include "scarp/material/models.hpp"
#include "scarp/material/nonlocal.hpp"
#include "scarp/tensor/sym.hpp"

namespace scarp {

/// Bits of Points::flags: what the last stress update met.
enum PointFlag : std::uint8_t { flag_separated = 1, flag_on_floor = 2, flag_failed = 4, flag_corrected = 8 };

/// Number of components of the spin in a Dim-dimensional analysis.
template <int Dim>
inline constexpr int spin_size = Dim == 2 ? 1 : 3;

/// What an array of the points holds: a number; components along the axes; a symmetric tensor in Mandel components,
/// which turns with the soil; the components of a tensor row by row.
enum class PointKind { number, vector, tensor, matrix };

/// Of an array of the points, or a group of them.
struct PointArray {
  const char *key, *unit, *meaning;
  PointKind kind;
  bool shown;     ///< in frames, as it is
  bool saved;     ///< the next step depends on it
  bool optional;  ///< empty where a mesh or scheme has no use for it
};

/// What every material point carries, whatever its soil. Tension positive, as in section 2 of the report. One entry
/// per point in each array; per metre of thickness in plane strain. Declared here and in each(), from which order,
/// removal and frames take them.
template <int Dim>
struct Points {
  static constexpr int stress_size = sym_size<Dim>;

  Column mass;
  Column volume, initial_volume;
  std::array<Column, Dim> x, v, x_start;
  std::array<Column, Dim> xi;
  std::array<Column, stress_size> sigma, sigma_ahead;
  std::array<Column, Dim * Dim> C;  ///< C_jk at j Dim + k
  Column eps_q;
  std::vector<int> element, id;
  std::vector<std::uint8_t> flags;     ///< PointFlag bits
  std::vector<std::uint8_t> substeps;  ///< at most 255

  /// f(what it is, member) for each member of these or const points.
  template <class Self, class F>
  static void each(Self& p, F&& f) {
    using K = PointKind;
    constexpr bool shown = true, saved = true, optional = true;
    f(PointArray{"mass", "Mg", "m_p", K::number, !shown, saved, !optional}, p.mass);
    f(PointArray{"volume", "m³", "Ω_p", K::number, shown, saved, !optional}, p.volume);
    f(PointArray{"initial_volume", "m³", "Ω_p at the start", K::number, !shown, saved, !optional}, p.initial_volume);
    f(PointArray{"eps_q", "–", "∫ √(2/3) ‖dev dε‖", K::number, shown, saved, !optional}, p.eps_q);
    f(PointArray{"x", "m", "position", K::vector, !shown, saved, !optional}, p.x);
    f(PointArray{"velocity", "m/s", "v_p", K::vector, shown, saved, !optional}, p.v);
    f(PointArray{"x_start", "m", "position that displacements count from", K::vector, !shown, saved, !optional},
      p.x_start);
    f(PointArray{"xi", "–", "local coordinates in the element, where the mesh needs them stored", K::vector, !shown,
                 saved, optional},
      p.xi);
    f(PointArray{"sigma", "kPa", "Cauchy stress, effective", K::tensor, !shown, saved, !optional}, p.sigma);
    f(PointArray{"sigma_ahead", "kPa", "σ*, what nodes feel where the rate of stress is damped", K::tensor, !shown,
                 saved, optional},
      p.sigma_ahead);
    f(PointArray{"C", "1/s", "gradient of velocity that a point of an affine scheme carries", K::matrix, !shown, saved,
                 optional},
      p.C);
    f(PointArray{"element", "", "element that holds the point", K::number, !shown, saved, !optional}, p.element);
    f(PointArray{"id", "", "number at the start of the computation", K::number, shown, saved, !optional}, p.id);
    f(PointArray{"flags", "", "what the last stress update met", K::number, !shown, saved, !optional}, p.flags);
    f(PointArray{"substeps", "", "of the last stress update", K::number, shown, saved, !optional}, p.substeps);
  }

  int size() const { return static_cast<int>(mass.size()); }
  /// Component j of the displacement of point i.
  double u(int j, int i) const { return x[j][i] - x_start[j][i]; }  // eq. 18
};

/// x_p
template <int Dim>
Vec<Dim> position_of(const Points<Dim>& points, int i) {
  Vec<Dim> x;
  for (int j = 0; j < Dim; ++j) x[j] = points.x[j][i];
  return x;
}

/// |v_p|² and ½ m_p |v_p|²
template <int Dim>
double speed2_of(const Points<Dim>& points, int i) {
  double v2 = 0;
  for (int j = 0; j < Dim; ++j) v2 += points.v[j][i] * points.v[j][i];
  return v2;
}
template <int Dim>
double kinetic_energy_of(const Points<Dim>& points, int i) {
  return 0.5 * points.mass[i] * speed2_of(points, i);
}

/// The points of one region, with their law and its state.
template <int Dim>
struct Block {
  /// `internal_length` [m] is one over which the law softens (material/nonlocal.hpp), or 0; a law that has nothing to
  /// average takes 0 only.
  Block(std::string region, const AnyModel& law, double internal_length = 0)
      : name(std::move(region)),
        model(law),
        length(internal_length),
        state(std::visit(
            [internal_length](const auto& m) {
              return static_cast<std::size_t>(state_columns<sym_size<Dim>>(m) +
                                              (internal_length > 0 ? nonlocal_columns(m) : 0));
            },
            law)) {}

  std::string name;
  AnyModel model;
  double length = 0;  ///< over which it softens [m]; 0: at each point by itself
  Points<Dim> points;
  std::vector<Column> state;  ///< columns of the model's state without sigma; compression positive, as in the model.
                              ///< With a length the last three are κ, κ̂ and dκ̂/dt

  // Order by element and id, kept by sort_by_element(): the points of the active element in slot s are
  // order[begin[s]] ... order[begin[s + 1] - 1].
  std::vector<int> order, begin;
  std::tuple<Column, std::vector<int>, std::vector<std::uint8_t>> spare;  ///< for exec::arrange_in_order()

  int size() const { return points.size(); }
};

namespace detail {

/// f(array) of one array, or of each in a group.
template <class Array, class F>
void for_each_in(Array& array, F&& f) {
  f(array);
}
template <class Array, std::size_t n, class F>
void for_each_in(std::array<Array, n>& group, F&& f) {
  for (auto& array : group) f(array);
}
template <class Array, std::size_t n, class F>
void for_each_in(const std::array<Array, n>& group, F&& f) {
  for (const auto& array : group) f(array);
}

}  // namespace detail

/// f(column) for each array of a block that has one entry per point (not order, begin and spare).
template <class AnyBlock, class F>
void for_each_column(AnyBlock& b, F&& f) {
  std::decay_t<decltype(b.points)>::each(b.points, [&](const PointArray& info, auto& member) {
    detail::for_each_in(member, [&](auto& column) {
      if (!info.optional || !column.empty()) f(column);
    });
  });
  for (auto& column : b.state) f(column);
}

/// Sets the number of points, new entries zero.
template <int Dim>
void resize(Block<Dim>& block, int size) {
  for_each_column(block, [size]<class Array>(Array& column) {
    column.resize(static_cast<std::size_t>(size), typename Array::value_type{});
  });
}

/// Room for a block to be ordered by so many elements without allocating.
template <int Dim>
void reserve_order(Block<Dim>& block, std::size_t elements) {
  const auto points = static_cast<std::size_t>(block.size());
  block.order.reserve(points);
  block.begin.reserve(elements + 2);
  std::apply([points](auto&... column) { (column.reserve(points), ...); }, block.spare);
}

/// The number of the chunk of an element (mesh/chunks.hpp).
using ChunkOfElement = std::function<std::uint64_t(int)>;

/// The elements that hold points, ascending by chunk and number, and the place (slot) of each element in that list.
struct ActiveElements {
  /// An element with the chunk that it belongs to: what comes first in memory and in sums.
  struct Place {
    std::uint64_t chunk;
    int element;
    auto operator<=>(const Place&) const = default;
  };

  std::vector<int> element;          ///< of each slot
  std::vector<std::uint64_t> chunk;  ///< of each slot
  MostlyNone<int> slot;              ///< of each element of the mesh; -1 where it holds no point
  // What the last sort_by_element() changed:
  std::vector<Place> fresh;  ///< elements that were not active before it
  std::vector<int> emptied;  ///< elements that are not any more
  // Its scratch:
  std::vector<int> end;  ///< of each slot: where its next point goes

  int size() const { return static_cast<int>(element.size()); }
  /// Room for so many.
  void reserve(std::size_t elements);
};

/// Orders the points of every block by element, and in an element by id, after points have changed element or gone, and
/// brings the active elements up to date. The order is that of the points as they are: nothing of how they lie in the
/// arrays, or came there, is left in it. Ids differ within a block. Returns whether the active elements are others than
/// before.
template <int Dim>
bool sort_by_element(std::vector<Block<Dim>>& blocks, int element_count, const ChunkOfElement& chunk_of,
                     ActiveElements& active);

/// Takes out the points of a block for which gone[i] is set; the others keep their order.
template <int Dim>
void remove_points(Block<Dim>& block, const std::vector<std::uint8_t>& gone);

}  // namespace scarp
