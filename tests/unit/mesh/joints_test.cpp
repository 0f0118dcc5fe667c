// Parts of a mesh that meet without sharing nodes are refused; parts that do not meet, or share them, are not. The
// meshes are written here, at home and turned far from the origin, where coordinates have round-off.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "scarp/base/error.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/gmsh.hpp"

namespace scarp {
namespace {

using Map = std::function<Vec<3>(Vec<3>)>;
const Map same = [](Vec<3> x) { return x; };

/// A Gmsh file of version 2.2 in the making.
struct Draft {
  std::vector<Vec<3>> nodes;
  std::vector<std::pair<int, std::vector<int>>> elements;  ///< Gmsh's type, nodes from 1

  int add(const Vec<3>& x) {
    nodes.push_back(x);
    return static_cast<int>(nodes.size());
  }

  /// A patch of nx by ny squares (two triangles each with `triangles`) of edge h from (x, y) on, with nodes of its own.
  Draft& squares(double x, double y, int nx, int ny, double h, bool triangles = false, const Map& map = same) {
    std::vector<int> n;
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) n.push_back(add(map({x + i * h, y + j * h, 0})));
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const int a = n[j * (nx + 1) + i], b = n[j * (nx + 1) + i + 1], c = n[(j + 1) * (nx + 1) + i + 1],
                  d = n[(j + 1) * (nx + 1) + i];
        if (!triangles) elements.push_back({3, {a, b, c, d}});
        if (triangles) elements.push_back({2, {a, b, c}}), elements.push_back({2, {a, c, d}});
      }
    }
    return *this;
  }

  /// A block of n x n x n cubes (six tetrahedra each with `tetrahedra`) of edge h.
  Draft& cubes(const Vec<3>& from, int n, double h, bool tetrahedra = false) {
    const int first = static_cast<int>(nodes.size()) + 1, row = n + 1;
    for (int k = 0; k <= n; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) add({from[0] + i * h, from[1] + j * h, from[2] + k * h});
    const auto at = [&](int i, int j, int k) { return first + i + row * (j + row * k); };
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const std::array<int, 8> c = {
              at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
              at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
          if (!tetrahedra) elements.push_back({5, {c.begin(), c.end()}});
          // Kuhn's six along the diagonal 0-6.
          for (const auto& [p, q] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}})
            if (tetrahedra) elements.push_back({4, {c[0], c[p], c[q], c[6]}});
        }
      }
    }
    return *this;
  }

  /// Makes nodes at the same place one, as Gmsh's Coherence Mesh does.
  Draft& merge() {
    std::map<std::array<long, 3>, int> known;
    std::vector<int> now(nodes.size() + 1);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto& x = nodes[n];
      const std::array<long, 3> key = {std::lround(x[0] * 1e6), std::lround(x[1] * 1e6), std::lround(x[2] * 1e6)};
      now[n + 1] = known.emplace(key, static_cast<int>(n) + 1).first->second;
    }
    for (auto& [type, corners] : elements)
      for (int& n : corners) n = now[n];
    return *this;
  }

  std::string text(const Map& map) const {
    std::string out = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto x = map(nodes[n]);
      out += fmt::format("{} {:.16g} {:.16g} {:.16g}\n", n + 1, x[0], x[1], x[2]);
    }
    out += fmt::format("$EndNodes\n$Elements\n{}\n", elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e) {
      out += fmt::format("{} {} 2 0 {}", e + 1, elements[e].first, e % 2 + 1);
      for (const int n : elements[e].second) out += fmt::format(" {}", n);
      out += '\n';
    }
    return out + "$EndElements\n";
  }
};

/// Home, and turned by 0.3 about the vertical at places with the size of coordinates of a land survey.
const Map far = [](Vec<3> x) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  return Vec<3>{4e5 + c * x[0] - s * x[1], 5.4e6 + s * x[0] + c * x[1], x[2]};
};

