// What a user of the library writes: a model and a strain step, a laboratory test, and a time step of the material
// point method. Each is compared with an answer in closed form; the exit status says whether all agree.
#include <cmath>
#include <cstdio>
#include <memory>

#include "scarp/base/version.hpp"
#include "scarp/lab/driver.hpp"
#include "scarp/lab/named_tests.hpp"
#include "scarp/material/integrate/embedded.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/step/scheme.hpp"
#include "scarp/step/step.hpp"

namespace {

bool agree(const char* what, double found, double expected, double tolerance) {
  std::printf("%s: %.12g, expected %.12g\n", what, found, expected);
  return std::abs(found - expected) <= tolerance * std::abs(expected);
}

// Isotropic compression of Modified Cam Clay on its normal consolidation line, where d(ln(p + p_e)) = d(eps_v)/lambda.
bool strain_step() {
  const auto made =
      scarp::make_model("modified-cam-clay",
                        {{"kappa", 0.02}, {"lambda", 0.12}, {"nu", 0.3}, {"p_e", 5.0}, {"M", 1.0}, {"p_atm", 101.325}});
  const auto& model = std::get<scarp::ModifiedCamClay>(made.model.value());
  scarp::ModifiedCamClay::State<double, 6> soil{};
  soil.sigma = scarp::isotropic<double, 6>(100.0);
  soil.p_c = 100.0;
  const auto compression = scarp::isotropic<double, 6>(0.01 / 3);
  const auto report = scarp::integrate<scarp::ModifiedEuler>(model, soil, compression, {});
  return report.end == scarp::IntegrationEnd::done &&
         agree("p after a strain step", scarp::mean(soil.sigma), 105.0 * std::exp(0.01 / 0.12) - 5.0, 1e-4);
}

// An elastic oedometer test: sigma_zz grows by the constrained modulus times the strain.
bool laboratory() {
  const double E = 2e4, nu = 0.25;
  for (const auto& named : scarp::lab::named_tests()) {
    if (named.type != "oedometer") continue;
    scarp::lab::Test test{scarp::make_model("linear-elastic", {{"E", E}, {"nu", nu}}).model.value()};
    test.stress = {50, 50, 50, 0, 0, 0};
    scarp::lab::Constraints constraints;
    for (std::size_t i = 0; i < 5; ++i) constraints.forms[i] = named.held[i];
    for (const auto& drive : named.drives)
      if (drive.key == "eps_a") constraints.forms[5] = drive.form;
    constraints.targets = {0.01};
    scarp::lab::Stage stage;
    stage.type = "oedometer";
    stage.path = constraints;
    test.stages = {stage};
    const auto columns = scarp::lab::curve_columns(test.model);
    double sigma_zz = 0;
    scarp::lab::run_test(test, [&](const std::vector<double>& row) {
      for (std::size_t c = 0; c < columns.size(); ++c)
        if (columns[c] == "sig_zz") sigma_zz = row[c];
    });
    return agree("sigma_zz in the oedometer", sigma_zz, 50 + 0.01 * E * (1 - nu) / (1 + nu) / (1 - 2 * nu), 1e-6);
  }
  return false;
}

// One time step of a point in free fall.
bool time_step() {
  const double dt = 1e-3;
  scarp::Body<2> body(std::make_unique<const scarp::Mesh<2>>(scarp::make_grid({0, 0}, {1, 1}, {4, 4})), {0, -9.81});
  scarp::Block<2> block("soil", *scarp::make_model("linear-elastic", {{"E", 1000}, {"nu", 0.3}}).model);
  scarp::resize(block, 1);
  block.points.x[0][0] = block.points.x[1][0] = 0.6;
  block.points.volume[0] = block.points.initial_volume[0] = 0.01;
  block.points.mass[0] = 0.018;
  body.fields[0].blocks.push_back(std::move(block));
  scarp::locate_points(body);
  scarp::StepSettings settings;
  settings.scheme = scarp::two_term_scheme();
  scarp::advance(body, dt, settings);
  return agree("velocity in free fall", body.blocks()[0].points.v[1][0], -9.81 * dt, 1e-12);
}

}  // namespace

int main() {
  std::printf("scarp %s\n", scarp::version);
  const bool all[] = {strain_step(), laboratory(), time_step()};
  return all[0] && all[1] && all[2] ? 0 : 1;
}
