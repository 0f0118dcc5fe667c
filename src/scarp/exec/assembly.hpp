// From elements to nodes without races: each chunk of elements (mesh/chunks.hpp) has accumulators of its own for the
// nodes that it touches. The elements of a chunk add to its accumulators one after the other, and the first accumulator
// of every node gathers from its others in the order of the chunks. The result is the same to the last bit on any
// number of threads, and a chunk's part of it depends on the chunk alone.
#pragma once

#include <cstddef>
#include <vector>

#include "scarp/base/zero_pages.hpp"
#include "scarp/mesh/basis.hpp"
#include "scarp/points/points.hpp"
#include "scarp/tensor/batch.hpp"

namespace scarp::exec {

/// What is a chunk's of the active elements' slots, of the accumulators, and of the active nodes: those that it is the
/// first to touch. From `first` to `last` − 1 each.
struct Chunk {
  struct Range {
    int first, last;
  };
  Range slots, accumulators, nodes;
};

/// The active nodes with their accumulators, and the accumulators of the active elements' local nodes.
class Assembly {
  template <int n>
  static void add_numbers(const double* from, double* to) {
    using T = typename detail::SizedBatch<4>::type;
    constexpr int W = lanes_of<T>, whole = n / W * W;
    for (int q = 0; q < whole; q += W)
      (T::load_unaligned(to + q) + T::load_unaligned(from + q)).store_unaligned(to + q);
    for (int q = whole; q < n; ++q) to[q] += from[q];
  }

 public:
  /// Most local nodes of an element.
  int row() const { return row_; }
  /// Number of active nodes.
  int size() const { return static_cast<int>(node_.size()); }
  /// Its number in the mesh.
  int node(int k) const { return node_[k]; }
  /// Number of accumulators of all chunks.
  std::size_t accumulators() const { return static_cast<std::size_t>(ends_.back().accumulator); }

  /// The chunks that have active elements, in the order of their numbers.
  int chunks() const { return static_cast<int>(ends_.size()) - 1; }
  Chunk chunk(int c) const {
    const Ends &from = ends_[c], &to = ends_[c + 1];
    return {{from.slot, to.slot}, {from.accumulator, to.accumulator}, {from.node, to.node}};
  }

  /// The accumulators of the local nodes of the active element in a slot.
  const int* accumulators_of(int slot) const { return local_.data() + static_cast<std::size_t>(slot) * row_; }

  /// The numbers of these local nodes among the active nodes.
  const int* nodes_of(int slot) const { return nodes_.data() + static_cast<std::size_t>(slot) * row_; }

  /// The first accumulator of active node k: where its sum is, once they are gathered.
  int first_accumulator(int k) const { return first_[k]; }

  /// Step 2 of the report for the nodes of chunk c: what their other accumulators have goes to their first, n numbers
  /// each, in the order of the chunks. As a list of its own, of the few nodes that have others: to ask each node in
  /// turn how many it has costs a wrong guess of the processor for every one of these.
  template <int n>
  void gather_chunk(int c, double* numbers) const {
    for (int l = ends_[c].other; l < ends_[c + 1].other; ++l) {
      add_numbers<n>(numbers + static_cast<std::size_t>(others_[l].from) * n,
                     numbers + static_cast<std::size_t>(others_[l].to) * n);
    }
  }

  /// f(accumulator) for each accumulator of active node k, in the order of the chunks.
  template <class F>
  void gather(int k, F&& f) const {
    for (int l = begin_[k]; l < begin_[k + 1]; ++l) f(accumulator_[l]);
  }

  /// Makes it anew for other active elements; what it costs is theirs only.
  template <int Dim>
  void rebuild(const Mesh<Dim>& mesh, const ActiveElements& active);

  /// Room for so many active elements of up to `row` nodes.
  void reserve(std::size_t elements, std::size_t row);

 private:
  void list_others();

  struct Ends {
    int slot = 0, accumulator = 0, node = 0;
    int other = 0;  ///< in others_
  };
  int row_ = 0;
  std::vector<Ends> ends_{Ends{}};  ///< where chunk c begins, and the one before ends
  std::vector<int> local_;          ///< rows of the active elements: accumulators of their local nodes
  std::vector<int> nodes_;          ///< rows of the active elements: their local nodes among the active ones
  std::vector<int> node_, begin_, accumulator_;  ///< active nodes, and their accumulators
  std::vector<int> first_;                       ///< of each active node: the first of these
  struct Other {
    int to, from;
  };
  std::vector<Other> others_;        ///< accumulators of a node but its first, with that: by node, and chunk
  std::vector<int> of_accumulator_;  ///< scratch, of each accumulator: its active node
  struct Latest {
    int position = 0;     ///< one more than its number among the active nodes, or 0
    int accumulator = 0;  ///< one more than the latest given, or 0
  };
  ZeroPages<Latest> latest_;  ///< scratch, of each node of the mesh
};

}  // namespace scarp::exec
