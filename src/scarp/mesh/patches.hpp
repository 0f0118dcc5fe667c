// Patches of triangles or tetrahedra that are next to each other: in place of the quadrilaterals or hexahedra that they
// might have been, for what has to be uniform over more than one of them.
#pragma once

#include <span>
#include <vector>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Every simplex of a mesh is in one patch: the elements around an edge, the two on both sides of it in the plane and
/// four or more in space, from the longest edge on (of a square cut in two these two, of a cube cut into six all six
/// around its diagonal). Those left over join the smallest patch beside them; one with no simplex beside it is a patch
/// by itself. Other elements are in none.
class Patches {
 public:
  /// None.
  Patches() = default;

  template <int Dim>
  explicit Patches(const Mesh<Dim>& mesh);

  bool empty() const { return element_.empty(); }
  int size() const { return static_cast<int>(begin_.size()) - 1; }
  /// The elements of patch k, ascending.
  std::span<const int> elements(int k) const {
    return {element_.data() + begin_[k], static_cast<std::size_t>(begin_[k + 1] - begin_[k])};
  }
  /// The elements of that of element e, a simplex.
  std::span<const int> around(int e) const { return elements(patch_[e]); }

 private:
  std::vector<int> begin_{0}, element_, patch_;  ///< of each patch, its elements; of each element, its patch or −1
};

}  // namespace scarp
