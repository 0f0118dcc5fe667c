#include "scarp/run/block_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

#include "scarp/base/error.hpp"

namespace scarp::run {

void refuse_region(const Loader& load, const std::string& region, const std::string& what, const std::string& value) {
  throw InputError(fmt::format("region \"{}\" does not fit this file: {}", region, what),
                   value.empty() ? load.file_name() : fmt::format("{} in {}", value, load.file_name()),
                   "take a checkpoint of the same mesh, regions and models");
}

namespace {

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
  std::vector<const Column*> rows;
  std::vector<int> components;
  for (std::size_t c = 0; c < n; ++c) {
    if (member[c].empty()) continue;
    rows.push_back(&member[c]);
    components.push_back(static_cast<int>(c));
  }
  if (rows.empty()) return;
  save.rows(Entry{info.key, info.unit, info.meaning}, rows);
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

/// That a block is what the file has under its name.
template <int Dim>
void check_block(const Loader& load, const Block<Dim>& block) {
  std::string name, model, states;
  double length = 0;
  load(Entry{"name", "", ""}, name);
  load(Entry{"model", "", ""}, model);
  load(Entry{"length", "", ""}, length);
  load(Entry{"state_names", "", ""}, states);
  if (name != block.name) refuse_region(load, block.name, "the region in its place has another name", '"' + name + '"');
  const auto own = description_of(block.model).name;
  if (model != own)
    refuse_region(load, block.name, fmt::format("its model is \"{}\" here, and another there", own), '"' + model + '"');
  if ((length > 0) != (block.length > 0))
    refuse_region(load, block.name, "it softens over a length on one side only", fmt::format("length = {:g}", length));
  if (const auto names = state_names(block); names != states)
    refuse_region(load, block.name, fmt::format("its state variables are \"{}\" here", names), '"' + states + '"');
}

/// That all arrays have one length, and numbers that a step can go on with.
template <int Dim>
void check_points(const Loader& load, const Block<Dim>& block, int element_count) {
  const auto& points = block.points;
  const std::size_t count = points.mass.size();
  const auto check_size = [&](const std::string& key, std::size_t size) {
    if (size != count)
      refuse_region(load, block.name, fmt::format("{} has {} entries, mass has {}", key, size, count), "");
  };
  const auto check_numbers = [&](const std::string& key, const Column& column) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (!std::isfinite(column[i]))
        refuse_region(load, block.name, fmt::format("{} of point {} is not finite", key, points.id[i]),
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
      refuse_region(load, block.name, fmt::format("mass and volumes of point {} are positive", points.id[i]),
                    fmt::format("mass {}, volume {}", points.mass[i], points.volume[i]));
    if (points.element[i] < 0 || points.element[i] >= element_count || points.id[i] < 0)
      refuse_region(load, block.name, fmt::format("point {} is in no element of the mesh", points.id[i]),
                    fmt::format("element {}", points.element[i]));
  }
  auto ids = points.id;
  std::sort(ids.begin(), ids.end());
  if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
    refuse_region(load, block.name, "two points have one id", fmt::format("id {}", *twice));
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
      refuse_region(load, block.name, fmt::format("point {} is outside the mesh", points.id[i]),
                    fmt::format("a point at ({:.6g})", fmt::join(position_of(points, i), ", ")));
    points.element[i] = found.element;
    for (int j = 0; j < Dim && !points.xi[j].empty(); ++j) points.xi[j][i] = found.xi[j];
  }
}

}  // namespace

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
    refuse_region(load, block.name, "its points lack local coordinates (xi), or one of them", "");
  if (elements == Elements::by_place) find_elements(load, body, block);
}

template void save_block<2>(const Saver&, const Block<2>&);
template void save_block<3>(const Saver&, const Block<3>&);
template void load_block<2>(const Loader&, Elements, const Body<2>&, Block<2>&);
template void load_block<3>(const Loader&, Elements, const Body<3>&, Block<3>&);

}  // namespace scarp::run
