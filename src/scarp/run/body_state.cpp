#include "scarp/run/body_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/base/error.hpp"
#include "scarp/base/hash.hpp"
#include "scarp/comm/alone.hpp"

namespace scarp::run {
namespace {

std::string of_region(std::size_t b) {
  return fmt::format("regions/{}", b);
}
std::string of_field(std::size_t f) {
  return fmt::format("fields/{}", f);
}

/// Names of the rows of a block's state, separated by blanks; a tensor has one for each Mandel component.
template <int Dim>
std::string state_names(const Block<Dim>& block) {
  std::vector<std::string> names;
  for (const auto& info : description_of(block.model).state) {
    const int rows = info.kind == FieldKind::tensor ? sym_size<Dim> : 1;
    for (int c = 0; c < rows; ++c) names.push_back(rows == 1 ? info.key : fmt::format("{}_{}", info.key, c));
  }
  const std::size_t columns = block.state.size();
  while (names.size() < columns) names.push_back(fmt::format("own_{}", names.size()));
  names.resize(columns);
  if (block.length > 0)
    names[columns - 3] = "kappa", names[columns - 2] = "kappa_hat", names[columns - 1] = "kappa_hat_rate";
  return fmt::format("{}", fmt::join(names, " "));
}

std::string components_key(const PointArray& info) {
  return fmt::format("{}_components", info.key);
}
constexpr const char* components_meaning = "which components the rows are; the others are not kept";

/// Of an array that not all schemes have, and of which some components may be left out.
template <std::size_t n>
void save_optional(const Saver& save, const PointArray& info, const std::array<Column, n>& member) {
  std::vector<Column> rows;
  std::vector<int> components;
  for (std::size_t c = 0; c < n; ++c) {
    if (member[c].empty()) continue;
    rows.push_back(member[c]);
    components.push_back(static_cast<int>(c));
  }
  if (rows.empty()) return;
  save(Entry{info.key, info.unit, info.meaning}, rows);
  save(Entry{components_key(info).c_str(), "", components_meaning}, components);
}

template <std::size_t n>
void load_optional(const Loader& load, const PointArray& info, std::array<Column, n>& member) {
  for (auto& column : member) column = {};
  if (!load.has(info.key)) return;
  std::vector<int> components;
  load(Entry{components_key(info).c_str(), "", ""}, components);
  std::vector<Column> rows(components.size());
  load(Entry{info.key, "", ""}, rows);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (components[k] >= 0 && components[k] < static_cast<int>(n))
      member[static_cast<std::size_t>(components[k])] = std::move(rows[k]);
  }
}

template <int Dim>
void save_block(const Saver& save, const Block<Dim>& block) {
  save(Entry{"name", "", "of the region"}, block.name);
  save(Entry{"model", "", "constitutive model"}, description_of(block.model).name);
  save(Entry{"length", "m", "over which the soil softens; 0: at each point by itself"}, block.length);
  const auto points = save.within("points");
  Points<Dim>::each(block.points, [&]<class Member>(const PointArray& info, const Member& member) {
    if (!info.saved) return;
    if constexpr (detail::is_array<Member>) {
      if (info.optional) return save_optional(points, info, member);
    }
    points(Entry{info.key, info.unit, info.meaning}, member);
  });
  save(Entry{"state", "as the model has it", "internal variables, a row each, compression positive"}, block.state);
  save(Entry{"state_names", "", "of the rows of state"}, state_names(block));
}

[[noreturn]] void refuse(const Loader& load, const std::string& region, const std::string& what,
                         const std::string& value) {
  throw InputError(fmt::format("region \"{}\" does not fit this file: {}", region, what),
                   value.empty() ? load.file_name() : fmt::format("{} in {}", value, load.file_name()),
                   "take a checkpoint of the same mesh, regions and models");
}

/// That a block is what the file has under its name.
template <int Dim>
void check_block(const Loader& load, const Block<Dim>& block) {
  std::string name, model, states;
  double length = 0;
  load(Entry{"name", "", ""}, name);
  load(Entry{"model", "", ""}, model);
  load(Entry{"length", "", ""}, length);
  load(Entry{"state_names", "", ""}, states);
  if (name != block.name) refuse(load, block.name, "the region in its place has another name", '"' + name + '"');
  const auto own = description_of(block.model).name;
  if (model != own)
    refuse(load, block.name, fmt::format("its model is \"{}\" here, and another there", own), '"' + model + '"');
  if ((length > 0) != (block.length > 0))
    refuse(load, block.name, "it softens over a length on one side only", fmt::format("length = {:g}", length));
  if (const auto names = state_names(block); names != states)
    refuse(load, block.name, fmt::format("its state variables are \"{}\" here", names), '"' + states + '"');
}

/// That all arrays have one length, and numbers that a step can go on with.
template <int Dim>
void check_points(const Loader& load, const Block<Dim>& block, int element_count) {
  const auto& points = block.points;
  const std::size_t count = points.mass.size();
  const auto check_size = [&](const std::string& key, std::size_t size) {
    if (size != count) refuse(load, block.name, fmt::format("{} has {} entries, mass has {}", key, size, count), "");
  };
  const auto check_numbers = [&](const std::string& key, const Column& column) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (!std::isfinite(column[i]))
        refuse(load, block.name, fmt::format("{} of point {} is not finite", key, points.id[i]),
               fmt::format("{}", column[i]));
    }
  };
  Points<Dim>::each(points, [&](const PointArray& info, const auto& member) {
    scarp::detail::for_each_in(member, [&]<class Array>(const Array& column) {
      if (!info.optional || !column.empty()) check_size(info.key, column.size());
    });
  });
  for (const auto& column : block.state) check_size("state", column.size());
  Points<Dim>::each(points, [&](const PointArray& info, const auto& member) {
    scarp::detail::for_each_in(member, [&]<class Array>(const Array& column) {
      if constexpr (std::is_same_v<Array, Column>) check_numbers(info.key, column);
    });
  });
  for (std::size_t i = 0; i < count; ++i) {
    if (!(points.mass[i] > 0 && points.volume[i] > 0 && points.initial_volume[i] > 0))
      refuse(load, block.name, fmt::format("mass and volumes of point {} are positive", points.id[i]),
             fmt::format("mass {}, volume {}", points.mass[i], points.volume[i]));
    if (points.element[i] < 0 || points.element[i] >= element_count || points.id[i] < 0)
      refuse(load, block.name, fmt::format("point {} is in no element of the mesh", points.id[i]),
             fmt::format("element {}", points.element[i]));
  }
  auto ids = points.id;
  std::sort(ids.begin(), ids.end());
  if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
    refuse(load, block.name, "two points have one id", fmt::format("id {}", *twice));
}

