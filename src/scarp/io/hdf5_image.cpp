#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

#include "scarp/io/hdf5_handle.hpp"

namespace scarp::io {

using detail::Handle;

namespace {

/// The memory that the library writes into, which is to outlive the file.
struct Memory {
  void* data = nullptr;
  bool closing = false;
};

void* take(std::size_t size, H5FD_file_image_op_t, void* memory) {
  return static_cast<Memory*>(memory)->data = std::malloc(size);
}
void* copy(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::memcpy(to, from, size);
}
/// When the file is closed it is cut to what is used: no matter, for its size is known.
void* resize(void* old, std::size_t size, H5FD_file_image_op_t, void* memory) {
  auto& its = *static_cast<Memory*>(memory);
  if (its.closing) return old;
  void* moved = std::realloc(old, size);
  if (moved) its.data = moved;
  return moved;
}
herr_t keep(void*, H5FD_file_image_op_t, void*) {
  return 0;
}
void* same(void* memory) {
  return memory;
}
herr_t nothing(void*) {
  return 0;
}

/// What the library refuses here it refuses for want of memory.
void demand(bool good) {
  if (!good) throw std::bad_alloc();
}

}  // namespace

struct Hdf5Image::Library {
  explicit Library(std::size_t more)
      : file(open(memory, more)),
        link(H5Pcreate(H5P_LINK_CREATE), H5Pclose),
        set(H5Pcreate(H5P_DATASET_CREATE), H5Pclose) {
    demand(file.good() && link.good() && set.good());
    demand(H5Pset_create_intermediate_group(link, 1) >= 0);
    demand(H5Pset_obj_track_times(set, false) >= 0);  // of which the same content would get other bytes
  }
  ~Library() {
    memory.closing = true;
    file.close();
    std::free(memory.data);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  static Handle open(Memory& memory, std::size_t more) {
    detail::keep_quiet();
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    demand(access.good() && H5Pset_fapl_core(access, more, 0) >= 0);
    H5FD_file_image_callbacks_t callbacks{take, copy, resize, keep, same, nothing, &memory};
    demand(H5Pset_file_image_callbacks(access, &callbacks) >= 0);
    return {H5Fcreate(detail::image_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose};
  }

  void attribute(hid_t of, const char* name, const std::string& text) const {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    demand(type.good() && H5Tset_size(type, text.size() + 1) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0);
    const Handle made(H5Acreate2(of, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    demand(made.good() && H5Awrite(made, type, text.c_str()) >= 0);
  }

  Handle create(const std::string& path, hid_t type, hid_t space, const Note& note) const {
    Handle made(H5Dcreate2(file, path.c_str(), type, space, link, set, H5P_DEFAULT), H5Dclose);
    demand(made.good());
    attribute(made, "unit", note.unit);
    attribute(made, "meaning", note.meaning);
    return made;
  }

  static Handle space_of(const Shape& shape) {
    if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
    const std::vector<hsize_t> sizes(shape.begin(), shape.end());
    return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose};
  }

  Memory memory;
  Handle file, link, set;
};

Hdf5Image::Hdf5Image(std::size_t bytes)
    : library_(std::make_unique<Library>(std::clamp(bytes, std::size_t{1} << 18, std::size_t{1} << 26))) {}
Hdf5Image::~Hdf5Image() = default;

void Hdf5Image::write_array(const std::string& path, NumberType type, const Shape& shape, const void* values,
                            const Note& note) {
  const auto space = Library::space_of(shape);
  demand(space.good());
  const auto made = library_->create(path, detail::type_of(type), space, note);
  std::size_t count = 1;
  for (const std::size_t size : shape) count *= size;
  if (count == 0) return;
  demand(H5Dwrite(made, detail::type_of(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
}

void Hdf5Image::write_array_of_rows(const std::string& path, NumberType type, const std::vector<const void*>& rows,
                                    std::size_t columns, const Note& note) {
  const auto space = Library::space_of({rows.size(), columns});
  demand(space.good());
  const auto made = library_->create(path, detail::type_of(type), space, note);
  if (rows.empty() || columns == 0) return;
  const auto row_space = Library::space_of({columns});
  demand(row_space.good());
  for (hsize_t r = 0; r < rows.size(); ++r) {
    const hsize_t start[] = {r, 0}, count[] = {1, columns};
    demand(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr) >= 0 &&
           H5Dwrite(made, detail::type_of(type), row_space, space, H5P_DEFAULT, rows[r]) >= 0);
  }
}

void Hdf5Image::write(const std::string& path, const std::string& text, const Note& note) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
  demand(type.good() && H5Tset_size(type, text.size() + 1) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0);
  const auto made = library_->create(path, type, space, note);
  demand(H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0);
}

namespace {

/// The size of what is used of a file in memory: the address at its end, which a superblock of version 0 has there.
/// (The library tells the size of the memory, and more is taken of that at a time.)
std::size_t size_of_file(const void* image) {
  constexpr std::size_t version_at = 8, end_at = 40;
  const auto* bytes = static_cast<const unsigned char*>(image);
  demand(bytes[version_at] == 0);
  std::uint64_t end = 0;
  std::memcpy(&end, bytes + end_at, sizeof end);
  return end;
}

}  // namespace

Bytes Hdf5Image::finish() {
  library_->memory.closing = true;
  demand(library_->file.close());
  Bytes whole{{library_->memory.data, &std::free}, size_of_file(library_->memory.data)};
  library_->memory.data = nullptr;
  return whole;
}

}  // namespace scarp::io
