// A laboratory test on one stress point, as plain data. Compression positive; z is the vertical.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scarp/material/models.hpp"

namespace scarp::lab {

/// Tensor components xx, yy, zz, xy, yz, zx, each shear once (strain: half of gamma).
using Six = std::array<double, 6>;
inline constexpr std::array<const char*, 6> component_names{"xx", "yy", "zz", "xy", "yz", "zx"};

/// A linear form of strain and stress, E·ε + S·σ.
struct LinearForm {
  Six E{}, S{};
};

/// Total strains since the start of the test, reached in turn in straight lines.
struct StrainPath {
  std::vector<Six> strains;
};

/// Six linear constraints E·dε + S·dσ = b over the stage, or over each of its legs.
struct Constraints {
  std::array<LinearForm, 6> forms{};
  Six b{};
  /// When not empty, each is a leg: the sixth form is brought to this value, counted from the start of the stage where
  /// `from_start` says so. b[5] is then not used.
  std::vector<double> targets;
  bool from_start = false;
  /// Component of stress whose total value stays constant while water cannot leave: u grows as the effective one falls.
  std::optional<std::size_t> cell;
};

/// Ends a stage when the quantity of this column first reaches the value.
struct Stop {
  std::string column;
  double value;
};

struct Stage {
  std::string type;  ///< for messages
  std::variant<StrainPath, Constraints> path;
  int increments = 1;   ///< of each leg; a strain path has one for each of its strains
  double duration = 0;  ///< [s]; acts on models that depend on time
  std::vector<Stop> stops;
};

enum class Scheme { modified_euler, dormand_prince };

struct Test {
  AnyModel model;
  Six stress{};    ///< initial effective stress
  Values initial;  ///< keys that the model declares for its initial state
  Scheme scheme = Scheme::dormand_prince;
  double tolerance = 1e-7;  ///< relative error of a substep
  std::vector<Stage> stages;
};

}  // namespace scarp::lab
