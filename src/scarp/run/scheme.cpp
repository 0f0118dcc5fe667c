#include "scarp/run/scheme.hpp"

namespace scarp::run {

Scheme scheme_of(const input::MethodInput& method, std::optional<double> flip) {
  if (method.scheme == input::SchemeName::report) return report_scheme(flip.value_or(method.flip));
  Scheme scheme = method.scheme == input::SchemeName::apic ? apic_scheme() : two_term_scheme(method.pic_time);
  scheme.damping = {method.stress_damping, method.stress_damping_time};
  return scheme;
}

}  // namespace scarp::run
