// Readers of the tables of a case file. Each throws InputError for the first thing wrong in its table.
#pragma once

#include <array>

#include "scarp/input/case.hpp"
#include "scarp/input/table.hpp"

namespace scarp::input {

/// The keys whose texts are names of files, in whatever table they are.
inline constexpr std::array keys_of_files{"file", "stl", "library"};

// Relative names of files start at the folder of the case file, `case_path`. Those with Dim are there for 2 and 3.
template <int Dim>
MeshInputOf<Dim> read_mesh(const Node& node, const std::string& case_path);
MaterialInput read_material(const Node& node, const std::string& case_path);
template <int Dim>
RegionInputOf<Dim> read_region(const Node& node, const std::vector<MaterialInput>& materials,
                               const std::string& case_path);
template <int Dim>
BoundaryInput read_boundary(const Node& node);
template <int Dim>
StageInputOf<Dim> read_stage(const Node& node, const std::string& case_path);
MethodInput read_method(const Node& node);
OutputInput read_output(const Node& node);

/// The model that `table` names, with the constants and settings that are its other keys not read before. Names of
/// files in it start at the folder of `file`.
AnyModel read_law(Table& table, const std::string& file);

/// The keys of `table` not read before, as initial values of the model; `places` says where each stands.
Values read_initial(Table& table, const AnyModel& model, std::map<std::string, Position>& places);

/// Where the soil of `table` is; `name` is how messages call the table, such as "the region". In two dimensions a
/// polygon: at least three corners, an area, no crossing edges. In three a box, a polygon with its extent along the
/// third axis, or a closed surface from an STL file.
template <int Dim>
Place<Dim> read_place(Table& table, const std::string& name, const std::string& case_path);

/// Two opposite corners [x, y, z], in any order.
BoxOf<3> read_box(const Node& node);

/// A name in a case, from where the program runs.
std::string resolved(const std::string& name, const std::string& case_path);

/// A file that the case names; an error where it is not there. `kind` is how messages call it, such as "the mesh".
std::string read_file_name(const Node& node, const std::string& key, const std::string& kind,
                           const std::string& case_path);

/// A list of `plane` numbers in two dimensions, of `space` numbers in three; says so where it has the other number.
template <int Dim>
std::vector<double> numbers_of(const Node& node, const std::string& name, std::size_t plane, std::size_t space);
template <int Dim>
Vec<Dim> vector_in(const Node& node, const std::string& name);

/// Refuses keys that belong to the other number of dimensions.
template <int Dim>
void refuse_keys(const Table& table, const std::vector<std::string>& keys, const std::string& remedy);

}  // namespace scarp::input
