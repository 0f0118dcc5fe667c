#include "scarp/points/surface_shares.hpp"

#include <fmt/format.h>

#include <vector>

#include "scarp/base/error.hpp"

namespace scarp {
namespace {

/// Of a cell: volume and first moments below the pieces in it; area in plan and its first moments of those pieces. From
/// the lower corner of the cell.
struct Pieces {
  double volume = 0, x = 0, y = 0, z = 0;
  double area = 0, area_x = 0, area_y = 0;
};

class Cutter {
 public:
  explicit Cutter(const Lattice<3>& lattice) : lattice_(lattice), pieces_(lattice.size()) {}

  /// Coordinates count from the lower corner of the lattice, so that a large one costs no digits.
  void add(Triangle triangle) {
    for (auto& corner : triangle) {
      for (int j = 0; j < 3; ++j) corner[j] -= lattice_.box().low[j];
    }
    slice(Facet(triangle), 0, [&](int column, const Facet& slab) {
      slice(slab, 1, [&](int row, const Facet& strip) {
        slice(strip, 2, [&](int layer, const Facet& piece) { add_piece({column, row, layer}, piece); });
      });
    });
  }

  const Pieces& pieces(const Lattice<3>::Place& place) const { return pieces_[lattice_.index(place)]; }

  double plane(int index, int axis) const {
    const auto& box = lattice_.box();
    return index == lattice_.count(axis) ? box.high[axis] - box.low[axis] : index * lattice_.step(axis);
  }

 private:
  /// f(index, piece) for the pieces between the lattice's planes across an axis.
  template <class F>
  void slice(const Facet& facet, int axis, F&& f) const {
    double low = facet.corner[0][axis];
    for (int i = 1; i < facet.size; ++i) low = std::min(low, facet.corner[i][axis]);
    const int last = lattice_.count(axis) - 1;
    Facet rest = facet, piece, above;
    for (int index = std::clamp(static_cast<int>(low / lattice_.step(axis)), 0, last); rest.size > 0; ++index) {
      if (index == last) {
        f(index, rest);
        return;
      }
      cut(rest, axis, plane(index + 1, axis), piece, above);
      if (piece.size > 0) f(index, piece);
      rest = above;
    }
  }

  void add_piece(const Lattice<3>::Place& place, const Facet& piece) {
    const FacetMoments m = moments(piece, {plane(place[0], 0), plane(place[1], 1), plane(place[2], 2)});
    Pieces& sum = pieces_[lattice_.index(place)];
    sum.volume += m.z;
    sum.x += m.xz;
    sum.y += m.yz;
    sum.z += m.half_zz;
    sum.area += m.area;
    sum.area_x += m.x;
    sum.area_y += m.y;
  }

  const Lattice<3>& lattice_;
  std::vector<Pieces> pieces_;
};

[[noreturn]] void refuse(const Vec<3>& x, double part) {
  throw InputError(
      "the surface of a solid passes through itself",
      fmt::format("a cell of which {:.3g} is inside, near ({:.6g}, {:.6g}, {:.6g})", part, x[0], x[1], x[2]),
      "make one surface of the parts that overlap there");
}

}  // namespace

void find_shares(const Surface& surface, Lattice<3>& lattice) {
  Cutter cutter(lattice);
  for (const auto& triangle : surface.triangles()) cutter.add(triangle);
  const double full = lattice.full_volume();
  for (int row = 0; row < lattice.count(1); ++row) {
    for (int column = 0; column < lattice.count(0); ++column) {
      double area = 0, area_x = 0, area_y = 0;  // in plan, of the pieces above
      for (int layer = lattice.count(2) - 1; layer >= 0; --layer) {
        const Pieces& own = cutter.pieces({column, row, layer});
        const double height = cutter.plane(layer + 1, 2) - cutter.plane(layer, 2);
        const double volume = own.volume + height * area;
        const Vec<3> low{lattice.edge(column, 0), lattice.edge(row, 1), lattice.edge(layer, 2)};
        if (volume < -1e-9 * full || volume > (1 + 1e-9) * full) refuse(low, volume / full);
        if (volume > negligible_share * full) {
          lattice.cell({column, row, layer}) = {
              volume,
              {low[0] + (own.x + height * area_x) / volume, low[1] + (own.y + height * area_y) / volume,
               low[2] + (own.z + 0.5 * height * height * area) / volume}};
        }
        area += own.area;
        area_x += own.area_x;
        area_y += own.area_y;
      }
    }
  }
}

}  // namespace scarp
