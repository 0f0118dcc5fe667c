// A case as plain data: what a TOML file says, checked. No physics, no parser types.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scarp/base/error.hpp"
#include "scarp/base/polygon.hpp"
#include "scarp/material/models.hpp"

namespace scarp::input {

/// [mesh]: either a grid or a Gmsh file.
struct MeshInput {
  struct GridInput {
    Vec<2> origin{}, size{};
    std::array<int, 2> elements{};
  };
  std::optional<GridInput> grid;
  std::optional<std::string> file;  ///< absolute, or relative to the working directory (resolved from the case file)
  Position position;
};

/// [[material]]
struct MaterialInput {
  std::string name;
  AnyModel model;      ///< constructed and checked
  double density = 0;  ///< [Mg/m3]
  Position position;
};

/// [[region]]: a polygon filled with points at its own spacing, one material, one rule for the initial state.
struct RegionInput {
  std::string name;
  std::size_t material = 0;  ///< index into Case::materials
  Polygon polygon;
  double spacing = 0;        ///< distance between points [m]
  Vec<2> velocity{};         ///< initial velocity [m/s]
  std::optional<double> K0;  ///< horizontal over vertical effective stress; not set: from the model
  std::optional<std::array<double, 4>>
      stress;      ///< uniform (xx, yy, zz, xy), compression positive, instead of the weight above
  Values initial;  ///< keys that the model declares for its initial state
  Position position;
};

/// [[boundary]]: nodes of a named set, or within round-off of a segment.
struct BoundaryInput {
  std::optional<std::string> nodes;  ///< name of a node set of the mesh
  std::optional<std::array<Vec<2>, 2>> line;
  bool fix_x = false, fix_y = false;
  std::optional<double> friction;  ///< coefficient on a wall; the fixed component is the wall's normal
  Position position;
};

/// Soil taken away during a stage, from the top down.
struct RemovalInput {
  Polygon polygon;
  int lifts = 1;
  double over = 0;  ///< time between the first and the last lift [s]
};

/// When a stage may end before its duration.
struct RestInput {
  double unbalanced = 1e-3;  ///< unbalanced force ratio
  double kinetic = 1e-6;     ///< kinetic energy over the potential energy that the body's weight has over its height
  double hold = 0;           ///< both for this long [s]
  bool required = true;      ///< not at rest by the end of the duration: an error (true) or simply the end (false)
};

/// [[stage]]
struct StageInput {
  std::string name;
  double duration = 0;             ///< [s]
  double damping = 0;              ///< local (non-viscous) damping coefficient, 0 to below 1
  std::optional<double> flip;      ///< overrides MethodInput::flip
  bool zero_displacement = false;  ///< set displacements and eps_q to zero at the start
  bool zero_velocity = false;      ///< set velocities to zero at the start
  std::optional<RemovalInput> remove;
  std::optional<RestInput> rest;
  Position position;
};

/// [method]
struct MethodInput {
  double flip = 1.0;                 ///< share of FLIP in the velocity update; 1 is the report's
  bool corrected_quadrature = true;  ///< inside the soil; false: eq. 4 of the report as printed
  double safety = 0.5;               ///< of the critical time step
  double tolerance = 1e-4;           ///< of the stress integration, relative
  bool remove_leaving = false;       ///< a point that leaves the mesh is removed and counted, instead of an error
  int largest_failures = 0;          ///< failed stress updates before the run stops
};

/// [output]
struct OutputInput {
  double every = 0;                     ///< time between frames [s]; 0: only at the start and end of each stage
  double history = 0;                   ///< time between rows of history.csv [s]; 0: every step
  std::string colour = "displacement";  ///< field that `scarp plot` shows unless told otherwise
};

struct Case {
  std::string title;
  std::string path;  ///< of the case file
  Vec<2> gravity{0.0, -9.81};
  MeshInput mesh;
  std::vector<MaterialInput> materials;
  std::vector<RegionInput> regions;
  std::vector<BoundaryInput> boundaries;
  std::vector<StageInput> stages;
  MethodInput method;
  OutputInput output;
};

/// Reads and checks a case. `overrides` are "key=value" texts from --set: dotted keys into the file, items of
/// arrays of tables by their name or their number from 0 ("stage.cut.duration=4", "material.clay.c_b=10").
/// Throws InputError with file, line and column for the first thing wrong.
Case read_case(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace scarp::input
