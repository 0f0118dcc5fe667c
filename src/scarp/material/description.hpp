// What a constitutive model declares of itself; input keys, bounds, output fields and documents come from it.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace scarp {

/// A number, a word, or a list of numbers: what a key in an input file may hold.
using Value = std::variant<double, std::string, std::vector<double>>;
using Values = std::map<std::string, Value>;

struct Bound {
  double value;
  bool open;  ///< the value itself is not allowed
};

/// One constant of a model. Every constant is a finite double.
struct ParameterInfo {
  std::string key;     ///< the key in input files, e.g. "kappa"
  std::string symbol;  ///< as in the documents, e.g. "κ̄"
  std::string unit;    ///< "-", "stress", ...
  std::string meaning;
  std::optional<Bound> low, high;
  std::optional<double> standard;  ///< used where the key is left out; without it the key is required
  std::string standard_key = {};   ///< or: the value of that constant is used
};

enum class FieldKind { scalar, tensor };  ///< a tensor turns with the body

/// One state variable or derived quantity, as it appears in output files.
struct FieldInfo {
  std::string key;
  std::string symbol;
  std::string unit;
  std::string meaning;
  FieldKind kind;
};

/// One key of a region's initial state: which kinds of value it takes, and what they mean.
struct InitialInfo {
  std::string key;
  std::string takes;  ///< e.g. "number > 0", "\"isotropic\", \"K0\" or 6 numbers"
  std::string meaning;
};

struct ModelDescription {
  std::string name;
  std::string summary;  ///< one line
  std::vector<ParameterInfo> parameters;
  std::vector<FieldInfo> state;    ///< without the stress
  std::vector<FieldInfo> derived;  ///< functions of the state that users want to see, e.g. R
  std::vector<InitialInfo> initial;
};

/// A constant or an initial value that the model cannot take. `key` names the input key it stands under.
struct Problem {
  std::string key, what, value, remedy;
};

}  // namespace scarp
