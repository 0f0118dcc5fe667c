#include "scarp/mesh/locate.hpp"

#include <limits>

#include "scarp/mesh/build.hpp"

namespace scarp {
namespace {

template <int Dim>
struct Bounds {
  Vec<Dim> low, high;
};

/// The box around each element, larger by a part of its extent: what counts as inside may lie a little outside.
template <int Dim>
std::vector<Bounds<Dim>> boxes_with_margin(const Mesh<Dim>& mesh, double margin) {
  std::vector<Bounds<Dim>> boxes;
  boxes.reserve(mesh.element_count());
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto nodes = mesh.element_nodes(e);
    Bounds<Dim> box{mesh.node(nodes[0]), mesh.node(nodes[0])};
    double extent = 0;
    for (int k = 0; k < Dim; ++k) {
      for (int node : nodes) {
        box.low[k] = std::min(box.low[k], mesh.node(node)[k]);
        box.high[k] = std::max(box.high[k], mesh.node(node)[k]);
      }
      extent = std::max(extent, box.high[k] - box.low[k]);
    }
    for (int k = 0; k < Dim; ++k) {
      box.low[k] -= margin * extent;
      box.high[k] += margin * extent;
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// How far [m] x is outside the line through an edge.
double outside_of(const Vec<2>& x, const std::array<Vec<2>, 2>& edge) {
  const Vec<2> along = detail::minus(edge[1], edge[0]);
  return detail::cross(detail::minus(x, edge[0]), along) / std::hypot(along[0], along[1]);
}

/// How far [m] x is outside the plane of a face: that through its middle and along its diagonals, if it has four nodes.
template <std::size_t Corners>
double outside_of(const Vec<3>& x, const std::array<Vec<3>, Corners>& face) {
  Vec<3> middle{};
  for (const Vec<3>& corner : face)
    for (int k = 0; k < 3; ++k) middle[k] += corner[k] / static_cast<double>(Corners);
  const Vec<3> normal = Corners == 3
                            ? detail::cross(detail::minus(face[1], face[0]), detail::minus(face[2], face[0]))
                            : detail::cross(detail::minus(face[2], face[0]), detail::minus(face[Corners - 1], face[1]));
  return detail::dot(detail::minus(x, middle), normal) / detail::norm(normal);
}

/// Distance [m] from x to the farthest of the lines or planes of the element's sides that x is beyond. Unlike local
/// coordinates it means the same in elements of any size and shape, so it can say which of several is the nearest.
template <int Dim>
double distance(const Mesh<Dim>& mesh, int e, const Vec<Dim>& x) {
  return with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
    const NodePositions<Shape> x_nodes = node_positions<Shape>(mesh, e);
    double farthest = 0;
    for (const auto& nodes : Shape::sides) {
      std::array<Vec<Dim>, std::tuple_size_v<std::decay_t<decltype(nodes)>>> side;
      for (std::size_t i = 0; i < side.size(); ++i) side[i] = x_nodes[nodes[i]];
      farthest = std::max(farthest, outside_of(x, side));
    }
    return farthest;
  });
}

}  // namespace

template <int Dim>
Locator<Dim>::Locator(const Mesh<Dim>& mesh) : mesh_(&mesh) {
  const double farthest = largest_coordinate(mesh), smallest = least_size(mesh);
  tolerance_ = std::clamp(8 * std::numeric_limits<double>::epsilon() * farthest / smallest, 1e-10, 1e-6);
  if (mesh.grid) {
    for (int k = 0; k < Dim; ++k) inverse_spacing_[k] = 1 / mesh.grid->spacing[k];
  } else {
    build_bins();
    find_outer_sides();
  }
}

/// A side of which no other element has a Dim of its nodes in a side of its own. (A quadrilateral face may be shared by
/// two tetrahedra.)
template <int Dim>
void Locator<Dim>::find_outer_sides() {
  struct Corner {
    std::array<int, Dim> nodes;  // ascending
    int element, side;
  };
  std::vector<Corner> all;
  for (int e = 0; e < mesh_->element_count(); ++e) {
    const auto node = mesh_->element_nodes(e);
    with_shape<Dim>(mesh_->type_of(e), [&]<class Shape>(Shape) {
      for (const auto& local : Shape::sides) {
        const int side = side_of<Shape>(local), n = static_cast<int>(local.size());
        for (int first = 0; first < (n == Dim ? 1 : n); ++first) {
          Corner corner{{}, e, side};
          for (int i = 0; i < Dim; ++i) corner.nodes[i] = node[local[(first + i) % n]];
          std::sort(corner.nodes.begin(), corner.nodes.end());
          all.push_back(corner);
        }
      }
    });
  }
  std::sort(all.begin(), all.end(), [](const Corner& a, const Corner& b) { return a.nodes < b.nodes; });
  std::vector<std::uint8_t> inner(mesh_->element_count(), 0);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    if (all[i].nodes != all[i + 1].nodes || all[i].element == all[i + 1].element) continue;
    for (const auto& corner : {all[i], all[i + 1]}) {
      auto& sides = inner[corner.element];
      sides = static_cast<std::uint8_t>(sides | 1u << corner.side);
    }
  }
  outer_.resize(inner.size());
  for (std::size_t e = 0; e < inner.size(); ++e) outer_[e] = static_cast<std::uint8_t>(~inner[e]);
}

