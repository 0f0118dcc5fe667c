// What a checkpoint keeps is declared once, in a function `each_saved(self, f)` beside the members:
//
//   f(Entry{key, unit, meaning}, member)
//
// Saver writes each to an HDF5 file in memory, Loader reads it back.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scarp/base/column.hpp"
#include "scarp/io/hdf5.hpp"

namespace scarp::run {

/// What is said of a number, array or text.
struct Entry {
  const char *key, *unit, *meaning;
};

namespace detail {

template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t n>
inline constexpr bool is_array<std::array<T, n>> = true;
template <class T>
inline constexpr bool is_vector = false;
template <class T, class A>
inline constexpr bool is_vector<std::vector<T, A>> = true;

}  // namespace detail

/// Writes members below a group of a file.
class Saver {
 public:
  Saver(io::Hdf5Image& image, std::string group) : image_(image), group_(std::move(group)) {}
  Saver within(const std::string& group) const { return {image_, group_ + "/" + group}; }

  template <class T>
  void operator()(const Entry& entry, const T& value) const {
    using namespace detail;
    const std::string path = group_ + "/" + entry.key;
    const io::Note note{entry.unit, entry.meaning};
    if constexpr (std::is_same_v<T, std::string>) {
      image_.write(path, value, note);
    } else if constexpr (std::is_same_v<T, bool>) {
      const std::uint8_t bit = value;
      image_.write(path, {}, &bit, note);
    } else if constexpr (is_vector<T>) {
      if constexpr (is_array<typename T::value_type>) {  // of vectors
        constexpr std::size_t n = std::tuple_size_v<typename T::value_type>;
        image_.write(path, {value.size(), n}, value.empty() ? nullptr : value.data()->data(), note);
      } else if constexpr (is_vector<typename T::value_type>) {  // of columns
        rows(path, value, note);
      } else {
        image_.write(path, {value.size()}, value.data(), note);
      }
    } else if constexpr (is_array<T>) {
      if constexpr (is_vector<typename T::value_type>) {
        rows(path, value, note);
      } else {
        image_.write(path, {value.size()}, value.data(), note);
      }
    } else {
      image_.write(path, {}, &value, note);
    }
  }

  /// Some columns of one length, a row each.
  void rows(const Entry& entry, std::span<const Column* const> columns) const {
    std::vector<const double*> starts;
    for (const Column* column : columns) starts.push_back(column->data());
    image_.write_rows<double>(group_ + "/" + entry.key, starts, columns.empty() ? 0 : columns.front()->size(),
                              {entry.unit, entry.meaning});
  }

 private:
  template <class Columns>
  void rows(const std::string& path, const Columns& columns, const io::Note& note) const {
    using Value = typename Columns::value_type::value_type;
    std::vector<const Value*> starts;
    for (const auto& column : columns) starts.push_back(column.data());
    image_.write_rows<Value>(path, starts, columns.empty() ? 0 : columns.front().size(), note);
  }

  io::Hdf5Image& image_;
  std::string group_;
};

/// Reads them back; vectors get the size that the file has, but those of a list of columns, which must be there. Throws
/// InputError for what is missing or of another type or shape.
class Loader {
 public:
  Loader(const io::Hdf5File& file, std::string group) : file_(file), group_(std::move(group)) {}
  Loader within(const std::string& group) const { return {file_, group_ + "/" + group}; }
  bool has(const std::string& key) const { return file_.has(group_ + "/" + key); }
  const std::string& file_name() const { return file_.name(); }

  template <class T>
  void operator()(const Entry& entry, T& value) const {
    using namespace detail;
    const std::string path = group_ + "/" + entry.key;
    if constexpr (std::is_same_v<T, std::string>) {
      value = file_.text(path);
    } else if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t bit = 0;
      file_.read(path, {}, &bit);
      value = bit != 0;
    } else if constexpr (is_vector<T>) {
      if constexpr (is_array<typename T::value_type>) {
        constexpr std::size_t n = std::tuple_size_v<typename T::value_type>;
        value.resize(length(path));
        file_.read(path, {value.size(), n}, value.empty() ? nullptr : value.data()->data());
      } else if constexpr (is_vector<typename T::value_type>) {
        rows(path, value);
      } else {
        value.resize(length(path));
        file_.read(path, {value.size()}, value.data());
      }
    } else if constexpr (is_array<T>) {
      if constexpr (is_vector<typename T::value_type>) {
        rows(path, value);
      } else {
        file_.read(path, {value.size()}, value.data());
      }
    } else {
      file_.read(path, {}, &value);
    }
  }

 private:
  /// The first size, which must be that of the file's own bytes.
  std::size_t length(const std::string& path) const {
    const auto shape = file_.shape(path);
    return shape.empty() ? 0 : shape.front();
  }
  template <class Columns>
  void rows(const std::string& path, Columns& columns) const {
    using Value = typename Columns::value_type::value_type;
    const auto shape = file_.shape(path);
    const std::size_t size = shape.size() == 2 ? shape[1] : 0;
    std::vector<Value*> starts;
    for (auto& column : columns) {
      column.resize(size);
      starts.push_back(column.data());
    }
    file_.read_rows<Value>(path, starts, size);
  }

  const io::Hdf5File& file_;
  std::string group_;
};

}  // namespace scarp::run
