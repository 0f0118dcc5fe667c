// A law on a batch of doubles, beside the same on double.
#include <cmath>
#include <cstdio>

#include "scarp/material/models.hpp"
#include "scarp/tensor/batch.hpp"

int main() {
  using scarp::Batch, scarp::Sym;
  const auto model =
      std::get<scarp::LinearElastic>(*scarp::make_model("linear-elastic", {{"E", 1000}, {"nu", 0.3}}).model);
  const auto ones = scarp::isotropic<double, 4>(1e-3);
  const auto lanes = scarp::isotropic<Batch, 4>(Batch(1e-3));
  const double single = model.rate(scarp::LinearElastic::State<double, 4>{}, ones).change.sigma[0];
  const Batch many = model.rate(scarp::LinearElastic::State<Batch, 4>{}, lanes).change.sigma[0];
  std::printf("%zu lanes: %.12g, one: %.12g\n", Batch::size, many.get(Batch::size - 1), single);
  return std::abs(many.get(Batch::size - 1) - single) <= 1e-15 * std::abs(single) ? 0 : 1;
}
