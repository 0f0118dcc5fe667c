// Closed triangle surfaces and the solids inside them. No physics, no files.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/base/facet.hpp"

namespace scarp {

struct SolidMoments {
  double volume = 0;
  Vec<3> centroid{};
};

/// The solid inside a closed surface of triangles that surface_fault() finds nothing wrong with. All triangles may be
/// turned inwards: they are turned outwards then. Triangles are kept by the buckets of a plan grid that they are over,
/// so a query on a vertical line looks at those about it only.
class Surface {
 public:
  explicit Surface(std::vector<Triangle> triangles);

  /// Corners anticlockwise seen from outside.
  std::span<const Triangle> triangles() const { return triangles_; }
  const BoxOf<3>& bounds() const { return bounds_; }
  /// Exact to round-off (divergence theorem, coordinates relative to the bounding box).
  const SolidMoments& moments() const { return moments_; }

  /// Inside or on the surface, within round-off?
  bool contains(const Vec<3>& x) const;
  /// No further from the surface than `distance`, at most largest_distance()?
  bool near(const Vec<3>& x, double distance) const;
  double largest_distance() const { return margin_; }

  /// Where the vertical line through (x, y) meets the surface, ascending. A line through edges or corners counts as
  /// shifted by an infinitesimal towards larger x, and less towards larger y; sides are decided exactly, so it goes in
  /// as often as out.
  struct Crossing {
    double z;
    bool leaves;  ///< going up, the solid ends here
  };
  std::vector<Crossing> crossings(double x, double y) const;
  /// The stretches of that line inside the solid: ascending pairs [low, high].
  std::vector<std::array<double, 2>> vertical_cuts(double x, double y) const;

  /// Volume and centroid of what the solid shares with a box: exact to round-off of the box's volume.
  SolidMoments share(const Vec<3>& low, const Vec<3>& high) const;

 private:
  void measure();
  void fill_buckets();
  int bucket(double x, int axis) const;

  std::vector<Triangle> triangles_;
  BoxOf<3> bounds_{};
  SolidMoments moments_;
  double extent_ = 0, margin_ = 0;
  std::array<int, 2> count_{1, 1};
  std::vector<int> begin_, entry_;  ///< triangles of bucket b: entry_[begin_[b]] ... entry_[begin_[b + 1] - 1]
};

/// What keeps triangles from being the surface of a solid.
struct SurfaceFault {
  std::string problem, value, remedy;
  std::size_t triangle;  ///< where
};

/// The first thing wrong, if any: a triangle without area, an edge with other than two triangles, or passed the same
/// way by both, triangles that cross, parts of the surface that are turned against each other.
std::optional<SurfaceFault> surface_fault(std::span<const Triangle> triangles);

}  // namespace scarp
