// What the library of HDF5 hands out, held. For hdf5_*.cpp only.
#pragma once

#include <hdf5.h>

#include <atomic>
#include <cstdint>
#include <string>

#include "scarp/io/hdf5.hpp"

namespace scarp::io::detail {

/// A handle that closes itself.
class Handle {
 public:
  Handle(hid_t id, herr_t (*by)(hid_t)) : id_(id), close_(by) {}
  ~Handle() { close(); }
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Handle& operator=(Handle&&) = delete;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return id_; }
  bool good() const { return id_ >= 0; }
  bool close() {
    const bool done = id_ < 0 || close_(id_) >= 0;
    id_ = -1;
    return done;
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// How values lie in memory and in the file.
inline hid_t type_of(NumberType type) {
  switch (type) {
    case NumberType::real:
      return H5T_IEEE_F64LE;
    case NumberType::whole:
      return H5T_STD_I32LE;
    case NumberType::long_whole:
      return H5T_STD_I64LE;
    default:
      return H5T_STD_U8LE;
  }
}

/// The library says nothing by itself: what it answers is looked at.
inline void keep_quiet() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// A name for an image in memory. The library takes two open ones of the same name for one file, and refuses the name
/// of a file that is there: no file can have this one.
inline std::string image_name() {
  static std::atomic<std::uint64_t> count{0};
  return "/dev/null/" + std::to_string(count++);
}

}  // namespace scarp::io::detail
