#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scarp/base/error.hpp"
#include "scarp/io/hdf5_handle.hpp"

namespace scarp::io {

using detail::Handle;

namespace {

/// No array of a file has more dimensions.
constexpr int most_dimensions = 2;

const char* type_text(NumberType type) {
  switch (type) {
    case NumberType::real:
      return "float64";
    case NumberType::whole:
      return "int32";
    case NumberType::long_whole:
      return "int64";
    default:
      return "uint8";
  }
}

std::string shape_text(const Shape& shape) {
  return fmt::format("({})", fmt::join(shape, ", "));
}

std::string text_in(hid_t type, std::size_t size, auto&& read) {
  std::string text(size, '\0');
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || !read(text.data())) return {};
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

}  // namespace

struct Hdf5File::Library {
  Library(const void* data, std::size_t bytes) : file(open(data, bytes)) {}

  static Handle open(const void* data, std::size_t bytes) {
    detail::keep_quiet();
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    Handle opened(-1, H5Fclose);
    if (access.good() && H5Pset_fapl_core(access, std::size_t{1} << 20, 0) >= 0 &&
        H5Pset_file_image(access, const_cast<void*>(data), bytes) >= 0) {  // it is copied
      return {H5Fopen(detail::image_name().c_str(), H5F_ACC_RDONLY, access), H5Fclose};
    }
    return opened;
  }

  Handle file;
};

namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& path, const std::string& what) {
  throw InputError(fmt::format("\"{}\" in this file {}", path, what), file,
                   "take a file that scarp has written, unchanged but for values");
}

Handle open_array(hid_t file, const std::string& name, const std::string& path) {
  Handle opened(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!opened.good()) refuse(name, path, "is missing");
  return opened;
}

Shape shape_of(hid_t array, const std::string& name, const std::string& path) {
  const Handle space(H5Dget_space(array), H5Sclose);
  const int dimensions = space.good() ? H5Sget_simple_extent_ndims(space) : -1;
  if (dimensions < 0 || dimensions > most_dimensions) refuse(name, path, "has too many dimensions");
  std::array<hsize_t, most_dimensions> sizes{};
  H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  return {sizes.begin(), sizes.begin() + dimensions};
}

/// An array of numbers of this type and shape.
Handle open_numbers(hid_t file, const std::string& name, const std::string& path, NumberType type, const Shape& shape) {
  auto array = open_array(file, name, path);
  const Handle its(H5Dget_type(array), H5Tclose);
  if (!its.good() || H5Tequal(its, detail::type_of(type)) <= 0)
    refuse(name, path, fmt::format("is not of type {}", type_text(type)));
  const auto found = shape_of(array, name, path);
  if (found != shape) {
    refuse(name, path, fmt::format("has the shape {}, and {} is needed", shape_text(found), shape_text(shape)));
  }
  return array;
}

}  // namespace

Hdf5File::Hdf5File(const void* data, std::size_t bytes, std::string name)
    : name_(std::move(name)), library_(std::make_unique<Library>(data, bytes)) {
  if (!library_->file.good()) {
    throw InputError("the file is not one of HDF5, or damaged", name_, "take a file that scarp has written");
  }
}
Hdf5File::~Hdf5File() = default;

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

bool Hdf5File::has(const std::string& path) const {
  std::string part;
  for (std::size_t end = 0; end != path.npos;) {
    end = path.find('/', end == 0 ? 0 : end + 1);
    part = path.substr(0, end);
    if (H5Lexists(library_->file, part.c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return true;
}

Shape Hdf5File::shape(const std::string& path) const {
  const auto array = open_array(library_->file, name_, path);
  const auto shape = shape_of(array, name_, path);
  const Handle type(H5Dget_type(array), H5Tclose);
  double bytes = type.good() ? static_cast<double>(H5Tget_size(type)) : 0;
  for (const std::size_t size : shape) bytes *= static_cast<double>(size);
  // Memory is taken by what a file says: it must have the bytes.
  if (bytes > static_cast<double>(H5Dget_storage_size(array))) refuse(name_, path, "is cut off");
  return shape;
}

void Hdf5File::read_array(const std::string& path, NumberType type, const Shape& shape, void* values) const {
  const auto array = open_numbers(library_->file, name_, path, type, shape);
  for (const std::size_t size : shape) {
    if (size == 0) return;
  }
  if (H5Dread(array, detail::type_of(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    refuse(name_, path, "cannot be read");
}

void Hdf5File::read_array_of_rows(const std::string& path, NumberType type, const std::vector<void*>& rows,
                                  std::size_t columns) const {
  const auto array = open_numbers(library_->file, name_, path, type, {rows.size(), columns});
  if (rows.empty() || columns == 0) return;
  const hsize_t length = columns;
  const Handle space(H5Dget_space(array), H5Sclose), row_space(H5Screate_simple(1, &length, nullptr), H5Sclose);
  for (hsize_t r = 0; r < rows.size(); ++r) {
    const hsize_t start[] = {r, 0}, count[] = {1, columns};
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr) < 0 ||
        H5Dread(array, detail::type_of(type), row_space, space, H5P_DEFAULT, rows[r]) < 0)
      refuse(name_, path, "cannot be read");
  }
}

std::string Hdf5File::text(const std::string& path) const {
  const auto array = open_array(library_->file, name_, path);
  const Handle type(H5Dget_type(array), H5Tclose);
  if (!type.good() || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
      !shape_of(array, name_, path).empty())
    refuse(name_, path, "is not a text of fixed length");
  const std::size_t size = H5Tget_size(type);
  if (size > H5Dget_storage_size(array)) refuse(name_, path, "is cut off");
  return text_in(type, size, [&](char* to) { return H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0; });
}

std::array<std::string, 2> Hdf5File::note(const std::string& path) const {
  const auto array = open_array(library_->file, name_, path);
  std::array<std::string, 2> texts;
  const char* names[] = {"unit", "meaning"};
  for (int k = 0; k < 2; ++k) {
    if (H5Aexists(array, names[k]) <= 0) continue;
    const Handle attribute(H5Aopen(array, names[k], H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    texts[static_cast<std::size_t>(k)] =
        text_in(type, H5Tget_size(type), [&](char* to) { return H5Aread(attribute, type, to) >= 0; });
  }
  return texts;
}

std::vector<std::string> Hdf5File::paths() const {
  std::vector<std::string> all;
  H5Ovisit(
      library_->file, H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t, const char* name, const H5O_info_t* info, void* to) -> herr_t {
        if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(to)->push_back(name);
        return 0;
      },
      &all);
  return all;
}

}  // namespace scarp::io
