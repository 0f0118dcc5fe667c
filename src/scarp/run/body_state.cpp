#include "scarp/run/body_state.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

#include "scarp/base/error.hpp"
#include "scarp/base/hash.hpp"
#include "scarp/comm/alone.hpp"
#include "scarp/run/block_state.hpp"
#include "scarp/run/field_state.hpp"

namespace scarp::run {
namespace {

std::string of_region(std::size_t b) {
  return fmt::format("regions/{}", b);
}
std::string of_field(std::size_t f) {
  return fmt::format("fields/{}", f);
}

}  // namespace

template <int Dim>
std::size_t size_of_state(const Body<Dim>& body) {
  std::size_t bytes = 0;
  for (const auto& block : body.blocks()) {
    for_each_column(block, [&bytes]<class Array>(const Array& column) {
      bytes += column.size() * sizeof(typename Array::value_type);
    });
  }
  return bytes;
}

template <int Dim>
void save_body(const Saver& save, const Body<Dim>& body) {
  std::size_t b = 0;
  for (const auto& block : body.blocks()) save_block(save.within(of_region(b++)), block);
  std::size_t f = 0;
  for (const auto& field : body.fields) {
    const auto group = save.within(of_field(f++));
    group(Entry{"name", "", "of the field of velocity"}, field.name);
    const auto left = left_by_steps(body, field);
    LeftBySteps<Dim>::each_saved(left, group);
  }
}

template <int Dim>
void load_points(const Loader& load, Elements elements, Body<Dim>& body) {
  std::size_t b = 0;
  double lightest = std::numeric_limits<double>::infinity();
  for (auto& block : body.blocks()) {
    const auto group = load.within(of_region(b++));
    if (!group.has("name")) refuse_region(load, block.name, "it has fewer regions", fmt::format("{}", b - 1));
    load_block(group, elements, body, block);
    for (const double m : block.points.mass) lightest = std::min(lightest, m);
  }
  if (load.within(of_region(b)).has("name"))
    throw InputError("this file has more regions than the case", load.file_name(),
                     "give the case all regions of the run that it starts from, in their order");
  for (auto& field : body.fields) field.least_mass = 1e-12 * comm::least_of_all(lightest);
  if (body.point_count() == 0) throw InputError("this file has no points", load.file_name(), "take another one");
  take_up_points(body);
}

template <int Dim>
void load_body(const Loader& load, Elements elements, Body<Dim>& body) {
  load_points(load, elements, body);
  std::size_t f = 0;
  for (auto& field : body.fields) {
    LeftBySteps<Dim> left;
    LeftBySteps<Dim>::each_saved(left, load.within(of_field(f++)));
    check_left(load, left, *body.mesh);
    put_back(left, body, field);
  }
}

template <int Dim>
std::string mesh_hash(const Mesh<Dim>& mesh) {
  Hash hash;
  const auto add = [&hash]<class T>(const T& value) { hash.add(&value, sizeof value); };
  const auto add_all = [&hash]<class T>(const std::vector<T>& values) {
    hash.add(values.data(), values.size() * sizeof(T));
  };
  add(Dim);
  add(mesh.axisymmetric);
  if (mesh.grid) {
    add(mesh.grid->origin);
    add(mesh.grid->spacing);
    add(mesh.grid->elements);
    add(static_cast<int>(mesh.grid->functions));
  } else {
    add_all(mesh.lists.nodes);
    add_all(mesh.lists.types);
    add_all(mesh.lists.connectivity);
  }
  return hash.digits();
}

template std::size_t size_of_state<2>(const Body<2>&);
template std::size_t size_of_state<3>(const Body<3>&);
template void save_body<2>(const Saver&, const Body<2>&);
template void save_body<3>(const Saver&, const Body<3>&);
template void load_points<2>(const Loader&, Elements, Body<2>&);
template void load_points<3>(const Loader&, Elements, Body<3>&);
template void load_body<2>(const Loader&, Elements, Body<2>&);
template void load_body<3>(const Loader&, Elements, Body<3>&);
template std::string mesh_hash<2>(const Mesh<2>&);
template std::string mesh_hash<3>(const Mesh<3>&);

}  // namespace scarp::run