template <int Dim>
Location<Dim> Locator<Dim>::find_in_other_cell(const Vec<Dim>& s, int hint, SearchCounts& counts) const {
  const int steps = hint >= 0 ? 2 : 1;
  std::array<int, Dim> index;
  for (int k = 0; k < Dim; ++k) {
    const int last = mesh_->grid->elements[k] - 1;
    if (!(s[k] >= -tolerance_ && s[k] <= last + 1 + tolerance_)) {
      counts.add(&SearchCounts::lost, steps);
      return {-1, {}, steps};
    }
    index[k] = std::clamp(static_cast<int>(s[k]), 0, last);
    if (index[k] > 0 && s[k] - index[k] <= tolerance_) --index[k];
  }
  int e = 0;
  for (int k = Dim - 1; k >= 0; --k) e = e * mesh_->grid->elements[k] + index[k];
  std::int64_t SearchCounts::*how = &SearchCounts::searched_all;
  if (hint >= 0) {
    const std::array<int, Dim> own = mesh_->grid->cell(hint);
    int apart = 0;
    for (int k = 0; k < Dim; ++k) apart = std::max(apart, std::abs(index[k] - own[k]));
    how = apart <= 1 ? &SearchCounts::surrounding : &SearchCounts::walked;
  }
  counts.add(how, steps);
  return place(e, index, s, steps);
}

template <int Dim>
Location<Dim> Locator<Dim>::find_beyond(const Vec<Dim>& x, int hint, SearchCounts& counts) const {
  Location<Dim> found;
  std::int64_t SearchCounts::*how = &SearchCounts::surrounding;
  int steps = 0;
  if (hint >= 0) {
    steps = 1;  // the hint itself, which find() has examined
    for (int e : mesh_->elements_around(hint)) {
      ++steps;
      if (examine(e, x, found.xi) <= tolerance_) {
        found.element = e;
        break;
      }
    }
    if (found.element < 0) {
      how = &SearchCounts::walked;
      found = walk(x, hint, steps);
    }
    if (found.element >= 0) {
      found.steps = steps;
      prefer_lowest(x, found);
      steps = found.steps;
    }
  }
  if (found.element < 0) {
    found = search_all(x, steps);
    how = found.element >= 0 ? &SearchCounts::searched_all : &SearchCounts::lost;
  }
  found.steps = steps;
  counts.add(how, steps);
  return found;
}

/// From the elements around the hint, always on to the elements around the nearest one seen so far, until one
/// contains x or walk_limit elements were seen. No element is examined twice.
template <int Dim>
Location<Dim> Locator<Dim>::walk(const Vec<Dim>& x, int hint, int& steps) const {
  struct Seen {
    int element;
    double distance;
    bool left;
  };
  std::array<Seen, walk_limit> seen;
  int count = 0;
  seen[count++] = {hint, 0, true};
  for (int e : mesh_->elements_around(hint))
    if (count < walk_limit) seen[count++] = {e, distance<Dim>(*mesh_, e, x), false};
  Location<Dim> found;
  while (true) {
    Seen* nearest = nullptr;
    for (int i = 0; i < count; ++i)
      if (!seen[i].left && (!nearest || seen[i].distance < nearest->distance)) nearest = &seen[i];
    if (!nearest) return {};
    nearest->left = true;
    for (int e : mesh_->elements_around(nearest->element)) {
      if (std::any_of(seen.begin(), seen.begin() + count, [e](const Seen& s) { return s.element == e; })) continue;
      if (count == walk_limit) return {};
      ++steps;
      if (examine(e, x, found.xi) <= tolerance_) {
        found.element = e;
        return found;
      }
      seen[count++] = {e, distance<Dim>(*mesh_, e, x), false};
    }
  }
}

template <int Dim>
Location<Dim> Locator<Dim>::search_all(const Vec<Dim>& x, int& steps) const {
  Location<Dim> found;
  std::array<int, Dim> bin;
  if (!bin_of(x, bin)) return found;
  const int b = bin_index(bin);
  for (int i = bin_offsets_[b]; i < bin_offsets_[b + 1]; ++i) {
    ++steps;
    if (examine(bin_elements_[i], x, found.xi) <= tolerance_) {
      found.element = bin_elements_[i];
      return found;
    }
  }
  return found;
}

