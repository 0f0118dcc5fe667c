#include "scarp/run/scheme.hpp"

namespace scarp::run {

Scheme scheme_of(const input::MethodInput& method, std::optional<double> flip) {
  if (method.scheme == input::SchemeName::report) return report_scheme(flip.value_or(method.flip));
  Scheme scheme = method.scheme == input::SchemeName::apic ? apic_scheme() : two_term_scheme(method.pic_time);
  scheme.damping = {method.stress_damping, method.stress_damping_time};
  return scheme;
}

template <int Dim>
StepSettings settings_of(const input::CaseOf<Dim>& input, const input::StageInputOf<Dim>& stage, bool profile) {
  return {scheme_of(input.method, stage.flip),
          stage.damping,
          input.method.corrected_quadrature ? QuadratureRule::corrected : QuadratureRule::points,
          {input.method.tolerance, 1e-5},
          input.method.remove_leaving,
          profile};
}

template StepSettings settings_of<2>(const input::CaseOf<2>&, const input::StageInputOf<2>&, bool);
template StepSettings settings_of<3>(const input::CaseOf<3>&, const input::StageInputOf<3>&, bool);

}  // namespace scarp::run
