// The one list of constitutive models. A new model adds its header and its name to `AnyModel`.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/drucker_prager.hpp"
#include "scarp/material/linear_elastic.hpp"
#include "scarp/material/model.hpp"
#include "scarp/material/modified_cam_clay.hpp"
#include "scarp/material/mohr_coulomb.hpp"
#include "scarp/material/neo_hookean.hpp"
#include "scarp/material/subloading.hpp"
#include "scarp/material/tresca.hpp"
#include "scarp/material/umat.hpp"
#include "scarp/material/viscoplastic_subloading.hpp"
#include "scarp/material/von_mises.hpp"

namespace scarp {

namespace detail {
/// One of these models, each of which is complete in plane strain and in space.
template <class... Models>
struct OneOf {
  static_assert((model::is_complete<Models, 4>() && ...) && (model::is_complete<Models, 6>() && ...));
  using type = std::variant<Models...>;
};
}  // namespace detail

/// A model with its constants; dispatched once per block of points.
using AnyModel = detail::OneOf<LinearElastic, Subloading, ViscoplasticSubloading, NeoHookean, ModifiedCamClay, VonMises,
                               Tresca, MohrCoulomb, DruckerPrager, Umat>::type;

/// Descriptions of all models, in the order of the list.
std::vector<ModelDescription> model_descriptions();

/// The description of a model with its constants: that of its kind, and what only its constants say (the state of an
/// umat). Input and output of a material go by this one.
template <class Model>
ModelDescription description_of(const Model& model) {
  if constexpr (requires { model.own_description(); }) {
    return model.own_description();
  } else {
    return Model::description();
  }
}
ModelDescription description_of(const AnyModel& model);

/// Is it the law of an elastic body, which a strain there and back leaves as it was? A law of which all constants give
/// such a body says so by a member `elastic`.
inline bool is_elastic(const AnyModel& model) {
  return std::visit(
      []<class Model>(const Model&) {
        return requires {
          Model::elastic;
        };
      },
      model);
}

/// The model called `name` with constants from `values`, and with settings where it has some. On a bad, unknown or
/// missing key, or an unknown name (Problem::key "model"), the result is the list of problems; warnings do not prevent
/// a result.
struct ModelResult {
  std::optional<AnyModel> model;
  std::vector<Problem> problems;
  std::vector<Problem> warnings;
};
ModelResult make_model(const std::string& name, const std::map<std::string, double>& values,
                       const Values& settings = {});

}  // namespace scarp
