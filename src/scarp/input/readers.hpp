// Readers of the tables of a case file. Each throws InputError for the first thing wrong in its table.
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/input/table.hpp"

namespace scarp::input {

MeshInput read_mesh(const Node& node, const std::string& case_path);
MaterialInput read_material(const Node& node, const std::string& case_path);
RegionInput read_region(const Node& node, const std::vector<MaterialInput>& materials);
BoundaryInput read_boundary(const Node& node);
StageInput read_stage(const Node& node);
MethodInput read_method(const Node& node);
OutputInput read_output(const Node& node);

/// The model that `table` names, with the constants and settings that are its other keys not read before. Names of
/// files in it start at the folder of `file`.
AnyModel read_law(Table& table, const std::string& file);

/// The keys of `table` not read before, as initial values of the model; `places` says where each stands.
Values read_initial(Table& table, const AnyModel& model, std::map<std::string, Position>& places);

/// A polygon: at least three corners, an area, no crossing edges.
Polygon read_polygon(const Node& node, const std::string& name);

}  // namespace scarp::input
