// A case as plain data: what a TOML file says, checked. No physics, no parser types. What differs between two and three
// dimensions is a template; the short names are the plane ones.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scarp/base/error.hpp"
#include "scarp/base/polygon.hpp"
#include "scarp/base/solid.hpp"
#include "scarp/material/models.hpp"
#include "scarp/mesh/mesh.hpp"
#include "scarp/tensor/sym.hpp"

namespace scarp::input {

/// [mesh]: either a grid or a Gmsh file.
template <int Dim>
struct MeshInputOf {
  struct GridInput {
    Vec<Dim> origin{}, size{};
    std::array<int, Dim> elements{};
  };
  std::optional<GridInput> grid;
  std::optional<std::string> file;  ///< absolute, or relative to the working directory (resolved from the case file)
  Position position;
};
using MeshInput = MeshInputOf<2>;

/// [[material]]
struct MaterialInput {
  std::string name;
  AnyModel model;      ///< constructed and checked
  double density = 0;  ///< [Mg/m3]
  Position position;
  double length = 0;  ///< over which it softens [m]; 0: at each point by itself
  Position length_position;
};

/// Where soil is: a polygon in two dimensions, a solid in three; shape() in both.
template <int Dim>
struct Place;
template <>
struct Place<2> {
  Polygon polygon;
  const Polygon& shape() const { return polygon; }
};
template <>
struct Place<3> {
  Solid solid;
  const Solid& shape() const { return solid; }
};

/// [[region]]: a place filled with points at its own spacing, one material, one rule for the initial state.
template <int Dim>
struct RegionInputOf : Place<Dim> {
  std::string name;
  std::size_t material = 0;  ///< index into CaseOf::materials
  double spacing = 0;        ///< distance between points [m]
  Vec<Dim> velocity{};       ///< initial velocity [m/s]
  std::optional<double> K0;  ///< horizontal over vertical effective stress; not set: from the model
  std::optional<std::array<double, sym_size<Dim>>>
      stress;      ///< uniform (xx, yy, zz, xy(, yz, zx)), compression positive, instead of the weight above
  Values initial;  ///< keys that the model declares for its initial state
  Position position;
};
using RegionInput = RegionInputOf<2>;

/// [[boundary]]: nodes of a named set, or within round-off of a segment (two dimensions) or of a box (three).
struct BoundaryInput {
  std::optional<std::string> nodes;           ///< name of a node set of the mesh
  std::optional<std::array<Vec<2>, 2>> line;  ///< in two dimensions
  std::optional<BoxOf<3>> box;                ///< in three; may have no thickness
  bool fix_x = false, fix_y = false, fix_z = false;
  std::array<bool, 3> fixed() const { return {fix_x, fix_y, fix_z}; }
  std::optional<double> friction;  ///< coefficient on a wall; the fixed component is the wall's normal
  /// Soil beyond that absorbs, from the start of a stage on; fixed before that.
  struct Absorbing {
    std::string from;  ///< name of the stage
    std::optional<double> thickness;
    std::optional<std::array<double, 2>> impedance;
    Position position;  ///< of `from`
  };
  std::optional<Absorbing> absorbing;
  Position position;
};

/// Soil taken away during a stage, from the top down.
template <int Dim>
struct RemovalInputOf : Place<Dim> {
  int lifts = 1;
  double over = 0;  ///< time between the first and the last lift [s]
};
using RemovalInput = RemovalInputOf<2>;

/// When a stage may end before its duration.
struct RestInput {
  double unbalanced = 1e-3;  ///< unbalanced force ratio
  double kinetic = 1e-6;     ///< kinetic energy over the potential energy that the body's weight has over its height
  double rate = 2e-5;        ///< largest displacement of a point over `hold`, per height of the body [1/s]
  double hold = 0;           ///< all for this long [s]
  bool required = true;      ///< not at rest by the end of the duration: an error (true) or simply the end (false)
};

/// [[stage]]
template <int Dim>
struct StageInputOf {
  std::string name;
  double duration = 0;             ///< [s]
  double damping = 0;              ///< local (non-viscous) damping coefficient, 0 to below 1
  std::optional<double> flip;      ///< overrides MethodInput::flip, of the report's scheme
  double release = 0;              ///< time over which the initial imbalance is let go [s]
  bool zero_displacement = false;  ///< set displacements and eps_q to zero at the start
  bool zero_velocity = false;      ///< set velocities to zero at the start
  std::optional<RemovalInputOf<Dim>> remove;
  std::optional<RestInput> rest;
  Position position;
};
using StageInput = StageInputOf<2>;

/// How velocities go between points and nodes (step/scheme.hpp).
enum class SchemeName { two_term, report, apic };

/// [method]
struct MethodInput {
  SchemeName scheme = SchemeName::two_term;
  double flip = 1.0;  ///< of scheme "report": share of FLIP in the velocity update; 1 is the report's
  std::optional<Position> ignored_flip;  ///< where it is given with another scheme, which has no use for it
  double pic_time = 0.5;  ///< of scheme "two-term": time in which PIC takes what nodes do not see [s]; infinite: never
  std::optional<double> stress_damping;  ///< ξ, of critical at the shortest wave of an element; not set: by the law
  double stress_damping_time = 0;        ///< β [s], in place of ξ where positive
  GridFunctions shape = GridFunctions::linear;
  Position shape_position;
  bool corrected_quadrature = true;   ///< inside the soil; false: eq. 4 of the report as printed
  double safety = 0.8;                ///< of the critical time step; 0.5 unless given with scheme "report"
  double tolerance = 1e-4;            ///< of the stress integration, relative
  bool remove_leaving = false;        ///< a point that leaves the mesh is removed and counted, instead of an error
  int largest_failures = 0;           ///< failed stress updates before the run stops
  double largest_energy_error = 0.2;  ///< of the energies of the run, before it stops (run/energy_check.hpp); 0: any
};

/// [output] checkpoint: when the state of the run is kept besides at the ends of stages; 0: never for this reason.
struct CheckpointInput {
  double every = 600;      ///< [s] of wall clock
  std::int64_t steps = 0;  ///< after so many
  double time = 0;         ///< [s] of the soil's time
  int keep = 2;            ///< so many of these, the latest
  bool stages = true;      ///< at the end of each stage, too, where they are all kept
};

/// [start]: another run's state in place of the regions' initial one.
struct StartInput {
  std::string from;                  ///< folder of its results, or a checkpoint (resolved from the case file)
  std::optional<std::string> stage;  ///< the end of this stage; not set: the latest checkpoint
  bool edited = false;               ///< a checkpoint may have been changed by other programs
  Position position, stage_position;
};

/// [output]
struct OutputInput {
  double every = 0;                     ///< time between frames [s]; 0: only at the start and end of each stage
  double history = 0;                   ///< time between rows of history.csv [s]; 0: every step
  std::string colour = "displacement";  ///< field that `scarp plot` shows unless told otherwise
  CheckpointInput checkpoint;
};

template <int Dim>
struct CaseOf {
  static constexpr int dimension = Dim;
  bool axisymmetric = false;  ///< in two dimensions: x is the distance from the vertical axis of a body of revolution
  std::string title;
  std::string path;  ///< of the case file
  std::string text;  ///< the file as it was read; where values were overridden, TOML with these in their places
  Vec<Dim> gravity = down(9.81);
  MeshInputOf<Dim> mesh;
  std::vector<MaterialInput> materials;
  std::vector<RegionInputOf<Dim>> regions;
  std::vector<BoundaryInput> boundaries;
  std::vector<StageInputOf<Dim>> stages;
  MethodInput method;
  OutputInput output;
  std::optional<StartInput> start;

  /// A vector of this length along −y in two dimensions, −z in three.
  static constexpr Vec<Dim> down(double length) {
    Vec<Dim> v{};
    v[Dim - 1] = -length;
    return v;
  }
};
using Case = CaseOf<2>;
using AnyCase = std::variant<CaseOf<2>, CaseOf<3>>;

/// Reads and checks a case of the dimension that it names. `overrides` are "key=value" texts from --set: dotted keys
/// into the file, items of arrays of tables by their name or their number from 0 ("stage.cut.duration=4",
/// "material.clay.c_b=10"). Throws InputError with file, line and column for the first thing wrong.
AnyCase read_any_case(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same of a text that stands for the file at `path`.
AnyCase read_case_text(const std::string& text, const std::string& path);

/// The files that the text of a case names, besides the results that it starts from; names in it lead there from the
/// case's own folder, `path` being that of the case.
std::vector<std::string> files_of_case(const std::string& text, const std::string& path);

/// The same where only two dimensions will do; throws InputError for a case in three.
Case read_case(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace scarp::input
