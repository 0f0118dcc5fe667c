#include "scarp/mesh/gmsh/joints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "scarp/mesh/build.hpp"
#include "scarp/mesh/gmsh/box_tree.hpp"

namespace scarp::gmsh {
namespace {

/// A place on a side, the way out of its element (of length 1), and how near the side's ends it is: 0 there, about one
/// half in the middle.
template <int Dim>
struct Probe {
  Vec<Dim> on, out;
  double from_ends;

  Vec<Dim> outside(double distance) const {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = on[k] + distance * out[k];
    return x;
  }
};

constexpr double near_end = 1e-3;  ///< what meets along a part of a side meets there, at an end of one of the two
// No round numbers, at which a corner of another part might touch the side.
constexpr double middle = 0.4871, quarter = 0.1137;

/// f(probe) at places along an edge.
template <class F>
void for_each_probe(const std::array<Vec<2>, 2>& x, F&& f) {
  const Vec<2> along = detail::minus(x[1], x[0]);
  const double length = std::hypot(along[0], along[1]);
  for (const double s : {middle, near_end, 1 - near_end, quarter, 1 - quarter}) {
    f(Probe<2>{
        {x[0][0] + s * along[0], x[0][1] + s * along[1]}, {along[1] / length, -along[0] / length}, std::min(s, 1 - s)});
  }
}

/// The same over a triangle.
template <class F>
void for_each_probe(const std::array<Vec<3>, 3>& x, F&& f) {
  Vec<3> out = detail::cross(detail::minus(x[1], x[0]), detail::minus(x[2], x[0]));
  const double length = detail::norm(out);
  for (double& component : out) component /= length;
  const auto probe = [&](double a, double b, double c) {
    Vec<3> on;
    for (int k = 0; k < 3; ++k) on[k] = a * x[0][k] + b * x[1][k] + c * x[2][k];
    f(Probe<3>{on, out, std::min({a, b, c})});
  };
  constexpr double e = near_end, rest = 1 - 2 * e, half = middle, other = 1 - e - half;
  probe(0.31, 0.34, 0.35);
  probe(rest, e, e), probe(e, rest, e), probe(e, e, rest);
  probe(e, half, other), probe(other, e, half), probe(half, other, e);
}

/// The same over a quadrilateral, which may be twisted.
template <class F>
void for_each_probe(const std::array<Vec<3>, 4>& x, F&& f) {
  for (const double s : {middle, near_end, 1 - near_end}) {
    for (const double t : {middle, near_end, 1 - near_end}) {
      Vec<3> on, along_s, along_t;
      for (int k = 0; k < 3; ++k) {
        on[k] = (1 - t) * ((1 - s) * x[0][k] + s * x[1][k]) + t * ((1 - s) * x[3][k] + s * x[2][k]);
        along_s[k] = (1 - t) * (x[1][k] - x[0][k]) + t * (x[2][k] - x[3][k]);
        along_t[k] = (1 - s) * (x[3][k] - x[0][k]) + s * (x[2][k] - x[1][k]);
      }
      Vec<3> out = detail::cross(along_s, along_t);
      const double length = detail::norm(out);
      for (double& component : out) component /= length;
      f(Probe<3>{on, out, std::min({s, 1 - s, t, 1 - t})});
    }
  }
}

template <int Dim>
bool holds(const Mesh<Dim>& mesh, int e, const Vec<Dim>& x) {
  return with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
    return Shape::beyond(Shape::local_coordinates(node_positions<Shape>(mesh, e), x)) <= 0;
  });
}

/// The places of a side's nodes in the order in which its element goes round it.
template <std::size_t Count, int Dim>
std::array<Vec<Dim>, Count> corners_of(const Mesh<Dim>& mesh, const Side& side) {
  std::array<Vec<Dim>, Count> x;
  for (std::size_t i = 0; i < Count; ++i) x[i] = mesh.node(side.nodes[i]);
  if (side.backwards) std::reverse(x.begin() + (Count == 2 ? 0 : 1), x.end());
  return x;
}

template <int Dim, class F>
void for_each_probe_of(const Mesh<Dim>& mesh, const Side& side, F&& f) {
  if constexpr (Dim == 2) {
    for_each_probe(corners_of<2>(mesh, side), f);
  } else if (side.count() == 3) {
    for_each_probe(corners_of<3>(mesh, side), f);
  } else {
    for_each_probe(corners_of<4>(mesh, side), f);
  }
}

template <int Dim>
[[noreturn]] void fail_at(const Scanner& file, const Element& first, const Element& second, const Vec<Dim>& x,
                          bool overlap) {
  const char* line = Dim == 2 ? "line" : "face";
  file.fail(overlap ? fmt::format("elements {} and {} overlap", first.tag, second.tag)
                    : fmt::format("elements {} and {} meet along a {} without sharing its nodes, so that no stress "
                                  "crosses it",
                                  first.tag, second.tag, line),
            fmt::format("at ({:.6g})", fmt::join(x, ", ")),
            overlap ? "let surfaces and volumes share no more than their boundaries (Gmsh: BooleanFragments), and mesh "
                      "again"
                    : "make the parts one geometry before they are meshed (Gmsh: BooleanFragments, or Coherence), or "
                      "merge equal nodes afterwards (Coherence Mesh); a slit needs a width",
            std::max(first.where, second.where));
}

}  // namespace

template <int Dim>
void check_joints(const Scanner& file, const std::vector<Element>& elements, const Mesh<Dim>& mesh,
                  const std::vector<Side>& sides) {
  const BoxTree<Dim> tree(mesh);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (!is_outer(sides, i)) continue;
    const int e = sides[i].element;
    const double height = element_size(mesh, e);
    for_each_probe_of(mesh, sides[i], [&](const Probe<Dim>& probe) {
      double farthest = 0;
      for (const double coordinate : probe.on) farthest = std::max(farthest, std::abs(coordinate));
      // Not below what the round-off of coordinates leaves.
      const double step = std::max({2e-5 * probe.from_ends * height, 1e-7 * height, 1e-14 * farthest});
      const auto other_at = [&](double distance) {
        const Vec<Dim> x = probe.outside(distance);
        int found = -1;
        tree.any_at(x, [&](int other) {
          if (other != e && holds<Dim>(mesh, other, x)) found = other;
          return found >= 0;
        });
        return found;
      };
      const int beyond = other_at(step);
      if (beyond >= 0)
        fail_at<Dim>(file, elements[e], elements[beyond], probe.on,
                     holds<Dim>(mesh, beyond, probe.outside(-100 * step)));
      // Where the same place was meshed twice there is nothing beyond.
      const int inside = probe.from_ends > 0.25 ? other_at(-step) : -1;
      if (inside >= 0) fail_at<Dim>(file, elements[e], elements[inside], probe.on, true);
    });
  }
}

template void check_joints(const Scanner&, const std::vector<Element>&, const Mesh<2>&, const std::vector<Side>&);
template void check_joints(const Scanner&, const std::vector<Element>&, const Mesh<3>&, const std::vector<Side>&);

}  // namespace scarp::gmsh
