// Which elements may hold a point: a tree of boxes, whose cost does not grow where a mesh is graded.
#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "scarp/mesh/mesh.hpp"

namespace scarp::gmsh {

/// The elements of a mesh halved again and again by the middle of their boxes' longest extent.
template <int Dim>
class BoxTree {
 public:
  explicit BoxTree(const Mesh<Dim>& mesh) : order_(mesh.element_count()) {
    std::iota(order_.begin(), order_.end(), 0);
    own_.reserve(order_.size());
    for (int e = 0; e < mesh.element_count(); ++e) {
      Box box;
      for (const int n : mesh.element_nodes(e)) box.add(mesh.node(n), mesh.node(n));
      own_.push_back(box);
    }
    if (!order_.empty()) split(0, static_cast<int>(order_.size()));
  }

  /// Is f(e) true for an element whose box holds x? Asks one after the other, up to the first.
  template <class F>
  bool any_at(const Vec<Dim>& x, F&& f) const {
    return !parts_.empty() && any_in(0, x, f);
  }

 private:
  static constexpr int leaf = 8;  ///< elements that are not split further

  struct Box {
    Vec<Dim> low = filled(std::numeric_limits<double>::infinity()), high = filled(-low[0]);

    static Vec<Dim> filled(double value) {
      Vec<Dim> x;
      x.fill(value);
      return x;
    }
    void add(const Vec<Dim>& from, const Vec<Dim>& to) {
      for (int k = 0; k < Dim; ++k) {
        low[k] = std::min(low[k], from[k]);
        high[k] = std::max(high[k], to[k]);
      }
    }
    bool holds(const Vec<Dim>& x) const {
      bool inside = true;
      for (int k = 0; k < Dim; ++k) inside = inside && x[k] >= low[k] && x[k] <= high[k];
      return inside;
    }
  };
  struct Part {
    Box box;
    int first, last;       ///< of order_
    int second_half = -1;  ///< number of that part; the first half follows this one. -1: a leaf
  };

  void split(int first, int last) {
    const std::size_t own = parts_.size();
    parts_.push_back({{}, first, last});
    Box& box = parts_.back().box;
    for (int i = first; i < last; ++i) box.add(own_[order_[i]].low, own_[order_[i]].high);
    if (last - first <= leaf) return;
    int axis = 0;
    for (int k = 1; k < Dim; ++k)
      if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
    const auto middle = [&](int e) { return own_[e].low[axis] + own_[e].high[axis]; };
    const int half = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                     [&](int a, int b) { return middle(a) < middle(b); });
    split(first, half);
    parts_[own].second_half = static_cast<int>(parts_.size());
    split(half, last);
  }

  template <class F>
  bool any_in(int part, const Vec<Dim>& x, F& f) const {
    const Part& its = parts_[part];
    if (!its.box.holds(x)) return false;
    if (its.second_half >= 0) return any_in(part + 1, x, f) || any_in(its.second_half, x, f);
    for (int i = its.first; i < its.last; ++i)
      if (own_[order_[i]].holds(x) && f(order_[i])) return true;
    return false;
  }

  std::vector<int> order_;
  std::vector<Box> own_;
  std::vector<Part> parts_;
};

}  // namespace scarp::gmsh
