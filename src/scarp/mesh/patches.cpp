#include "scarp/mesh/patches.hpp"

#include <algorithm>
#include <array>

namespace scarp {
namespace {

bool is_simplex(ElementType type) {
  return type == ElementType::T3 || type == ElementType::T4;
}

/// An edge or a side, by its nodes in ascending order, and a simplex that has it.
template <std::size_t n>
struct Incidence {
  std::array<int, n> nodes;
  int element;
  auto operator<=>(const Incidence&) const = default;
};

/// f(nodes, incidences) for what some simplices have in common, in the order of the nodes.
template <std::size_t n, class F>
void for_each_common(std::vector<Incidence<n>>& all, F&& f) {
  std::sort(all.begin(), all.end());
  for (std::size_t first = 0, last; first < all.size(); first = last) {
    for (last = first; last < all.size() && all[last].nodes == all[first].nodes;) ++last;
    f(all[first].nodes, std::span<const Incidence<n>>(all.data() + first, last - first));
  }
}

/// Every pair of nodes of a simplex is an edge.
template <int Dim>
std::vector<Incidence<2>> edges_of(const Mesh<Dim>& mesh) {
  std::vector<Incidence<2>> edges;
  for (int e = 0; e < mesh.element_count(); ++e) {
    if (!is_simplex(mesh.type_of(e))) continue;
    const auto n = mesh.element_nodes(e);
    for (int i = 0; i <= Dim; ++i) {
      for (int j = 0; j < i; ++j) edges.push_back({{std::min(n[i], n[j]), std::max(n[i], n[j])}, e});
    }
  }
  return edges;
}

/// All nodes of a simplex but one are a side.
template <int Dim>
std::vector<Incidence<Dim>> sides_of(const Mesh<Dim>& mesh) {
  std::vector<Incidence<Dim>> sides;
  for (int e = 0; e < mesh.element_count(); ++e) {
    if (!is_simplex(mesh.type_of(e))) continue;
    const auto n = mesh.element_nodes(e);
    for (int left_out = 0; left_out <= Dim; ++left_out) {
      Incidence<Dim> side{{}, e};
      for (int i = 0, k = 0; i <= Dim; ++i) {
        if (i != left_out) side.nodes[k++] = n[i];
      }
      std::sort(side.nodes.begin(), side.nodes.end());
      sides.push_back(side);
    }
  }
  return sides;
}

template <int Dim>
double length2(const Mesh<Dim>& mesh, const std::array<int, 2>& edge) {
  double sum = 0;
  for (int j = 0; j < Dim; ++j) {
    const double d = mesh.node(edge[1])[j] - mesh.node(edge[0])[j];
    sum += d * d;
  }
  return sum;
}

struct Edge {
  float length2;  ///< so that edges as long as each other to round-off are taken in the order of their nodes
  std::span<const Incidence<2>> around;
};

/// The patch of each element, −1 for one that is left over or no simplex; and the patches' sizes.
struct Assigned {
  std::vector<int> patch, sizes;

  void add(int e, int k) {
    patch[e] = k;
    ++sizes[k];
  }
  int fresh() {
    sizes.push_back(0);
    return static_cast<int>(sizes.size()) - 1;
  }
};

template <int Dim>
void take_elements_around_edges(const Mesh<Dim>& mesh, Assigned& assigned) {
  constexpr int least = Dim == 2 ? 2 : 4;
  auto all = edges_of(mesh);
  std::vector<Edge> edges;
  for_each_common(all, [&](const auto& nodes, const auto& around) {
    if (around.size() >= least) edges.push_back({static_cast<float>(length2(mesh, nodes)), around});
  });
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.length2 > b.length2; });
  for (const Edge& edge : edges) {
    const auto is_free = [&](const Incidence<2>& its) { return assigned.patch[its.element] < 0; };
    if (std::count_if(edge.around.begin(), edge.around.end(), is_free) < least) continue;
    const int k = assigned.fresh();
    for (const auto& its : edge.around) {
      if (is_free(its)) assigned.add(its.element, k);
    }
  }
}

/// One after the other, so that they may join each other.
template <int Dim>
void join_left_over(const Mesh<Dim>& mesh, Assigned& assigned) {
  std::vector<std::vector<int>> beside(assigned.patch.size());
  auto all = sides_of(mesh);
  for_each_common(all, [&](const auto&, const auto& both) {
    if (both.size() != 2) return;
    for (int l = 0; l < 2; ++l) {
      if (assigned.patch[both[l].element] < 0) beside[both[l].element].push_back(both[1 - l].element);
    }
  });
  for (int e = 0; e < mesh.element_count(); ++e) {
    if (!is_simplex(mesh.type_of(e)) || assigned.patch[e] >= 0) continue;
    int smallest = -1;
    for (const int other : beside[e]) {
      const int its = assigned.patch[other];
      if (its >= 0 && (smallest < 0 || assigned.sizes[its] < assigned.sizes[smallest])) smallest = its;
    }
    assigned.add(e, smallest >= 0 ? smallest : assigned.fresh());
  }
}

}  // namespace

template <int Dim>
Patches::Patches(const Mesh<Dim>& mesh) {
  if (std::none_of(mesh.lists.types.begin(), mesh.lists.types.end(), is_simplex)) return;
  Assigned assigned{std::vector<int>(mesh.element_count(), -1), {}};
  take_elements_around_edges(mesh, assigned);
  join_left_over(mesh, assigned);
  for (const int size : assigned.sizes) begin_.push_back(begin_.back() + size);
  element_.resize(static_cast<std::size_t>(begin_.back()));
  auto next = begin_;
  patch_ = std::move(assigned.patch);
  for (int e = 0; e < mesh.element_count(); ++e) {
    if (patch_[e] >= 0) element_[next[patch_[e]]++] = e;
  }
}

template Patches::Patches(const Mesh<2>&);
template Patches::Patches(const Mesh<3>&);

}  // namespace scarp
