#include "scarp/mesh/chunks.hpp"

#include <algorithm>
#include <bit>

#include "scarp/mesh/hilbert.hpp"

namespace scarp {

template <int Dim>
std::uint64_t chunk_of(const Mesh<Dim>& mesh, int e) {
  constexpr int edge = Dim == 2 ? 8 : 4, elements = 64;
  if (!mesh.grid) return static_cast<std::uint64_t>(e / elements);
  const auto cell = mesh.grid->cell(e);
  std::array<std::uint32_t, Dim> tile;
  std::uint32_t last = 0;
  std::uint64_t along_axes = 0;
  for (int k = Dim - 1; k >= 0; --k) {
    tile[k] = static_cast<std::uint32_t>(cell[k] / edge);
    const auto last_here = static_cast<std::uint32_t>((mesh.grid->elements[k] - 1) / edge);
    last = std::max(last, last_here);
    along_axes = along_axes * (last_here + 1) + tile[k];
  }
  const int levels = static_cast<int>(std::bit_width(last));
  return levels > most_hilbert_levels<Dim> ? along_axes : hilbert_place(tile, levels);
}

template std::uint64_t chunk_of<2>(const Mesh<2>&, int);
template std::uint64_t chunk_of<3>(const Mesh<3>&, int);

}  // namespace scarp
