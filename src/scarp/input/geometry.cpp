// Numbers in space and the mesh of a case.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "scarp/input/readers.hpp"

namespace scarp::input {
namespace {

/// Number of elements along one direction of a grid, from their length.
int count_along(double size, double element, const std::string& axis, const Position& at) {
  const double count = std::round(size / element);
  if (std::abs(count * element - size) > 1e-9 * size || count < 1) {
    const double fitting = size / std::max(1.0, count);
    throw InputError(
        fmt::format("the grid's size along {} is a whole multiple of the element", axis),
        fmt::format("{} / {} = {:.6g}", size, element, size / element),
        fmt::format("take element = {:.6g}, or size = {:.6g} along {}", fitting, std::max(1.0, count) * element, axis),
        at);
  }
  if (count > 1e8)
    throw InputError("the grid has too many elements", fmt::format("{:.3g} along {}", count, axis),
                     "take larger elements", at);
  return static_cast<int>(count);
}

template <int Dim>
constexpr const char* size_remedy = Dim == 2 ? "give its width and height, size = [45.0, 20.0]"
                                             : "give its lengths along x, y and z, size = [45.0, 20.0, 20.0]";

/// Numbers of elements, given as such.
template <int Dim>
std::array<int, Dim> read_counts(const Node& node) {
  const auto numbers = vector_in<Dim>(node, "elements");
  std::array<int, Dim> counts;
  for (int j = 0; j < Dim; ++j) {
    if (numbers[j] < 1 || numbers[j] != std::floor(numbers[j]) || numbers[j] > 1e8) {
      throw InputError(fmt::format("elements are {} whole numbers of at least 1", Dim == 2 ? "two" : "three"),
                       fmt::format("{}", numbers[j]),
                       fmt::format("write elements = [90, 40{}], for instance", Dim == 2 ? "" : ", 40"), node.position);
    }
    counts[j] = static_cast<int>(numbers[j]);
  }
  return counts;
}

template <int Dim>
typename MeshInputOf<Dim>::GridInput read_grid(const Node& node) {
  Table table(node, "grid");
  typename MeshInputOf<Dim>::GridInput grid;
  if (const Node* origin = table.find("origin")) grid.origin = vector_in<Dim>(*origin, "origin");
  const Node& size = table.need("size", size_remedy<Dim>);
  grid.size = vector_in<Dim>(size, "size");
  for (const double length : grid.size) number_in({size.position, length}, "size", positive);
  const Node* counts = table.find("elements");
  const Node* element = table.find("element");
  if ((counts != nullptr) == (element != nullptr)) {
    throw InputError("a grid has either element, the size of an element, or elements, their numbers",
                     counts ? "both" : "neither", "write element = 0.5, for instance", node.position);
  }
  if (counts) {
    grid.elements = read_counts<Dim>(*counts);
  } else {
    Vec<Dim> lengths;
    if (element->is_list()) {
      lengths = vector_in<Dim>(*element, "element");
    } else {
      lengths.fill(number_in(*element, "element", positive));
    }
    for (int j = 0; j < Dim; ++j) {
      number_in({element->position, lengths[j]}, "element", positive);
      grid.elements[j] = count_along(grid.size[j], lengths[j], std::string(1, "xyz"[j]), element->position);
    }
  }
  table.finish();
  return grid;
}

}  // namespace

template <int Dim>
std::vector<double> numbers_of(const Node& node, const std::string& name, std::size_t plane, std::size_t space) {
  const std::size_t count = Dim == 2 ? plane : space, other = Dim == 2 ? space : plane;
  const auto* list = std::get_if<List>(&node.value);
  if (!list || list->size() != other) return numbers_in(node, name, count);
  throw InputError(fmt::format("{} is a list of {} numbers in {} dimensions", name, count, Dim == 2 ? "two" : "three"),
                   fmt::format("{} items", other),
                   Dim == 2
                       ? fmt::format("write {} numbers in brackets, or dimension = 3 at the top of the case", count)
                       : fmt::format("write {} numbers in brackets, or leave out dimension = 3", count),
                   node.position);
}

template <int Dim>
Vec<Dim> vector_in(const Node& node, const std::string& name) {
  const auto numbers = numbers_of<Dim>(node, name, 2, 3);
  Vec<Dim> result;
  std::copy(numbers.begin(), numbers.end(), result.begin());
  return result;
}

template <int Dim>
void refuse_keys(const Table& table, const std::vector<std::string>& keys, const std::string& remedy) {
  for (const auto& key : keys) {
    const Node* node = table.look(key);
    if (!node || node->is_table()) continue;  // no key of either takes a table: a slip of another kind
    throw InputError(
        fmt::format("{} is a key of cases in {} dimensions", key, Dim == 2 ? "three" : "two"), describe(*node),
        Dim == 2 ? fmt::format("{}; for three dimensions write dimension = 3 at the top of the case", remedy) : remedy,
        node->position);
  }
}

std::string resolved(const std::string& name, const std::string& case_path) {
  const std::filesystem::path path = name;
  return (path.is_absolute() ? path : std::filesystem::path(case_path).parent_path() / path).string();
}

std::string read_file_name(const Node& node, const std::string& key, const std::string& kind,
                           const std::string& case_path) {
  const auto file = resolved(text_in(node, key), case_path);
  std::error_code none;  // a name that no file can have is a file that is not there
  if (std::filesystem::is_regular_file(file, none)) return file;
  if (std::filesystem::exists(file, none))
    throw InputError(fmt::format("{} is a file", kind),
                     file + (std::filesystem::is_directory(file, none) ? ", a folder" : ", which is none"),
                     "name the file itself", node.position);
  throw InputError(fmt::format("{} file is not there", kind), file, "names are relative to the case file's folder",
                   node.position);
}

template <int Dim>
MeshInputOf<Dim> read_mesh(const Node& node, const std::string& case_path) {
  Table table(node, "[mesh]");
  MeshInputOf<Dim> mesh;
  mesh.position = node.position;
  const Node* grid = table.find("grid");
  const Node* file = table.find("file");
  if ((grid != nullptr) == (file != nullptr)) {
    throw InputError("[mesh] has either a file made by Gmsh or a grid", grid ? "both" : "neither",
                     fmt::format("write file = \"slope.msh\" or grid = {{ size = [45.0, 20.0{}], element = 0.5 }}",
                                 Dim == 2 ? "" : ", 20.0"),
                     node.position);
  }
  if (grid) {
    mesh.grid = read_grid<Dim>(*grid);
  } else {
    mesh.file = read_file_name(*file, "file", "the mesh", case_path);
  }
  table.finish();
  return mesh;
}

template MeshInputOf<2> read_mesh<2>(const Node&, const std::string&);
template MeshInputOf<3> read_mesh<3>(const Node&, const std::string&);
template std::vector<double> numbers_of<2>(const Node&, const std::string&, std::size_t, std::size_t);
template std::vector<double> numbers_of<3>(const Node&, const std::string&, std::size_t, std::size_t);
template Vec<2> vector_in<2>(const Node&, const std::string&);
template Vec<3> vector_in<3>(const Node&, const std::string&);
template void refuse_keys<2>(const Table&, const std::vector<std::string>&, const std::string&);
template void refuse_keys<3>(const Table&, const std::vector<std::string>&, const std::string&);

}  // namespace scarp::input
