// A compiled Abaqus UMAT in a shared library: opening it, and what stands between it and the program.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"

namespace scarp::umat {

/// SUBROUTINE UMAT with its 37 arguments in the order of the Abaqus User Subroutines Reference, and the length of
/// CMNAME that Fortran compilers pass behind them. Integers are 4 bytes (INTEGER), numbers 8 (REAL*8).
using Routine = void (*)(double* STRESS, double* STATEV, double* DDSDDE, double* SSE, double* SPD, double* SCD,
                         double* RPL, double* DDSDDT, double* DRPLDE, double* DRPLDT, const double* STRAN,
                         const double* DSTRAN, const double* TIME, const double* DTIME, const double* TEMP,
                         const double* DTEMP, const double* PREDEF, const double* DPRED, const char* CMNAME,
                         const int* NDI, const int* NSHR, const int* NTENS, const int* NSTATV, const double* PROPS,
                         const int* NPROPS, const double* COORDS, const double* DROT, double* PNEWDT,
                         const double* CELENT, const double* DFGRD0, const double* DFGRD1, const int* NOEL,
                         const int* NPT, const int* LAYER, const int* KSPT, const int* JSTEP, const int* KINC,
                         std::size_t CMNAME_length);

/// An open library. It stays open as long as a model that calls it lives.
class Library {
 public:
  /// Opens the file and finds the routine: `symbol`, or where that is empty the names that compilers give to UMAT.
  /// Where that fails the result is empty and a problem under the key "library" or "symbol" is added.
  static std::shared_ptr<Library> open(const std::string& path, const std::string& symbol,
                                       std::vector<Problem>& problems);

  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library();

  const std::string& path() const { return path_; }
  Routine routine() const { return routine_; }
  std::mutex& turn() { return turn_; }  ///< held during a call, where calls come one after the other
  /// True for the first caller only: a complaint of every point would say no more than one.
  bool first_complaint() { return !complained_.test_and_set(); }
  /// True for the first caller only: what a routine reads is asked of it once.
  bool first_probe() { return !probed_.test_and_set(); }
  /// Did a call end the program, or crash? Then there may be no other one.
  bool ended() const { return ended_; }
  void set_ended() { ended_ = true; }

 private:
  Library(std::string path, void* handle) : path_(std::move(path)), handle_(handle) {}

  std::string path_;
  void* handle_;
  Routine routine_ = nullptr;
  std::mutex turn_;
  std::atomic_flag complained_, probed_;
  std::atomic<bool> ended_ = false;
};

/// Thrown through a UMAT that calls XIT, or STDB_ABQERR with -3: it wants the analysis to end.
class Stopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The utility routines of Abaqus that scarp provides to a UMAT, by the names in its text.
const std::vector<std::string>& provided_utilities();

}  // namespace scarp::umat