/// Finds the elements of points from their positions.
template <int Dim>
void find_elements(const Loader& load, const Body<Dim>& body, Block<Dim>& block) {
  auto& points = block.points;
  SearchCounts unused;
  for (int i = 0; i < block.size(); ++i) {
    const auto found = body.locator.find(position_of(points, i), points.element[i], unused);
    if (found.element == points.element[i]) continue;
    if (found.element < 0)
      refuse(load, block.name, fmt::format("point {} is outside the mesh", points.id[i]),
             fmt::format("a point at ({:.6g})", fmt::join(position_of(points, i), ", ")));
    points.element[i] = found.element;
    for (int j = 0; j < Dim && !points.xi[j].empty(); ++j) points.xi[j][i] = found.xi[j];
  }
}

template <int Dim>
void load_block(const Loader& load, Elements elements, const Body<Dim>& body, Block<Dim>& block) {
  check_block(load, block);
  const auto points = load.within("points");
  Points<Dim>::each(block.points, [&]<class Member>(const PointArray& info, Member& member) {
    if (!info.saved) return;
    if constexpr (detail::is_array<Member>) {
      if (info.optional) return load_optional(points, info, member);
    }
    points(Entry{info.key, info.unit, info.meaning}, member);
  });
  load(Entry{"state", "", ""}, block.state);
  check_points(load, block, body.mesh->element_count());
  const auto& xi = block.points.xi;
  const bool lacks = std::any_of(xi.begin(), xi.end(), [](const Column& column) { return column.empty(); });
  if (!body.mesh->grid && lacks && block.size() > 0)
    refuse(load, block.name, "its points lack local coordinates (xi), or one of them", "");
  if (elements == Elements::by_place) find_elements(load, body, block);
}

