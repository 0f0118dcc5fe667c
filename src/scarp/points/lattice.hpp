// The lattice that fills a region: what each of its cells shares with the region becomes a point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "scarp/base/vec.hpp"
#include "scarp/points/fill.hpp"

namespace scarp {

/// What a cell shares with the region: its volume (area in two dimensions) and centroid.
template <int Dim>
struct Share {
  double volume = 0;
  Vec<Dim> centroid{};
};

template <int Dim>
Share<Dim> joined(const Share<Dim>& a, const Share<Dim>& b) {
  Share<Dim> sum{a.volume + b.volume, {}};
  for (int j = 0; j < Dim; ++j) {
    sum.centroid[j] = (a.volume * a.centroid[j] + b.volume * b.centroid[j]) / sum.volume;
  }
  return sum;
}

/// Equal cells that divide a box, as near to the spacing as whole numbers allow; x runs fastest.
template <int Dim>
class Lattice {
 public:
  using Place = std::array<int, Dim>;

  Lattice(const BoxOf<Dim>& box, double spacing) : box_(box) {
    std::size_t cells = 1;
    for (int j = 0; j < Dim; ++j) {
      const double length = box_.high[j] - box_.low[j];
      count_[j] = std::max(1, static_cast<int>(std::lround(length / spacing)));
      step_[j] = length / count_[j];
      stride_[j] = cells;
      cells *= static_cast<std::size_t>(count_[j]);
    }
    cells_.resize(cells);
  }

  const BoxOf<Dim>& box() const { return box_; }
  int count(int axis) const { return count_[axis]; }
  double step(int axis) const { return step_[axis]; }
  std::size_t size() const { return cells_.size(); }

  double full_volume() const {
    double volume = step_[0];
    for (int j = 1; j < Dim; ++j) volume *= step_[j];
    return volume;
  }

  double edge(int index, int axis) const {
    return index == count_[axis] ? box_.high[axis] : box_.low[axis] + index * step_[axis];
  }

  std::size_t index(const Place& place) const {
    std::size_t i = 0;
    for (int j = 0; j < Dim; ++j) i += stride_[j] * static_cast<std::size_t>(place[j]);
    return i;
  }
  Share<Dim>& cell(const Place& place) { return cells_[index(place)]; }

  /// f(place, share) for every cell, in order.
  template <class F>
  void for_each(F&& f) {
    Place place{};
    for (auto& share : cells_) {
      f(place, share);
      for (int j = 0; j < Dim && ++place[j] == count_[j] && j + 1 < Dim; ++j) place[j] = 0;
    }
  }

  /// Small shares go to the neighbour with the longest common side, which is the one with the larger share of its
  /// cell. `inside` says whether a place is in the region.
  template <class Inside>
  void merge_small_shares(Inside&& inside) {
    for_each([&](const Place& place, Share<Dim>& small) {
      if (small.volume == 0 || small.volume >= least_cell_share * full_volume()) return;
      if (Share<Dim>* host = host_of(place, inside)) {
        *host = joined(*host, small);
        small = {};
      }
    });
  }

  /// Adds every share as a point; a centroid outside the region (a share in two pieces) is cut in halves until
  /// inside. `share_in(low, high)` is the region's share of a box.
  template <class Inside, class ShareIn>
  void collect(Inside&& inside, ShareIn&& share_in, FillingOf<Dim>& filling) {
    const double full = (1 - 1e-9) * full_volume();
    for_each([&](const Place& place, const Share<Dim>& share) {
      if (share.volume == 0) return;
      // A full cell's centre is inside, and a share was joined to another only where their centroid is.
      if (share.volume >= full || inside(share.centroid)) {
        add(share, filling);
        return;
      }
      Vec<Dim> low, high;
      for (int j = 0; j < Dim; ++j) {
        low[j] = edge(place[j], j);
        high[j] = edge(place[j] + 1, j);
      }
      split(low, high, 0, inside, share_in, filling);
    });
  }

 private:
  static void add(const Share<Dim>& share, FillingOf<Dim>& filling) {
    filling.position.push_back(share.centroid);
    filling.volume.push_back(share.volume);
  }

  /// The neighbour with the largest share whose point, joined with this one, stays inside the region.
  template <class Inside>
  Share<Dim>* host_of(const Place& place, Inside& inside) {
    const Share<Dim>& small = cell(place);
    Share<Dim>* best = nullptr;
    for (int way = 0; way < 2 * Dim; ++way) {
      // Down to left first, then right to up: of equal shares the first one hosts.
      const int axis = way < Dim ? Dim - 1 - way : way - Dim;
      Place next = place;
      next[axis] += way < Dim ? -1 : 1;
      if (next[axis] < 0 || next[axis] >= count_[axis]) continue;
      Share<Dim>& other = cell(next);
      if (other.volume <= small.volume || (best && other.volume <= best->volume)) continue;
      if (inside(joined(other, small).centroid)) best = &other;
    }
    return best;
  }

  template <class Inside, class ShareIn>
  static void split(const Vec<Dim>& low, const Vec<Dim>& high, int depth, Inside& inside, ShareIn& share_in,
                    FillingOf<Dim>& filling) {
    const Share<Dim> share = share_in(low, high);
    if (share.volume <= 0) return;
    // Deep down a share is a sliver about an edge; where its point lies no longer matters.
    if (depth >= 6 * Dim || inside(share.centroid)) {
      add(share, filling);
      return;
    }
    const int axis = depth % Dim;
    const double middle = 0.5 * (low[axis] + high[axis]);
    Vec<Dim> upper_low = low, lower_high = high;
    upper_low[axis] = lower_high[axis] = middle;
    split(low, lower_high, depth + 1, inside, share_in, filling);
    split(upper_low, high, depth + 1, inside, share_in, filling);
  }

  BoxOf<Dim> box_;
  std::array<int, Dim> count_{};
  std::array<std::size_t, Dim> stride_{};
  Vec<Dim> step_{};
  std::vector<Share<Dim>> cells_;
};

}  // namespace scarp