/// A point on the boundary of the element found: the lowest of the elements that contain it, all of which share
/// the boundary's nodes.
template <int Dim>
void Locator<Dim>::prefer_lowest(const Vec<Dim>& x, Location<Dim>& found) const {
  const double beyond =
      with_shape<Dim>(mesh_->type_of(found.element), [&]<class Shape>(Shape) { return Shape::beyond(found.xi); });
  // Heights of neighbours may differ much, and with them what is near; a wide net costs little.
  if (beyond < -1e-4) return;
  for (int e : mesh_->elements_around(found.element)) {
    if (e >= found.element) return;
    ++found.steps;
    Vec<Dim> xi;
    if (examine(e, x, xi) <= tolerance_) {
      found.element = e;
      found.xi = xi;
      return;
    }
  }
}

/// The bin that holds x; false when x is outside all bins.
template <int Dim>
bool Locator<Dim>::bin_of(const Vec<Dim>& x, std::array<int, Dim>& bin) const {
  for (int k = 0; k < Dim; ++k) {
    if (!(x[k] >= low_[k] && x[k] <= high_[k])) return false;
    bin[k] = std::clamp(static_cast<int>((x[k] - low_[k]) * inverse_bin_[k]), 0, bins_[k] - 1);
  }
  return true;
}

/// Sets bins_ over the box from low_ to high_ to about as many as there are elements, and returns their number.
template <int Dim>
int Locator<Dim>::choose_bins(int elements) {
  double volume = 1;
  for (int k = 0; k < Dim; ++k) volume *= high_[k] - low_[k];
  double edge = std::pow(volume / std::max(elements, 1), 1.0 / Dim);
  while (true) {
    std::int64_t total = 1;
    for (int k = 0; k < Dim; ++k) {
      bins_[k] = elements == 0 ? 1 : std::clamp(static_cast<int>((high_[k] - low_[k]) / edge), 1, elements);
      inverse_bin_[k] = bins_[k] / (high_[k] - low_[k]);
      total *= bins_[k];
    }
    // A mesh that is much thinner than such a cube gets one bin across, and would get too many in the other directions.
    if (total <= 2 * std::max<std::int64_t>(elements, 1)) return static_cast<int>(total);
    edge *= 1.25;
  }
}

/// Sorts the elements into the bins.
template <int Dim>
void Locator<Dim>::build_bins() {
  const int elements = mesh_->element_count();
  const std::vector<Bounds<Dim>> boxes = boxes_with_margin(*mesh_, 4 * tolerance_);
  low_.fill(std::numeric_limits<double>::infinity());
  high_.fill(-std::numeric_limits<double>::infinity());
  for (const Bounds<Dim>& box : boxes)
    for (int k = 0; k < Dim; ++k) {
      low_[k] = std::min(low_[k], box.low[k]);
      high_[k] = std::max(high_[k], box.high[k]);
    }
  const int total = choose_bins(elements);
  bin_offsets_.assign(static_cast<std::size_t>(total) + 1, 0);
  for (const Bounds<Dim>& box : boxes) for_bins_in(box.low, box.high, [&](int b) { ++bin_offsets_[b + 1]; });
  for (int b = 0; b < total; ++b) bin_offsets_[b + 1] += bin_offsets_[b];
  bin_elements_.resize(bin_offsets_[total]);
  std::vector<int> next(bin_offsets_.begin(), bin_offsets_.end() - 1);
  for (int e = 0; e < elements; ++e)
    for_bins_in(boxes[e].low, boxes[e].high, [&](int b) { bin_elements_[next[b]++] = e; });
}

/// Calls f with each bin that the box from low to high touches.
template <int Dim>
template <class F>
void Locator<Dim>::for_bins_in(const Vec<Dim>& low, const Vec<Dim>& high, F&& f) const {
  std::array<int, Dim> first, last;
  if (!bin_of(low, first) || !bin_of(high, last)) return;
  std::array<int, Dim> at = first;
  while (true) {
    f(bin_index(at));
    int k = 0;
    while (k < Dim && at[k] == last[k]) {
      at[k] = first[k];
      ++k;
    }
    if (k == Dim) return;
    ++at[k];
  }
}

template <int Dim>
int Locator<Dim>::bin_index(const std::array<int, Dim>& bin) const {
  int b = 0;
  for (int k = Dim - 1; k >= 0; --k) b = b * bins_[k] + bin[k];
  return b;
}

template <int Dim>
std::vector<int> Locator<Dim>::elements_at(const Vec<Dim>& x, int e) const {
  Vec<Dim> xi;
  if (!mesh_->grid && examine(e, x, xi) < -1e-4) return {e};  // a wide net, as above
  std::vector<int> all{e};
  for (const int other : mesh_->elements_around(e)) {
    if (mesh_->grid ? cell_holds(other, x) : examine(other, x, xi) <= tolerance_) all.push_back(other);
  }
  std::sort(all.begin(), all.end());
  return all;
}

template class Locator<2>;
template class Locator<3>;

}  // namespace scarp
