// From elements to nodes without races: each chunk of elements (mesh/chunks.hpp) has accumulators of its own for the
// nodes that it touches. The elements of a chunk add to its accumulators one after the other, and every node gathers
// from its accumulators in the order of the chunks. The result is the same to the last bit on any number of threads,
// and a chunk's part of it depends on the chunk alone.
#pragma once

#include <cstddef>
#include <vector>

#include "scarp/base/zero_pages.hpp"
#include "scarp/mesh/basis.hpp"
#include "scarp/points/points.hpp"

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

  /// f(accumulator) for each accumulator of active node k: step 2 of the report, in a fixed order.
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
  struct Ends {
    int slot = 0, accumulator = 0, node = 0;
  };
  int row_ = 0;
  std::vector<Ends> ends_{Ends{}};  ///< where chunk c begins, and the one before ends
  std::vector<int> local_;          ///< rows of the active elements: accumulators of their local nodes
  std::vector<int> nodes_;          ///< rows of the active elements: their local nodes among the active ones
  std::vector<int> node_, begin_, accumulator_;  ///< active nodes, and their accumulators
  std::vector<int> of_accumulator_;              ///< scratch, of each accumulator: its active node
  struct Latest {
    int position = 0;     ///< one more than its number among the active nodes, or 0
    int accumulator = 0;  ///< one more than the latest given, or 0
  };
  ZeroPages<Latest> latest_;  ///< scratch, of each node of the mesh
};

}  // namespace scarp::exec
