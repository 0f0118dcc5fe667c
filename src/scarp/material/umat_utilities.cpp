// Utility routines of Abaqus that UMATs call, under the names that Fortran compilers give them. What each does is in
// the Abaqus User Subroutines Reference, section "Utility routines"; docs/models/umat.md lists which are here.
// Symmetric tensors come in Abaqus's order: NDI direct components, then NSHR of 12, 13, 23; strains with engineering
// shear.
#include <cmath>
#include <cstddef>
#include <string>

#include "scarp/base/log.hpp"
#include "scarp/material/umat_library.hpp"

namespace scarp::umat {
namespace {

struct Matrix {
  double m[3][3] = {};
};

constexpr int shear_of[3][2] = {{0, 1}, {0, 2}, {1, 2}};

/// LSTR: 1 for a stress, 2 for a strain.
double shear_factor(int LSTR) {
  return LSTR == 2 ? 0.5 : 1.0;
}

Matrix matrix_of(const double* S, int LSTR, int NDI, int NSHR) {
  Matrix a;
  for (int i = 0; i < NDI; ++i) a.m[i][i] = S[i];
  for (int k = 0; k < NSHR; ++k) {
    const auto [i, j] = shear_of[k];
    a.m[i][j] = a.m[j][i] = shear_factor(LSTR) * S[NDI + k];
  }
  return a;
}

/// Diagonalises a, column k of v its k-th eigenvector, by Jacobi's rotations (Golub & Van Loan, Matrix Computations,
/// 8.5): to the last digits whatever the eigenvalues, equal ones too.
void diagonalise(Matrix& a, Matrix& v) {
  for (int i = 0; i < 3; ++i) v.m[i][i] = 1;
  for (int sweep = 0; sweep < 30; ++sweep) {
    if (a.m[0][1] == 0 && a.m[0][2] == 0 && a.m[1][2] == 0) return;
    for (const auto& [p, q] : shear_of) {
      if (a.m[p][q] == 0) continue;
      const double tau = (a.m[q][q] - a.m[p][p]) / (2 * a.m[p][q]);
      const double t = std::copysign(1.0, tau) / (std::abs(tau) + std::sqrt(1 + tau * tau));
      const double c = 1 / std::sqrt(1 + t * t), s = t * c;
      for (int k = 0; k < 3; ++k) {
        const double kp = a.m[k][p], kq = a.m[k][q];
        a.m[k][p] = c * kp - s * kq;
        a.m[k][q] = s * kp + c * kq;
      }
      for (int k = 0; k < 3; ++k) {
        const double pk = a.m[p][k], qk = a.m[q][k];
        a.m[p][k] = c * pk - s * qk;
        a.m[q][k] = s * pk + c * qk;
        const double vp = v.m[k][p], vq = v.m[k][q];
        v.m[k][p] = c * vp - s * vq;
        v.m[k][q] = s * vp + c * vq;
      }
      // Zero in theory: what rounding leaves is below the last digit of the diagonal.
      a.m[p][q] = a.m[q][p] = 0;
    }
  }
}

/// The message of STDB_ABQERR: %I, %R and %S stand for the next whole number, number and word.
std::string filled(const char* text, std::size_t length, const int* whole, const double* number, const char* words,
                   std::size_t word_length) {
  std::string message;
  for (std::size_t i = 0; i < length; ++i) {
    const char kind = text[i] == '%' && i + 1 < length ? text[i + 1] : '\0';
    if (kind == 'I') {
      message += std::to_string(*whole++);
    } else if (kind == 'R') {
      message += std::to_string(*number++);
    } else if (kind == 'S') {
      std::string word(words, word_length);
      words += word_length;
      message += word.substr(0, word.find_last_not_of(std::string(" \0", 2)) + 1);
    } else {
      message += text[i];
      continue;
    }
    ++i;
  }
  return message.substr(0, message.find_last_not_of(' ') + 1);
}

}  // namespace

const std::vector<std::string>& provided_utilities() {
  static const std::vector<std::string> names{"XIT", "STDB_ABQERR", "ROTSIG", "SINV", "SPRINC", "SPRIND"};
  return names;
}

}  // namespace scarp::umat

extern "C" {

/// CALL XIT: ends the analysis. The exception passes through the UMAT to the model that called it.
void xit_() {
  throw scarp::umat::Stopped("it called XIT");
}

/// CALL STDB_ABQERR(LOP, STRING, INTV, REALV, CHARV): a message. LOP 1: information; -1: warning; -2: error, the
/// analysis goes on; -3: error, the analysis ends.
void stdb_abqerr_(const int* LOP, const char* STRING, const int* INTV, const double* REALV, const char* CHARV,
                  std::size_t STRING_length, std::size_t CHARV_length) {
  const auto text = scarp::umat::filled(STRING, STRING_length, INTV, REALV, CHARV, CHARV_length);
  if (*LOP == -3) throw scarp::umat::Stopped(text);
  if (*LOP == 1) {
    scarp::logging::info("UMAT: " + text);
  } else {
    scarp::logging::warn("UMAT: " + text);
  }
}

/// CALL ROTSIG(S, R, SPRIME, LSTR, NDI, NSHR): SPRIME = R S Rᵀ.
void rotsig_(const double* S, const double* R, double* SPRIME, const int* LSTR, const int* NDI, const int* NSHR) {
  const auto a = scarp::umat::matrix_of(S, *LSTR, *NDI, *NSHR);
  double turned[3][3] = {};
  // R(i,j) of Fortran lies at R[i + 3 j].
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) turned[i][j] += R[i + 3 * k] * a.m[k][l] * R[j + 3 * l];
  for (int i = 0; i < *NDI; ++i) SPRIME[i] = turned[i][i];
  for (int k = 0; k < *NSHR; ++k) {
    const auto [i, j] = scarp::umat::shear_of[k];
    SPRIME[*NDI + k] = turned[i][j] / scarp::umat::shear_factor(*LSTR);
  }
}

/// CALL SINV(STRESS, SINV1, SINV2, NDI, NSHR): SINV1 = tr/3, SINV2 = √(3/2 S:S) with S the deviator.
void sinv_(const double* STRESS, double* SINV1, double* SINV2, const int* NDI, const int* NSHR) {
  const auto a = scarp::umat::matrix_of(STRESS, 1, *NDI, *NSHR);
  const double mean = (a.m[0][0] + a.m[1][1] + a.m[2][2]) / 3;
  double square = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) square += std::pow(a.m[i][j] - (i == j ? mean : 0), 2);
  *SINV1 = mean;
  *SINV2 = std::sqrt(1.5 * square);
}

/// CALL SPRIND(S, PS, AN, LSTR, NDI, NSHR): principal values PS(K) and their directions AN(K,1..3).
void sprind_(const double* S, double* PS, double* AN, const int* LSTR, const int* NDI, const int* NSHR) {
  auto a = scarp::umat::matrix_of(S, *LSTR, *NDI, *NSHR);
  scarp::umat::Matrix v;
  scarp::umat::diagonalise(a, v);
  for (int k = 0; k < 3; ++k) {
    PS[k] = a.m[k][k];
    for (int i = 0; i < 3; ++i) AN[k + 3 * i] = v.m[i][k];
  }
}

/// CALL SPRINC(S, PS, LSTR, NDI, NSHR): principal values.
void sprinc_(const double* S, double* PS, const int* LSTR, const int* NDI, const int* NSHR) {
  double AN[9];
  sprind_(S, PS, AN, LSTR, NDI, NSHR);
}

}  // extern "C"
