#include "scarp/io/vtu.hpp"

#include <fmt/format.h>
#include <bit>
#include <cstddef>

#include "scarp/base/error.hpp"
#include "scarp/io/file.hpp"
#include "scarp/mesh/grid.hpp"

namespace scarp::io {
namespace {

static_assert(std::endian::native == std::endian::little, "the files declare little-endian data");

template <class Value>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<Value, double>) return "Float64";
  if constexpr (std::is_same_v<Value, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<Value, std::int64_t>) return "Int64";
  return "UInt8";
}

/// Collects the XML of one piece and the bytes that follow it.
class Piece {
 public:
  Piece(std::size_t points, std::size_t cells) {
    xml_ = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        points, cells);
  }

  void open(const char* section) { xml_ += fmt::format("<{}>\n", section); }
  void close(const char* section) { xml_ += fmt::format("</{}>\n", section); }

  template <class Value>
  void array(const std::string& name, int components, std::span<const Value> values) {
    xml_ += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        type_name<Value>(), name, components, bytes_.size());
    const std::uint64_t size = values.size_bytes();
    append(&size, sizeof size);
    append(values.data(), values.size_bytes());
  }

  std::string file() {
    return xml_ + "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" + bytes_ +
           "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  void append(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

  std::string xml_, bytes_;
};

void cells(Piece& piece, std::span<const std::int64_t> connectivity, std::span<const std::int64_t> offsets,
           std::span<const std::uint8_t> types) {
  piece.open("Cells");
  piece.array("connectivity", 1, connectivity);
  piece.array("offsets", 1, offsets);
  piece.array("types", 1, types);
  piece.close("Cells");
}

/// VTK's number of a cell type; its local nodes run as ours do.
std::uint8_t cell_type(ElementType type) {
  switch (type) {
    case ElementType::T3:
      return 5;
    case ElementType::Q4:
      return 9;
    case ElementType::T4:
      return 10;
    default:
      return 12;
  }
}

}  // namespace

void write_points_vtu(const std::string& path, std::span<const double> positions, std::span<const Field> fields) {
  const std::size_t count = positions.size() / 3;
  Piece piece(count, count);
  piece.open("PointData");
  for (const auto& field : fields) {
    std::visit(
        [&]<class Value>(const std::vector<Value>& data) {
          if (data.size() != count * static_cast<std::size_t>(field.components)) {
            throw RunError(
                fmt::format("the field {} does not fit the points", field.name),
                fmt::format("{} values for {} points of {} components", data.size(), count, field.components),
                "this is an error of the program");
          }
          piece.array(field.name, field.components, std::span<const Value>(data));
        },
        field.data);
  }
  piece.close("PointData");
  piece.open("Points");
  piece.array("Points", 3, positions);
  piece.close("Points");
  std::vector<std::int64_t> connectivity(count), offsets(count);
  for (std::size_t i = 0; i < count; ++i) {
    connectivity[i] = static_cast<std::int64_t>(i);
    offsets[i] = static_cast<std::int64_t>(i + 1);
  }
  constexpr std::uint8_t vertex = 1;
  const std::vector<std::uint8_t> types(count, vertex);
  cells(piece, connectivity, offsets, types);
  write_whole(path, piece.file());
}

namespace {

/// Corners and elements of a mesh.
template <int Dim>
void write_elements(const std::string& path, const Mesh<Dim>& mesh) {
  Piece piece(mesh.nodes.size(), mesh.types.size());
  std::vector<double> positions(3 * mesh.nodes.size(), 0.0);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    for (int k = 0; k < Dim; ++k) positions[3 * n + k] = mesh.nodes[n][k];
  piece.open("Points");
  piece.array("Points", 3, std::span<const double>(positions));
  piece.close("Points");
  const std::vector<std::int64_t> connectivity(mesh.connectivity.begin(), mesh.connectivity.end());
  const std::vector<std::int64_t> offsets(mesh.offsets.begin() + 1, mesh.offsets.end());
  std::vector<std::uint8_t> types;
  for (const auto type : mesh.types) types.push_back(cell_type(type));
  cells(piece, connectivity, offsets, types);
  write_whole(path, piece.file());
}

}  // namespace

template <int Dim>
void write_mesh_vtu(const std::string& path, const Mesh<Dim>& mesh) {
  if (!mesh.grid || mesh.grid->functions == GridFunctions::linear) return write_elements(path, mesh);
  Vec<Dim> size;
  for (int k = 0; k < Dim; ++k) size[k] = mesh.grid->spacing[k] * mesh.grid->elements[k];
  write_elements(path, make_grid<Dim>(mesh.grid->origin, size, mesh.grid->elements));
}

template void write_mesh_vtu(const std::string&, const Mesh<2>&);
template void write_mesh_vtu(const std::string&, const Mesh<3>&);

}  // namespace scarp::io