/// What a step leaves at elements and nodes for the next one, of those that it concerns.
template <int Dim>
struct Left {
  std::vector<int> element, due;
  Column weight, least_per_mass;
  int age = 0, averages = 0;
  double least_mass = 0;
  std::vector<int> release_node;
  std::vector<Vec<Dim>> imbalance;
  Column release_mass;
  std::vector<int> side_node;
  std::vector<std::uint8_t> fixed;
  std::vector<Vec<Dim>> R, C, C_soil, k, u, gamma;
  Column side_mass;

  template <class Self, class F>
  static void each_saved(Self& l, F&& f) {
    f(Entry{"least_mass", "Mg", "nodes with less are left out"}, l.least_mass);
    f(Entry{"averages", "", "steps since the last average over lengths"}, l.averages);
    const auto elements = f.within("elements");
    elements(Entry{"element", "", "numbers of the elements that hold points"}, l.element);
    elements(Entry{"weight", "", "w of their quadrature in the last step"}, l.weight);
    elements(
        Entry{"least_per_mass", "1/s2", "what nodes say of the time step, where there are triangles or tetrahedra"},
        l.least_per_mass);
    elements(Entry{"due", "", "elements of which that is to be found in the next step"}, l.due);
    elements(Entry{"age", "", "steps since it was found for all"}, l.age);
    const auto release = f.within("release");
    release(Entry{"node", "", "nodes at which the imbalance at the start of the stage is held back"}, l.release_node);
    release(Entry{"imbalance", "m/s2", "force held back at full share, over the mass"}, l.imbalance);
    release(Entry{"mass", "Mg", "of the nodes then"}, l.release_mass);
    const auto sides = f.within("sides");
    sides(Entry{"node", "", "nodes of absorbing sides"}, l.side_node);
    sides(Entry{"fixed", "", "bit j set where component j is held all the same"}, l.fixed);
    sides(Entry{"R", "kN", "force with which the node was held"}, l.R);
    sides(Entry{"C", "kN s/m", "impedance of the soil beyond, times area"}, l.C);
    sides(Entry{"C_soil", "kN s/m", "of the soil in front"}, l.C_soil);
    sides(Entry{"k", "kN/m", "stiffness of the soil beyond"}, l.k);
    sides(Entry{"u", "m", "how far the node has gone"}, l.u);
    sides(Entry{"gamma", "", "share of the node's velocity with which the side goes"}, l.gamma);
    sides(Entry{"mass", "Mg", "of the node when it was let go"}, l.side_mass);
  }
};

template <int Dim>
Left<Dim> left_by_steps(const Body<Dim>& body, const VelocityField<Dim>& field) {
  Left<Dim> left;
  const auto& bounds = field.buffers.bounds;
  left.element = field.active.element;
  left.weight = field.buffers.weight;
  left.least_mass = field.least_mass;
  left.averages = field.averages.steps;
  if (!bounds.least_per_mass.empty()) {
    for (const int e : left.element) left.least_per_mass.push_back(bounds.least_per_mass[e]);
  }
  left.due = bounds.due;
  left.age = bounds.age;
  const auto& [release, sides] = field.outside;
  for (int n = 0; n < static_cast<int>(release.mass.size()); ++n) {
    if (!(release.mass[n] > 0)) continue;
    left.release_node.push_back(n);
    left.imbalance.push_back(release.imbalance[n]);
    left.release_mass.push_back(release.mass[n]);
  }
  left.side_node.resize(sides.node.size());
  for (int n = 0; sides.active() && n < body.mesh->node_count(); ++n) {
    if (sides.holds(n)) left.side_node[static_cast<std::size_t>(sides.of_node[n])] = n;
  }
  for (std::size_t i = 0; i < sides.node.size(); ++i) {
    const auto& its = sides.node[i];
    left.fixed.push_back(body.conditions.fixed[left.side_node[i]]);
    left.R.push_back(its.R);
    left.C.push_back(its.C);
    left.C_soil.push_back(its.C_soil);
    left.k.push_back(its.k);
    left.u.push_back(its.u);
    left.gamma.push_back(its.gamma);
    left.side_mass.push_back(its.mass);
  }
  return left;
}

