#include "scarp/lab/named_tests.hpp"

namespace scarp::lab {
namespace {

constexpr std::size_t xx = 0, yy = 1, zz = 2, xy = 3, yz = 4, zx = 5;

LinearForm strain(std::size_t i, double factor = 1) {
  LinearForm form;
  form.E[i] = factor;
  return form;
}

LinearForm stress(std::size_t i, double factor = 1) {
  LinearForm form;
  form.S[i] = factor;
  return form;
}

LinearForm operator+(const LinearForm& a, const LinearForm& b) {
  LinearForm sum = a;
  for (std::size_t i = 0; i < 6; ++i) {
    sum.E[i] += b.E[i];
    sum.S[i] += b.S[i];
  }
  return sum;
}

const LinearForm volume = strain(xx) + strain(yy) + strain(zz);
const LinearForm mean_stress = stress(xx, 1.0 / 3) + stress(yy, 1.0 / 3) + stress(zz, 1.0 / 3);
/// σ_xx = σ_yy, and the signed deviatoric stress of a triaxial test, with equal lateral stresses.
const LinearForm lateral = stress(xx) + stress(yy, -1);
const LinearForm signed_q = stress(zz) + stress(xx, -0.5) + stress(yy, -0.5);

const Drive axial_strain{"eps_a", "axial strain ε_zz; negative in extension", true, strain(zz)};
const Drive axial_stress{"sig_a", "vertical stress σ_zz", false, stress(zz)};
const Drive deviator{"q", "σ_zz − σ_xx; negative in extension", false, signed_q};
const Drive volumetric{"eps_v", "volumetric strain", true, volume};
const Drive pressure{"p", "mean stress", false, mean_stress};
const Drive shear_strain{"gamma", "shear strain γ_zx = 2 ε_zx", true, strain(zx, 2)};
const Drive shear_stress{"tau", "shear stress σ_zx", false, stress(zx)};

std::vector<NamedTest> make() {
  const std::vector<LinearForm> upright{strain(xy), strain(yz), strain(zx)};  // no distortion of the specimen
  auto with_upright = [&](std::vector<LinearForm> forms) {
    forms.insert(forms.end(), upright.begin(), upright.end());
    return forms;
  };
  const std::vector<LinearForm> sheared{strain(xx), strain(yy), strain(xy), strain(yz)};
  auto with_sheared = [&](const LinearForm& vertical) {
    auto forms = sheared;
    forms.push_back(vertical);
    return forms;
  };
  std::vector<LinearForm> all_stress, all_strain;
  for (std::size_t i = 0; i < 6; ++i) {
    all_stress.push_back(stress(i));
    all_strain.push_back(strain(i));
  }
  return {
      {"isotropic", with_upright({lateral, stress(yy) + stress(zz, -1)}), {volumetric, pressure}, {}},
      {"oedometer", with_upright({strain(xx), strain(yy)}), {axial_strain, axial_stress}, {}},
      {"triaxial-drained", with_upright({stress(xx), stress(yy)}), {axial_strain, deviator}, {}},
      {"triaxial-undrained", with_upright({volume, lateral}), {axial_strain, deviator}, xx},
      {"constant-p", with_upright({mean_stress, lateral}), {axial_strain, deviator}, {}},
      {"simple-shear-drained", with_sheared(stress(zz)), {shear_strain, shear_stress}, {}},
      {"simple-shear-undrained", with_sheared(strain(zz)), {shear_strain, shear_stress}, zz},
      {"creep", all_stress, {}, {}},
      {"relaxation", all_strain, {}, {}},
  };
}

}  // namespace

const std::vector<NamedTest>& named_tests() {
  static const std::vector<NamedTest> all = make();
  return all;
}

}  // namespace scarp::lab
