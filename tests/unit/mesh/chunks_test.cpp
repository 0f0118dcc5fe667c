// Chunks: what their numbers promise. Oracle: the definition, by counting.
#include "scarp/mesh/chunks.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>

#include "meshes.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/mesh/hilbert.hpp"

namespace scarp {
namespace {

template <int Dim>
std::map<std::uint64_t, std::vector<int>> chunks_of(const Mesh<Dim>& mesh) {
  std::map<std::uint64_t, std::vector<int>> chunks;
  for (int e = 0; e < mesh.element_count(); ++e) chunks[chunk_of(mesh, e)].push_back(e);
  return chunks;
}

/// All elements of a chunk are in the tile of its first.
template <int Dim>
void expect_tiles(const Mesh<Dim>& mesh, int edge) {
  std::set<std::array<int, Dim>> tiles;
  const auto tile = [&](int e) {
    auto at = mesh.grid->cell(e);
    for (int& place : at) place /= edge;
    return at;
  };
  for (const auto& [number, elements] : chunks_of(mesh)) {
    EXPECT_LE(elements.size(), 64);
    for (const int e : elements) EXPECT_EQ(tile(e), tile(elements[0]));
    EXPECT_TRUE(tiles.insert(tile(elements[0])).second) << "two chunks of one tile";
  }
}

TEST(Chunks, OfGridsAreTiles) {
  expect_tiles(make_grid({0, 0}, {1, 1}, {20, 33}), 8);
  expect_tiles(make_grid({0, 0}, {1, 1}, {1, 300}), 8);
  expect_tiles(make_grid<3>({0, 0, 0}, {1, 1, 1}, {9, 4, 14}), 4);
  expect_tiles(make_grid<3>({0, 0, 0}, {1, 1, 1}, {1, 1, 1}), 4);
}

// Along the curve each tile of a square or cube of 2^k of them is beside the one before.
template <int Dim>
void expect_neighbours(const Mesh<Dim>& mesh, int edge) {
  std::array<int, Dim> before{};
  bool first = true;
  for (const auto& [number, elements] : chunks_of(mesh)) {
    EXPECT_EQ(elements.size(), 64);
    auto at = mesh.grid->cell(elements[0]);
    int distance = 0;
    for (int k = 0; k < Dim; ++k) distance += std::abs(at[k] / edge - before[k]);
    EXPECT_EQ(distance, first ? 0 : 1) << "chunk " << number;
    first = false;
    for (int k = 0; k < Dim; ++k) before[k] = at[k] / edge;
  }
}

TEST(Chunks, OfAGridFollowTheHilbertCurve) {
  expect_neighbours(make_grid({0, 0}, {1, 1}, {64, 64}), 8);
  expect_neighbours(make_grid<3>({0, 0, 0}, {1, 1, 1}, {16, 16, 16}), 4);
}

// 2^21 tiles a side are what 64 bits have room for; a longer grid has a chunk for each tile all the same.
TEST(Chunks, OfALongGridInSpace) {
  Mesh<3> mesh;
  mesh.grid.emplace();
  mesh.grid->elements = {1, 1, 40'000'000};
  EXPECT_EQ(chunk_of(mesh, 3), chunk_of(mesh, 0));
  EXPECT_NE(chunk_of(mesh, 4), chunk_of(mesh, 3));
  EXPECT_EQ(chunk_of(mesh, 39'999'999), 9'999'999);
}

TEST(Chunks, OfAMeshAreElementsInARow) {
  const auto mesh = test::irregular(20, 0.2, test::Kind::mixed);
  std::uint64_t before = 0;
  for (const auto& [number, elements] : chunks_of(mesh)) {
    EXPECT_EQ(number, before++);
    EXPECT_EQ(elements.back() - elements.front() + 1, static_cast<int>(elements.size()));
    EXPECT_LE(elements.size(), 64);
  }
  EXPECT_EQ(before, static_cast<std::uint64_t>((mesh.element_count() + 63) / 64));
}

TEST(Chunks, HilbertPlacesAreAllDifferent) {
  for (const int levels : {0, 1, 2, 3}) {
    std::set<std::uint64_t> plane, space;
    const auto side = std::uint32_t{1} << levels;
    for (std::uint32_t x = 0; x < side; ++x) {
      for (std::uint32_t y = 0; y < side; ++y) {
        plane.insert(hilbert_place(std::array{x, y}, levels));
        for (std::uint32_t z = 0; z < side; ++z) space.insert(hilbert_place(std::array{x, y, z}, levels));
      }
    }
    EXPECT_EQ(plane.size(), side * side);
    EXPECT_EQ(*plane.rbegin(), side * side - 1);
    EXPECT_EQ(space.size(), side * side * side);
    EXPECT_EQ(*space.rbegin(), side * side * side - 1);
  }
}

}  // namespace
}  // namespace scarp
