#include "scarp/io/vtu.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cstddef>

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

/// Collects the XML of one piece; the bytes follow it when all arrays are known.
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

  void array(const Field& field, std::size_t count) {
    std::visit(
        [&]<class Value>(const Copy<Value>& copy) {
          xml_ += fmt::format(
              "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
              type_name<Value>(), field.name, field.components, bytes_);
          const std::size_t values = count * static_cast<std::size_t>(field.components);
          bytes_ += sizeof(std::uint64_t) + values * sizeof(Value);
          const auto components = static_cast<std::size_t>(field.components);
          arrays_.push_back([=](WholeFile& file) { write(file, copy, count, components); });
        },
        field.copy);
  }

  void write_to(const std::string& path) const {
    WholeFile file(path);
    file.write(xml_);
    file.write("</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    for (const auto& write_array : arrays_) write_array(file);
    file.write("\n</AppendedData>\n</VTKFile>\n");
    file.finish();
  }

 private:
  template <class Value>
  static void write(WholeFile& file, const Copy<Value>& copy, std::size_t count, std::size_t components) {
    constexpr std::size_t chunk = 4096;
    const std::uint64_t size = count * components * sizeof(Value);
    file.write(&size, sizeof size);
    std::vector<Value> values(std::min(count, chunk) * components);
    for (std::size_t first = 0; first < count; first += chunk) {
      const std::size_t last = std::min(count, first + chunk);
      copy(first, last, values.data());
      file.write(values.data(), (last - first) * components * sizeof(Value));
    }
  }

  std::string xml_;
  std::size_t bytes_ = 0;
  std::vector<std::function<void(WholeFile&)>> arrays_;
};

/// value(i) for each entry.
template <class Value, class F>
Field field_of(const char* name, F value) {
  return {name, 1, Copy<Value>([value](std::size_t first, std::size_t last, Value* values) {
            for (std::size_t i = first; i < last; ++i) values[i - first] = static_cast<Value>(value(i));
          })};
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

void write_points_vtu(const std::string& path, std::size_t count, const Field& positions,
                      std::span<const Field> fields) {
  Piece piece(count, count);
  piece.open("PointData");
  for (const auto& field : fields) piece.array(field, count);
  piece.close("PointData");
  piece.open("Points");
  piece.array(positions, count);
  piece.close("Points");
  constexpr int vertex = 1;
  piece.open("Cells");
  piece.array(field_of<std::int64_t>("connectivity", [](std::size_t i) { return i; }), count);
  piece.array(field_of<std::int64_t>("offsets", [](std::size_t i) { return i + 1; }), count);
  piece.array(field_of<std::uint8_t>("types", [](std::size_t) { return vertex; }), count);
  piece.close("Cells");
  piece.write_to(path);
}

namespace {

/// Local nodes of all elements one after the other, and where those of each element end.
template <int Dim>
void write_connectivity(Piece& piece, const Mesh<Dim>& mesh) {
  const auto elements = static_cast<std::size_t>(mesh.element_count());
  if (!mesh.grid) {
    const auto& lists = mesh.lists;
    piece.array(field_of<std::int64_t>("connectivity", [&](std::size_t i) { return lists.connectivity[i]; }),
                lists.connectivity.size());
    piece.array(field_of<std::int64_t>("offsets", [&](std::size_t e) { return lists.offsets[e + 1]; }), elements);
    return;
  }
  constexpr std::size_t each = 1u << Dim;  // of linear functions
  piece.array({"connectivity", 1, Copy<std::int64_t>([&](std::size_t first, std::size_t last, std::int64_t* values) {
                 for (std::size_t i = first; i < last;) {
                   const auto nodes = mesh.element_nodes(static_cast<int>(i / each));
                   do *values++ = nodes[i % each];
                   while (++i < last && i % each != 0);
                 }
               })},
              elements * each);
  piece.array(field_of<std::int64_t>("offsets", [](std::size_t e) { return (e + 1) * each; }), elements);
}

/// Corners and elements of a mesh; those of a grid are the nodes of linear functions.
template <int Dim>
void write_elements(const std::string& path, const Mesh<Dim>& mesh) {
  const auto nodes = static_cast<std::size_t>(mesh.node_count()),
             elements = static_cast<std::size_t>(mesh.element_count());
  Piece piece(nodes, elements);
  piece.open("Points");
  piece.array({"Points", 3, Copy<double>([&mesh](std::size_t first, std::size_t last, double* values) {
                 for (std::size_t n = first; n < last; ++n) {
                   const Vec<Dim> x = mesh.node(static_cast<int>(n));
                   for (int k = 0; k < 3; ++k) *values++ = k < Dim ? x[k] : 0.0;
                 }
               })},
              nodes);
  piece.close("Points");
  piece.open("Cells");
  write_connectivity(piece, mesh);
  piece.array(
      field_of<std::uint8_t>("types", [&](std::size_t e) { return cell_type(mesh.type_of(static_cast<int>(e))); }),
      elements);
  piece.close("Cells");
  piece.write_to(path);
}

}  // namespace

template <int Dim>
void write_mesh_vtu(const std::string& path, const Mesh<Dim>& mesh) {
  const bool is_large = mesh.grid && mesh.element_count() > most_elements_shown;
  if (!is_large && (!mesh.grid || mesh.grid->functions == GridFunctions::linear)) return write_elements(path, mesh);
  Vec<Dim> size;
  for (int k = 0; k < Dim; ++k) size[k] = mesh.grid->spacing[k] * mesh.grid->elements[k];
  auto elements = mesh.grid->elements;
  if (is_large) elements.fill(1);
  write_elements(path, make_grid<Dim>(mesh.grid->origin, size, elements));
}

template void write_mesh_vtu(const std::string&, const Mesh<2>&);
template void write_mesh_vtu(const std::string&, const Mesh<3>&);

}  // namespace scarp::io
