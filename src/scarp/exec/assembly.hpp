// From elements to nodes without races: the elements are cut into chunks, each with places of its own for the nodes
// that it touches. The elements of a chunk add to its places one after the other, and every node gathers from its
// places in the order of the chunks. The result is the same to the last bit on any number of threads.
#pragma once

#include <cstddef>
#include <vector>

#include "scarp/base/zero_pages.hpp"
#include "scarp/mesh/basis.hpp"
#include "scarp/points/points.hpp"

namespace scarp::exec {

/// The active nodes with their places, and the places of the active elements' local nodes.
class Assembly {
 public:
  /// Most local nodes of an element.
  int row() const { return row_; }
  /// Number of active nodes.
  int size() const { return static_cast<int>(node_.size()); }
  /// Its number in the mesh.
  int node(int k) const { return node_[k]; }
  /// Number of places of all chunks.
  std::size_t places() const { return chunk_begin_.empty() ? 0 : static_cast<std::size_t>(chunk_begin_.back()); }

  /// The places of chunk c: first to last − 1.
  int first_place(int c) const { return chunk_begin_[c]; }
  int last_place(int c) const { return chunk_begin_[c + 1]; }
  /// The places of the local nodes of the active element in a slot.
  const int* places_of(int slot) const { return local_.data() + static_cast<std::size_t>(slot) * row_; }

  /// The numbers of these local nodes among the active nodes.
  const int* nodes_of(int slot) const { return nodes_.data() + static_cast<std::size_t>(slot) * row_; }

  /// f(place) for each place of active node k: step 2 of the report, in a fixed order.
  template <class F>
  void gather(int k, F&& f) const {
    for (int l = begin_[k]; l < begin_[k + 1]; ++l) f(place_[l]);
  }

  /// Number of elements in a chunk; the last may have fewer.
  int chunk() const { return chunk_; }

  /// Makes it anew for other active elements; what it costs is theirs only.
  template <int Dim>
  void rebuild(const Mesh<Dim>& mesh, const ActiveElements& active);

  /// Room for so many active elements of up to `row` nodes.
  void reserve(std::size_t elements, std::size_t row);

 private:
  int row_ = 0, chunk_ = 1;
  std::vector<int> chunk_begin_;           ///< of each chunk: its first place
  std::vector<int> local_;                 ///< rows of the active elements: places of their local nodes
  std::vector<int> nodes_;                 ///< rows of the active elements: their local nodes among the active ones
  std::vector<int> node_, begin_, place_;  ///< active nodes, and their places
  std::vector<int> of_place_;              ///< scratch, of each place: its active node
  struct Latest {
    int position = 0;  ///< one more than its number among the active nodes, or 0
    int place = 0;     ///< one more than the latest given, or 0
  };
  ZeroPages<Latest> latest_;  ///< scratch, of each node of the mesh
};

}  // namespace scarp::exec
