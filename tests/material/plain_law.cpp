#include "plain_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dual.hpp"

namespace scarp::test {
namespace {

template <class T>
using MatrixOf = std::array<std::array<T, 3>, 3>;

/// f or g of eqs 21–24 and 30 on any scalar.
template <class T>
T surface(const Subloading::Parameters& c, double alpha, const MatrixOf<T>& sigma, const MatrixOf<T>& beta,
          const T& p_c) {
  const T p = (sigma[0][0] + sigma[1][1] + sigma[2][2]) / T(3.0);
  T square(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const T s_bar = sigma[i][j] - (i == j ? p : T(0.0)) - p * beta[i][j];
      square = square + s_bar * s_bar;
    }
  }
  const T p_bar = p + T(c.xi) * p_c;
  return T(1.5 / (alpha * alpha * c.M * c.M)) * square + p_bar * (p_bar - p_c);
}

MatrixOf<Dual> constant(const Matrix& m) {
  MatrixOf<Dual> r;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i][j] = Dual(m[i][j]);
  return r;
}

Matrix plus(const Matrix& a, double w, const Matrix& b) {
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i][j] = a[i][j] + w * b[i][j];
  return r;
}

Matrix scaled(double w, const Matrix& a) {
  return plus(Matrix{}, w, a);
}

double contract(const Matrix& a, const Matrix& b) {
  double r = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r += a[i][j] * b[i][j];
  return r;
}

double tr(const Matrix& a) {
  return a[0][0] + a[1][1] + a[2][2];
}

Matrix unit(double value) {
  return {{{value, 0, 0}, {0, value, 0}, {0, 0, value}}};
}

Matrix dev(const Matrix& a) {
  return plus(a, -tr(a) / 3, unit(1));
}

enum class By { sigma, beta };

/// ∂/∂σ_ij or ∂/∂β_ij of the surface, each of the nine components on its own.
Matrix gradient(By by, const Subloading::Parameters& c, double alpha, const Matrix& sigma, const Matrix& beta,
                double p_c) {
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      auto s = constant(sigma), b = constant(beta);
      (by == By::sigma ? s : b)[i][j].d = 1;
      r[i][j] = surface(c, alpha, s, b, Dual(p_c)).d;
    }
  }
  return r;
}

double homothety_ratio(const Subloading::Parameters& c, const PlainState& s) {
  auto outside = [&](double u) { return yield_function(c, plus(s.a, u, plus(s.sigma, -1, s.a)), s.beta, s.p_c) > 0; };
  double low = 0, high = 1;
  while (!outside(high)) high *= 2;
  for (int i = 0; i < 200; ++i) {
    const double u = 0.5 * (low + high);
    (outside(u) ? high : low) = u;
  }
  return 1 / (0.5 * (low + high));
}

double lode_angle(const Matrix& s) {
  const double j2 = 0.5 * contract(s, s);
  if (j2 == 0) return 0;
  return std::acos(std::clamp(1.5 * std::sqrt(3.0) * determinant(s) / std::pow(j2, 1.5), -1.0, 1.0)) / 3;
}

/// Rates of the internal variables per unit multiplier, eqs 31, 32, 36–38.
PlainRate hardening(const Subloading::Parameters& c, const PlainState& s, const Matrix& y, const Matrix& G, double R) {
  PlainRate r{};
  const double size = std::sqrt(contract(G, G)), size_dev = std::sqrt(contract(dev(G), dev(G)));
  const double p = tr(s.sigma) / 3;
  r.R_change = -c.c_R * std::log((R - c.R_min) / (1 - c.R_min)) * size;
  const Matrix s_bar = plus(dev(s.sigma), -p, s.beta);
  const double length = std::sqrt(contract(s_bar, s_bar));
  const double eta = plain_eta(c, c.M_c * plain_willam_warnke(lode_angle(s_bar), c.k));
  const Matrix target = length > 0 ? scaled(std::sqrt(2.0 / 3.0) * eta / length, s_bar) : Matrix{};
  r.beta = scaled(c.c_beta * size_dev * p / c.p_atm, plus(target, -1, s.beta));
  r.R_b = c.c_b * (c.R_bf - s.R_b) * size;
  const double pc_bar = s.p_c / s.R_b;
  const double pc_bar_rate = (pc_bar + c.p_e / (1 - c.xi)) * tr(G) / (c.lambda - c.kappa);
  r.p_c = s.R_b * pc_bar_rate + pc_bar * r.R_b;  // eq. 34
  const double p_centre = (0.5 - c.xi) * s.p_c;
  const Matrix centre = plus(unit(p_centre), p_centre, s.beta);
  const Matrix image = plus(centre, 1 - c.delta, plus(y, -1, centre));
  r.a = plus(plus(scaled(c.c_a * size, plus(image, -1, s.a)), r.p_c / s.p_c, s.a), tr(s.a) / 3, r.beta);
  return r;
}

}  // namespace

