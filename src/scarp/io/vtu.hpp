// VTK XML files of unstructured grids (.vtu), appended raw binary: what ParaView reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "scarp/base/vec.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::io {

/// Writes the values of entries first ... last − 1 of an array, one entry after the other.
template <class Value>
using Copy = std::function<void(std::size_t first, std::size_t last, Value* values)>;

/// One array over points or cells: `components` values for each. It is asked for a few thousand entries at a time while
/// the file is written, so that a frame takes no memory of the size of the points'.
struct Field {
  std::string name;
  int components = 1;
  std::variant<Copy<double>, Copy<std::int32_t>, Copy<std::int64_t>, Copy<std::uint8_t>> copy;
};

/// All values of a field over `count` entries. Throws std::bad_variant_access for a field of another type.
template <class Value>
std::vector<Value> values_of(const Field& field, std::size_t count) {
  std::vector<Value> values(count * static_cast<std::size_t>(field.components));
  std::get<Copy<Value>>(field.copy)(0, count, values.data());
  return values;
}

/// Writes `count` points as vertices with fields; `positions` has three components. Throws RunError where writing
/// fails.
void write_points_vtu(const std::string& path, std::size_t count, const Field& positions,
                      std::span<const Field> fields);

inline constexpr int most_elements_shown = 2'000'000;

/// Writes the mesh: triangles and quadrilaterals, or tetrahedra and hexahedra. Of a grid the elements with their
/// corners, whatever its shape functions; of one of more than most_elements_shown the frame, as one element.
template <int Dim>
void write_mesh_vtu(const std::string& path, const Mesh<Dim>& mesh);

}  // namespace scarp::io
