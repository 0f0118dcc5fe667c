// Readers of the tables of a case file. Each throws InputError for the first thing wrong in its table.
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/input/table.hpp"

namespace scarp::input {

MeshInput read_mesh(const Node& node, const std::string& case_path);
MaterialInput read_material(const Node& node);
RegionInput read_region(const Node& node, const std::vector<MaterialInput>& materials);
BoundaryInput read_boundary(const Node& node);
StageInput read_stage(const Node& node);
MethodInput read_method(const Node& node);
OutputInput read_output(const Node& node);

/// A polygon: at least three corners, an area, no crossing edges.
Polygon read_polygon(const Node& node, const std::string& name);

}  // namespace scarp::input
