#include "scarp/mesh/hilbert.hpp"

#include <utility>

namespace scarp {

std::uint64_t hilbert_place(std::array<std::uint32_t, 2> cell, int levels) {
  auto [x, y] = cell;
  std::uint64_t place = 0;
  for (int level = levels - 1; level >= 0; --level) {
    const std::uint32_t right = (x >> level) & 1u, up = (y >> level) & 1u;
    place = 4 * place + (3 * right ^ up);
    if (up == 0) {
      if (right == 1) {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

std::uint64_t hilbert_place(std::array<std::uint32_t, 3> cell, int levels) {
  for (std::uint32_t bit = levels > 0 ? 1u << (levels - 1) : 0; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& coordinate : cell) {
      if (coordinate & bit) {
        cell[0] ^= below;
      } else {
        const std::uint32_t differ = (cell[0] ^ coordinate) & below;
        cell[0] ^= differ;
        coordinate ^= differ;
      }
    }
  }
  cell[1] ^= cell[0];
  cell[2] ^= cell[1];
  std::uint32_t turned = 0;
  for (std::uint32_t bit = levels > 0 ? 1u << (levels - 1) : 0; bit > 1; bit >>= 1)
    if (cell[2] & bit) turned ^= bit - 1;
  std::uint64_t place = 0;
  for (int level = levels - 1; level >= 0; --level)
    for (const std::uint32_t coordinate : cell) place = 2 * place + (((coordinate ^ turned) >> level) & 1u);
  return place;
}

}  // namespace scarp
