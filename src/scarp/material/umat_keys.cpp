// The keys of a material with model = "umat": what they are, and reading them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <set>

#include "scarp/material/umat.hpp"

namespace scarp {
namespace {

/// Names that columns of curves and fields of frames have already.
const std::set<std::string>& taken_names() {
  static const std::set<std::string> names{"id",          "region",
                                           "stage",       "displacement",
                                           "velocity",    "stress",
                                           "sig",         "eps",
                                           "p",           "q",
                                           "theta",       "eps_v",
                                           "eps_q",       "u",
                                           "volume",      "density",
                                           "time",        "substeps",
                                           "separated",   "on_floor",
                                           "corrected",   "failed",
                                           "umat_strain", "umat_stiffness",
                                           "umat_time",   "umat_increments"};
  return names;
}

const std::string state_remedy = "write state = [ { name = \"p_c\" }, { name = \"beta\", kind = \"tensor\" } ]";

std::string kind_name(Umat::Kind kind) {
  return kind == Umat::Kind::scalar ? "scalar" : kind == Umat::Kind::tensor ? "tensor" : "strain";
}

/// Reads state = [...], one table after the other.
class StateReader {
 public:
  explicit StateReader(std::vector<Problem>& problems) : problems_(problems) {}

  std::vector<Umat::Variable> read(const std::vector<Record>& records) {
    for (const auto& record : records) variable(record.keys);
    int size4 = 0, size6 = 0;
    for (const auto& v : state_) {
      size4 += v.kind == Umat::Kind::scalar ? 1 : 4;
      size6 += v.kind == Umat::Kind::scalar ? 1 : 6;
    }
    if (size6 > Umat::most_statev) {
      refuse(fmt::format("the state of an umat takes at most {} values", Umat::most_statev),
             fmt::format("{} (NSTATV = {} in plane strain)", size6, size4),
             "leave out what the routine does not need; scarp's limit is Umat::most_statev");
    }
    return state_;
  }

 private:
  void refuse(const std::string& what, const std::string& value, const std::string& remedy = state_remedy) {
    problems_.push_back({"state", fmt::format("state[{}]: {}", state_.size(), what), value, remedy});
  }

  void variable(const Values& keys) {
    Umat::Variable v{"", Umat::Kind::scalar, {}};
    for (const auto& [key, value] : keys) {
      if (key != "name" && key != "kind" && key != "initial")
        refuse("a variable has the keys name, kind and initial", key);
    }
    name(keys, v);
    kind(keys, v);
    initial(keys, v);
    state_.push_back(v);
  }

  void name(const Values& keys, Umat::Variable& v) {
    const auto found = keys.find("name");
    const auto* text = found == keys.end() ? nullptr : std::get_if<std::string>(&found->second);
    if (!text || text->empty()) return refuse("a variable has a name, a text", found == keys.end() ? "" : "no text");
    v.name = *text;
    if (!std::all_of(text->begin(), text->end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; }))
      refuse("a name has letters, digits and _", '"' + *text + '"');
    if (taken_names().contains(*text))
      refuse("this name is that of an output of scarp", '"' + *text + '"', "choose another");
    const auto same = [&](const Umat::Variable& other) { return other.name == *text; };
    if (std::any_of(state_.begin(), state_.end(), same))
      refuse("each variable has a name of its own", '"' + *text + "\" twice", "rename one of them");
  }

  void kind(const Values& keys, Umat::Variable& v) {
    const auto found = keys.find("kind");
    if (found == keys.end()) return;
    const auto* text = std::get_if<std::string>(&found->second);
    for (const auto kind : {Umat::Kind::scalar, Umat::Kind::tensor, Umat::Kind::strain}) {
      if (text && *text == kind_name(kind)) {
        v.kind = kind;
        return;
      }
    }
    refuse("kind is \"scalar\", \"tensor\" or \"strain\"", text ? '"' + *text + '"' : "no text");
  }

  void initial(const Values& keys, Umat::Variable& v) {
    const auto found = keys.find("initial");
    if (found == keys.end()) return;
    const auto* number = std::get_if<double>(&found->second);
    const auto* list = std::get_if<std::vector<double>>(&found->second);
    if (v.kind == Umat::Kind::scalar) {
      if (number) v.initial = {*number};
      if (!number) refuse("the initial value of a scalar is a number", "another type", "write a number");
    } else if (list && (list->size() == 4 || list->size() == 6)) {
      v.initial = *list;
    } else {
      refuse("the initial value of a tensor is a list of 6 numbers (4 in plane strain)",
             list ? fmt::format("{} numbers", list->size()) : "no list",
             "write the tensor components xx, yy, zz, xy, yz, zx");
    }
  }

