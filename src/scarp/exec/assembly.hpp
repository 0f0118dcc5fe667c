// From elements to nodes without races: every active element writes its own row, every node gathers from the elements
// around it in a fixed order. The result is the same to the last bit on any number of threads.
#pragma once

#include <cstddef>
#include <vector>

#include "scarp/mesh/basis.hpp"
#include "scarp/points/points.hpp"

namespace scarp::exec {

/// The active nodes, and for each the places of its parts in the rows of the active elements, elements ascending: the
/// part of local node i of the element in slot s is at place s · row + i.
class Assembly {
 public:
  /// Most local nodes of an element.
  int row() const { return row_; }
  /// Number of active nodes.
  int size() const { return static_cast<int>(node_.size()); }
  /// Its number in the mesh.
  int node(int k) const { return node_[k]; }
  /// Number of places in all rows.
  std::size_t places() const { return places_; }

  /// f(place) for each part of active node k: step 2 of the report, in a fixed order.
  template <class F>
  void gather(int k, F&& f) const {
    for (int l = begin_[k]; l < begin_[k + 1]; ++l) f(place_[l]);
  }

  /// Makes it anew for other active elements; what it costs is theirs only.
  template <int Dim>
  void rebuild(const Mesh<Dim>& mesh, const ActiveElements& active);

  /// Room for so many active elements of up to `row` nodes.
  void reserve(std::size_t elements, std::size_t row);

 private:
  int row_ = 0;
  std::size_t places_ = 0;
  std::vector<int> node_, begin_, place_;
  std::vector<int> position_;  ///< scratch, of each node of the mesh: its number among the active ones, or -1
};

}  // namespace scarp::exec
