// HDF5 files as arrays under paths such as "regions/0/points/x": made in memory, for the library ends the program where
// a disk is full, and read from memory. Each array has its unit and its meaning as attributes. The same content gives
// the same bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace scarp::io {

/// Of the library, "1.10.8".
std::string hdf5_version();

/// What is said of an array.
struct Note {
  const char *unit, *meaning;
};

enum class NumberType { real, whole, long_whole, byte };

template <class Value>
constexpr NumberType number_type() {
  if constexpr (std::is_same_v<Value, double>) return NumberType::real;
  if constexpr (std::is_same_v<Value, std::int32_t>) return NumberType::whole;
  if constexpr (std::is_same_v<Value, std::int64_t>) return NumberType::long_whole;
  static_assert(std::is_same_v<Value, double> || std::is_same_v<Value, std::int32_t> ||
                std::is_same_v<Value, std::int64_t> || std::is_same_v<Value, std::uint8_t>);
  return NumberType::byte;
}

/// Sizes of an array, the last of which runs fastest; none of a single number.
using Shape = std::vector<std::size_t>;

/// Bytes that were taken by malloc().
struct Bytes {
  std::unique_ptr<void, void (*)(void*)> data{nullptr, nullptr};
  std::size_t size = 0;
};

/// A file on its way. Throws std::bad_alloc where there is no memory for it.
class Hdf5Image {
 public:
  /// `bytes` is about how many there will be: memory is taken by as many at a time.
  explicit Hdf5Image(std::size_t bytes = 0);
  ~Hdf5Image();
  Hdf5Image(const Hdf5Image&) = delete;
  Hdf5Image& operator=(const Hdf5Image&) = delete;

  template <class Value>
  void write(const std::string& path, const Shape& shape, const Value* values, const Note& note) {
    write_array(path, number_type<Value>(), shape, values, note);
  }
  /// Rows that lie apart, of `columns` values each.
  template <class Value>
  void write_rows(const std::string& path, std::span<const Value* const> rows, std::size_t columns, const Note& note) {
    std::vector<const void*> starts(rows.begin(), rows.end());
    write_array_of_rows(path, number_type<Value>(), starts, columns, note);
  }
  void write(const std::string& path, const std::string& text, const Note& note);

  /// The whole file; nothing can be written any more.
  Bytes finish();

 private:
  struct Library;
  void write_array(const std::string& path, NumberType type, const Shape& shape, const void* values, const Note& note);
  void write_array_of_rows(const std::string& path, NumberType type, const std::vector<const void*>& rows,
                           std::size_t columns, const Note& note);
  std::unique_ptr<Library> library_;
};

/// A file in memory, to be read. All throw InputError, which names the path within the file, for what is not there or
/// of another type or shape.
class Hdf5File {
 public:
  /// `name` is for messages. Throws InputError for what is no HDF5 file.
  Hdf5File(const void* data, std::size_t bytes, std::string name);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  bool has(const std::string& path) const;
  Shape shape(const std::string& path) const;
  /// All values of an array of this shape.
  template <class Value>
  void read(const std::string& path, const Shape& shape, Value* values) const {
    read_array(path, number_type<Value>(), shape, values);
  }
  /// The rows of an array of two dimensions.
  template <class Value>
  void read_rows(const std::string& path, std::span<Value* const> rows, std::size_t columns) const {
    std::vector<void*> starts(rows.begin(), rows.end());
    read_array_of_rows(path, number_type<Value>(), starts, columns);
  }
  std::string text(const std::string& path) const;
  /// Unit and meaning of an array.
  std::array<std::string, 2> note(const std::string& path) const;
  /// The paths of all arrays, in the order of their names.
  std::vector<std::string> paths() const;
  const std::string& name() const { return name_; }

 private:
  struct Library;
  void read_array(const std::string& path, NumberType type, const Shape& shape, void* values) const;
  void read_array_of_rows(const std::string& path, NumberType type, const std::vector<void*>& rows,
                          std::size_t columns) const;
  std::string name_;
  std::unique_ptr<Library> library_;
};

}  // namespace scarp::io
