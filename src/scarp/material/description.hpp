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

struct Record;

/// A number, a word, a list of numbers or a list of tables: what a key in an input file may hold.
using Value = std::variant<double, std::string, std::vector<double>, std::vector<Record>>;
using Values = std::map<std::string, Value>;

/// One table of a list.
struct Record {
  Values keys;

  bool operator==(const Record& other) const { return keys == other.keys; }
};

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

/// What a setting holds: the alternatives of Value, in their order.
enum class SettingKind { number, text, numbers, records };

/// One key of a material that is not a plain number, such as the name of a file. Few models have some.
struct SettingInfo {
  std::string key;
  SettingKind kind;
  std::string takes;  ///< e.g. "text", "list of numbers"
  std::string meaning;
  bool required;
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
  std::vector<SettingInfo> settings = {};  ///< beside `parameters`
};

/// A constant or an initial value that the model cannot take. `key` names the input key it stands under.
struct Problem {
  std::string key, what, value, remedy;
};

}  // namespace scarp