template <int Dim>
void check_left(const Loader& load, const Left<Dim>& left, const Mesh<Dim>& mesh) {
  const auto within = [](const std::vector<int>& numbers, int count) {
    return std::all_of(numbers.begin(), numbers.end(), [count](int n) { return n >= 0 && n < count; });
  };
  const std::size_t elements = left.element.size(), held = left.release_node.size(), sides = left.side_node.size();
  const auto sides_have = [sides](const auto&... each) { return ((each.size() == sides) && ...); };
  const bool fits = within(left.element, mesh.element_count()) && within(left.due, mesh.element_count()) &&
                    within(left.release_node, mesh.node_count()) && within(left.side_node, mesh.node_count()) &&
                    left.weight.size() == elements &&
                    (left.least_per_mass.empty() || left.least_per_mass.size() == elements) &&
                    left.imbalance.size() == held && left.release_mass.size() == held &&
                    sides_have(left.fixed, left.R, left.C, left.C_soil, left.k, left.u, left.gamma, left.side_mass);
  if (!fits)
    throw InputError("what this file keeps of elements and nodes does not fit the mesh, or itself", load.file_name(),
                     "take a checkpoint of the same mesh, and let arrays of one group have one length");
}

/// After reorder(), which takes all elements for new ones.
template <int Dim>
void put_back(const Left<Dim>& left, Body<Dim>& body, VelocityField<Dim>& field) {
  auto& bounds = field.buffers.bounds;
  field.least_mass = left.least_mass;
  field.averages.steps = left.averages;
  bounds.age = left.age;
  for (std::size_t i = 0; i < left.element.size(); ++i) {
    const int e = left.element[i], slot = field.active.slot[e];
    if (slot < 0) continue;  // its points were moved in the file
    field.buffers.weight[slot] = left.weight[i];
    if (!left.least_per_mass.empty() && !bounds.least_per_mass.empty())
      bounds.least_per_mass[e] = left.least_per_mass[i];
  }
  if (!bounds.is_due.empty() && !left.least_per_mass.empty()) {
    for (const int e : bounds.due) bounds.is_due[e] = 0;
    bounds.due = left.due;
    for (const int e : bounds.due) bounds.is_due[e] = 1;
  }
  auto& [release, sides] = field.outside;
  if (!left.release_node.empty()) {
    release.imbalance.assign(body.mesh->node_count(), {});
    release.mass.assign(body.mesh->node_count(), 0.0);
    for (std::size_t i = 0; i < left.release_node.size(); ++i) {
      release.imbalance[left.release_node[i]] = left.imbalance[i];
      release.mass[left.release_node[i]] = left.release_mass[i];
    }
  }
  if (!left.side_node.empty()) sides.of_node.resize(body.mesh->node_count());
  for (std::size_t i = 0; i < left.side_node.size(); ++i) {
    const int n = left.side_node[i];
    body.conditions.fixed[n] = left.fixed[i];
    sides.of_node.set(n, static_cast<int>(i));
    auto& its = sides.node.emplace_back();
    its.R = left.R[i];
    its.C = left.C[i];
    its.C_soil = left.C_soil[i];
    its.k = left.k[i];
    its.u = left.u[i];
    its.gamma = left.gamma[i];
    its.mass = left.side_mass[i];
  }
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
    Left<Dim>::each_saved(left, group);
  }
}

template <int Dim>
void load_points(const Loader& load, Elements elements, Body<Dim>& body) {
  std::size_t b = 0;
  double lightest = std::numeric_limits<double>::infinity();
  for (auto& block : body.blocks()) {
    const auto group = load.within(of_region(b++));
    if (!group.has("name")) refuse(load, block.name, "it has fewer regions", fmt::format("{}", b - 1));
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
    Left<Dim> left;
    Left<Dim>::each_saved(left, load.within(of_field(f++)));
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