template <int Dim>
void expect_accepted(const Draft& draft) {
  for (const auto& map : {same, far}) {
    try {
      parse_gmsh<Dim>("mesh.msh", draft.text(map));
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

template <int Dim>
void expect_refused(const Draft& draft, const std::string& problem, const std::string& place = "") {
  for (const auto& map : {same, far}) {
    try {
      parse_gmsh<Dim>("mesh.msh", draft.text(map));
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_GT(error.position().line, 0);
      EXPECT_NE(error.problem().find(problem), std::string::npos) << error.what();
      if (&map == &same) {
        EXPECT_NE(error.value().find(place), std::string::npos) << error.what();
      }
      EXPECT_FALSE(error.remedy().empty());
    }
  }
}

const std::string meet = "without sharing its nodes", overlap = "overlap";

TEST(Joints, PartsThatShareNodesAreOneMesh) {
  for (const bool triangles : {false, true}) {
    expect_accepted<2>(Draft().squares(0, 0, 4, 3, 0.5, triangles).squares(2, 0, 4, 3, 0.5, triangles).merge());
  }
  // Two materials, triangles beside quadrilaterals.
  expect_accepted<2>(Draft().squares(0, 0, 4, 3, 0.5, true).squares(2, 0, 4, 3, 0.5, false).merge());
}

TEST(Joints, PartsThatMeetAlongALine) {
  for (const bool left : {false, true}) {
    for (const bool right : {false, true}) {
      SCOPED_TRACE(left * 2 + right);
      // Copies that were never merged, elements of half the size with nodes in common or not, a shift along the line.
      expect_refused<2>(Draft().squares(0, 0, 4, 3, 0.5, left).squares(2, 0, 4, 3, 0.5, right), meet, "at (2, ");
      expect_refused<2>(Draft().squares(0, 0, 4, 3, 0.5, left).squares(2, 0, 4, 6, 0.25, right), meet, "at (2, ");
      expect_refused<2>(Draft().squares(0, 0, 4, 3, 0.5, left).squares(2, 0, 4, 6, 0.25, right).merge(), meet);
      expect_refused<2>(Draft().squares(0, 0, 4, 3, 0.5, left).squares(2, 0.07, 4, 3, 0.5, right), meet);
      // Less than a hundredth of an edge in common.
      expect_refused<2>(Draft().squares(0, 0, 1, 1, 0.5, left).squares(0.5, 0.497, 1, 1, 0.5, right), meet);
    }
  }
}

TEST(Joints, PartsThatOverlap) {
  expect_refused<2>(Draft().squares(0, 0, 4, 3, 0.5).squares(1.77, 0.1, 4, 3, 0.5), overlap);
  // One within an element of the other, and a corner that looks in.
  expect_refused<2>(Draft().squares(0, 0, 1, 1, 4.0).squares(1, 1, 2, 2, 0.3, true), overlap);
  expect_refused<2>(Draft().squares(0, 0, 2, 2, 1.0).squares(1.99, 1.97, 2, 2, 1.0), overlap);
  // The same surface twice, in different elements.
  expect_refused<2>(Draft().squares(0, 0, 2, 2, 1.0).squares(0, 0, 3, 3, 2.0 / 3), overlap);
}

TEST(Joints, SlitsAreNotClosed) {
  // Open by a thousandth of an element.
  expect_accepted<2>(Draft().squares(0, 0, 4, 3, 0.5).squares(2.0005, 0, 4, 3, 0.5, true));
  // Two flanks from one tip, by 1 mm over 2 m, in one mesh.
  Draft wedge;
  wedge.squares(0, -1, 4, 2, 0.5);
  Draft upper;
  upper.squares(0, 0, 4, 2, 0.5, false, [](Vec<3> x) { return Vec<3>{x[0], x[1] + 0.0005 * x[0], x[2]}; });
  const int shift = static_cast<int>(wedge.nodes.size());
  wedge.nodes.insert(wedge.nodes.end(), upper.nodes.begin(), upper.nodes.end());
  for (auto [type, corners] : upper.elements) {
    for (int& n : corners) n += shift;
    wedge.elements.push_back({type, corners});
  }
  expect_accepted<2>(wedge.merge());
}

TEST(Joints, CornersAndOutlinesMayBe) {
  // Parts that touch in a corner, or with a corner in the middle of an edge.
  expect_accepted<2>(Draft().squares(0, 0, 2, 2, 1.0).squares(2, 2, 2, 2, 1.0));
  expect_accepted<2>(Draft().squares(0, 0, 2, 2, 1.0).squares(0, 0, 1, 1, 1.0, false, [](Vec<3> x) {
    return Vec<3>{1.5 + x[0] - x[1], 2 + x[0] + x[1], 0};
  }));
  // An L and a ring with one seam that is merged.
  expect_accepted<2>(Draft().squares(0, 0, 4, 2, 0.5).squares(0, 1, 2, 4, 0.5).merge());
  const Map round = [](Vec<3> x) {
    const double angle = 2 * std::numbers::pi * x[0] / 24;
    return Vec<3>{(2 + x[1]) * std::cos(angle), -(2 + x[1]) * std::sin(angle), 0};
  };
  expect_accepted<2>(Draft().squares(0, 0, 24, 2, 1.0, false, round).merge());
  expect_refused<2>(Draft().squares(0, 0, 24, 2, 1.0, false, round), meet, "at (2.");
  // Two rings, one in the other, with the round slit between them open.
  const Map inner = [&](Vec<3> x) {
    Vec<3> y = round(x);
    for (double& component : y) component *= 0.499;
    return y;
  };
  expect_accepted<2>(Draft().squares(0, 0, 24, 2, 1.0, false, round).squares(0, 0, 24, 2, 1.0, false, inner).merge());
}

TEST(Joints, OfSolids) {
  for (const bool left : {false, true}) {
    for (const bool right : {false, true}) {
      SCOPED_TRACE(left * 2 + right);
      expect_refused<3>(Draft().cubes({0, 0, 0}, 2, 0.5, left).cubes({1, 0, 0}, 2, 0.5, right), meet, "at (1, ");
      expect_refused<3>(Draft().cubes({0, 0, 0}, 2, 0.5, left).cubes({1, 0, 0}, 4, 0.25, right), meet, "at (1, ");
      expect_refused<3>(Draft().cubes({0, 0, 0}, 1, 1.0, left).cubes({1, 0.9, 0.95}, 2, 0.5, right), meet);
      expect_refused<3>(Draft().cubes({0, 0, 0}, 2, 0.5, left).cubes({0.8, 0.2, 0.3}, 2, 0.5, right), overlap);
      expect_refused<3>(Draft().cubes({0, 0, 0}, 1, 3.0, left).cubes({1.1, 1.2, 0.9}, 1, 0.2, right), overlap);
      // Open by a thousandth; touching along an edge; touching in a corner.
      expect_accepted<3>(Draft().cubes({0, 0, 0}, 2, 0.5, left).cubes({1.0005, 0, 0}, 2, 0.5, right));
      expect_accepted<3>(Draft().cubes({0, 0, 0}, 2, 0.5, left).cubes({1, 0, 1}, 2, 0.5, right));
      expect_accepted<3>(Draft().cubes({0, 0, 0}, 2, 0.5, left).cubes({1, 1, 1}, 2, 0.5, right));
    }
    expect_accepted<3>(Draft().cubes({0, 0, 0}, 2, 0.5, left).cubes({1, 0, 0}, 2, 0.5, left).merge());
    // Nodes that hang.
    expect_refused<3>(Draft().cubes({0, 0, 0}, 2, 0.5, left).cubes({1, 0, 0}, 4, 0.25, left).merge(), meet);
  }
}

}  // namespace
}  // namespace scarp