double yield_function(const Subloading::Parameters& c, const Matrix& sigma, const Matrix& beta, double p_c,
                      double alpha) {
  return surface(c, alpha, sigma, beta, p_c);
}

double plain_eta(const Subloading::Parameters& c, double M_cs) {
  const double i2 = 1 / (c.alpha * c.alpha), lead = 1 - 2 * i2, half = M_cs * (i2 - 1), rest = M_cs * M_cs - c.M * c.M;
  const double disc = std::max(0.0, half * half - lead * rest);
  return std::max(0.0, (half + std::sqrt(disc)) / -lead);
}

double plain_willam_warnke(double theta, double k) {
  const double x = std::cos(std::numbers::pi / 3 - theta), d = 1 - k * k;
  return (2 * d * x + (2 * k - 1) * std::sqrt(4 * d * x * x + 5 * k * k - 4 * k)) /
         (4 * d * x * x + (1 - 2 * k) * (1 - 2 * k));
}

PlainRate plain_rate(const Subloading::Parameters& c, const PlainState& s, const Matrix& deps) {
  const double p = tr(s.sigma) / 3, K = (p + c.p_e) / c.kappa, G2 = 3 * (1 - 2 * c.nu) / (1 + c.nu) * K;
  auto D = [&](const Matrix& e) { return plus(scaled(G2, dev(e)), K * tr(e), unit(1)); };
  const double R = homothety_ratio(c, s);
  const Matrix d = plus(s.sigma, -1, s.a), y = plus(s.a, 1 / R, d);
  const Matrix N = gradient(By::sigma, c, 1, y, s.beta, s.p_c), G = gradient(By::sigma, c, c.alpha, y, s.beta, s.p_c);
  const Matrix f_beta = gradient(By::beta, c, 1, y, s.beta, s.p_c);
  const double f_pc = surface(c, 1.0, constant(y), constant(s.beta), Dual(s.p_c, 1)).d;

  PlainRate r = hardening(c, s, y, G, R);
  r.R = R;
  r.H_long =
      (1 - R) * contract(N, r.a) + r.R_change / R * contract(N, d) - R * contract(f_beta, r.beta) - R * f_pc * r.p_c;
  const Matrix pull = plus(plus(r.a, -r.p_c / s.p_c, s.a), -tr(s.a) / 3, r.beta);
  const Matrix inner =
      plus(plus(plus(scaled(r.p_c / s.p_c, s.sigma), p, r.beta), 1 - R, pull), r.R_change, plus(y, -1, s.a));
  r.H_short = contract(N, inner);
  const double N_De = contract(N, D(deps));
  r.plastic = R > c.R_min && N_De > 0;
  const double dLambda = r.plastic ? N_De / (contract(N, D(G)) + r.H_long) : 0;
  r.R_change = r.plastic ? dLambda * r.R_change : N_De / contract(N, plus(y, -1, s.a));
  r.epsp = scaled(dLambda, G);
  r.sigma = D(plus(deps, -1, r.epsp));
  r.beta = scaled(dLambda, r.beta);
  r.a = scaled(dLambda, r.a);
  r.p_c *= dLambda;
  r.R_b *= dLambda;
  return r;
}

}  // namespace scarp::test
