// VTK XML files of unstructured grids (.vtu), appended raw binary: what ParaView reads.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "scarp/base/vec.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::io {

/// One array over points or cells: `components` values for each, one after the other.
struct Field {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint8_t>> data;
};

/// Writes points as vertices with fields. `positions` has three coordinates a point. Throws RunError where writing
/// fails or a field does not have components × points values.
void write_points_vtu(const std::string& path, std::span<const double> positions, std::span<const Field> fields);

/// Writes the mesh: triangles and quadrilaterals, or tetrahedra and hexahedra. Of a grid the elements with their
/// corners, whatever its shape functions.
template <int Dim>
void write_mesh_vtu(const std::string& path, const Mesh<Dim>& mesh);

}  // namespace scarp::io