  std::vector<Problem>& problems_;
  std::vector<Umat::Variable> state_;
};

std::string text_or(const Values& settings, const std::string& key, const std::string& standard) {
  const auto found = settings.find(key);
  return found == settings.end() ? standard : std::get<std::string>(found->second);
}

}  // namespace

ModelDescription Umat::description() {
  return {
      "umat",
      "another's model: a compiled Abaqus UMAT from a shared library",
      {{"wave_modulus",
        "K + 4G/3",
        "stress",
        "numerical: stiffness for the critical time step; 0: largest diagonal term of DDSDDE so far",
        Bound{0.0, false},
        {},
        0.0},
       {"celent",
        "CELENT",
        "length",
        "numerical: characteristic length of an element, passed on as CELENT; 0: NaN, so that its use shows",
        Bound{0.0, false},
        {},
        0.0}},
      {{"umat_strain", "STRAN", "-", "total strain that turns with the body", FieldKind::tensor},
       {"umat_stiffness", "K + 4G/3", "stress", "stiffness for the critical time step", FieldKind::scalar},
       {"umat_time", "TIME(2)", "s", "time that the point has seen", FieldKind::scalar},
       {"umat_increments", "KINC - 1", "-", "increments that the routine has seen", FieldKind::scalar}},
      {},
      {},
      {{"library", SettingKind::text, "text", "shared library, from the folder of the case file", true},
       {"symbol", SettingKind::text, "text", "name of the routine in it; standard umat_, else umat or UMAT", false},
       {"constants", SettingKind::numbers, "list of numbers", "PROPS; standard none", false},
       {"state", SettingKind::records, "list of tables { name, kind, initial }",
        "variables of STATEV in their order; kind \"scalar\", \"tensor\" or \"strain\"; standard none", false},
       {"cmname", SettingKind::text, "text", "CMNAME; standard the name of the material in capitals", false},
       {"calls", SettingKind::text, "text",
        "\"serial\": one call at a time; \"parallel\": the routine is safe with threads; standard \"serial\"", false}}};
}

ModelDescription Umat::own_description() const {
  auto all = description();
  for (const auto& v : parameters_->state) {
    const bool scalar = v.kind == Kind::scalar;
    all.state.push_back({v.name, v.name, "of the UMAT", fmt::format("STATEV, {}, signs of the UMAT", kind_name(v.kind)),
                         scalar ? FieldKind::scalar : FieldKind::tensor});
    all.initial.push_back({v.name, scalar ? "number" : "6 numbers",
                           "variable of STATEV, signs of the UMAT; standard that of its declaration, or 0"});
  }
  return all;
}

std::optional<Umat> Umat::from_values(const std::map<std::string, double>& constants, const Values& settings,
                                      std::vector<Problem>& problems, std::vector<Problem>&) {
  Parameters p;
  p.wave_modulus = constants.at("wave_modulus");
  const double celent = constants.at("celent");
  p.celent = celent > 0 ? celent : std::numeric_limits<double>::quiet_NaN();
  p.cmname = text_or(settings, "cmname", "UMAT");
  if (p.cmname.size() > 80)
    problems.push_back({"cmname", "CMNAME has at most 80 letters", fmt::format("{}", p.cmname.size()), "shorten it"});
  const auto calls = text_or(settings, "calls", "serial");
  if (calls != "serial" && calls != "parallel")
    problems.push_back({"calls", "calls is \"serial\" or \"parallel\"", '"' + calls + '"',
                        "\"serial\" is right for every routine, \"parallel\" faster for one without SAVE and COMMON"});
  p.one_at_a_time = calls == "serial";
  if (const auto found = settings.find("constants"); found != settings.end())
    p.constants = std::get<std::vector<double>>(found->second);
  if (const auto found = settings.find("state"); found != settings.end())
    p.state = StateReader(problems).read(std::get<std::vector<Record>>(found->second));
  p.library = umat::Library::open(text_or(settings, "library", ""), text_or(settings, "symbol", ""), problems);
  if (!problems.empty()) return {};
  return Umat(std::move(p));
}

}  // namespace scarp
