// Checkpoints: any bytes are refused by their seal; a good file of which the input changes values, types, shapes and
// texts, or drops arrays, sealed again as a user's program might, is loaded or an InputError. A step is then taken from
// what was loaded: it may fail with a RunError, and ends nothing.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scarp/base/error.hpp"
#include "scarp/exec/parallel.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/run/body_state.hpp"
#include "scarp/run/build.hpp"
#include "scarp/run/checkpoint.hpp"
#include "scarp/run/run_state.hpp"
#include "scarp/run/runner.hpp"
#include "scarp/run/scheme.hpp"
#include "scarp/step/step.hpp"

namespace scarp::run {
namespace {

constexpr const char* name = "checkpoint_0000000000.h5";
constexpr const char* text = R"(title = "two columns"
[mesh]
grid = { size = [2.0, 2.0], element = 0.5 }
[[material]]
name = "rock"
model = "linear-elastic"
density = 2.2
E = 1e4
nu = 0.25
[[material]]
name = "soft"
model = "mohr-coulomb"
density = 2.0
E = 1e4
nu = 0.3
c = 5.0
phi = 30.0
psi = 5.0
[[region]]
name = "left"
material = "rock"
polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
spacing = 0.25
K0 = 0.6
[[region]]
name = "right"
material = "soft"
polygon = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0]]
spacing = 0.25
K0 = 0.6
[[boundary]]
nodes = "bottom"
fix = ["x", "y"]
[[stage]]
name = "cut"
duration = 0.2
remove = { polygon = [[0.0, 0.5], [1.0, 0.5], [1.0, 1.0], [0.0, 1.0]], lifts = 2, over = 0.1 }
rest = { unbalanced = 1e-3 }
[[stage]]
name = "settle"
duration = 0.2
damping = 0.5
)";

/// Numbers that a program, a user or a bad disk might leave in a file.
constexpr std::array spoilt{0.0,    -1.0,         1.0,           2.0,          1e300, -1e300,
                            1e-300, 2147483647.0, -2147483648.0, 4294967296.0, 255.0, 1e19};

double number(std::uint8_t byte) {
  if (byte == 255) return std::numeric_limits<double>::quiet_NaN();
  if (byte == 254) return std::numeric_limits<double>::infinity();
  return byte < spoilt.size() ? spoilt[byte] : byte / 16.0;
}

template <class Value>
Value number_as(std::uint8_t byte) {
  const double its = number(byte);
  if constexpr (std::is_same_v<Value, double>) return its;
  if (!(its >= static_cast<double>(std::numeric_limits<Value>::min()))) return std::numeric_limits<Value>::min();
  if (!(its < static_cast<double>(std::numeric_limits<Value>::max()))) return std::numeric_limits<Value>::max();
  return static_cast<Value>(its);
}

template <class Value>
using List = std::vector<Value>;

/// An array of a file, or a text.
struct Array {
  std::string path;
  io::Shape shape;
  std::variant<std::string, List<double>, List<std::int32_t>, List<std::int64_t>, List<std::uint8_t>> content;
};

std::size_t count_of(const io::Shape& shape) {
  std::size_t count = 1;
  for (const std::size_t size : shape) count *= size;
  return count;
}

/// Is it an array of these? A file refuses to read one as another.
template <class Value>
bool take(const io::Hdf5File& file, Array& array) {
  try {
    List<Value> values(count_of(array.shape));
    file.read(array.path, array.shape, values.data());
    array.content = std::move(values);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// What a run keeps before its second stage, and the case that it is of.
struct Good {
  input::CaseOf<2> input = std::get<input::CaseOf<2>>(input::read_case_text(text, "case.toml"));
  bool listed;  ///< are its elements listed, as those of a file? They are those of the case's grid.
  std::vector<Array> arrays;

  explicit Good(bool is_listed) : listed(is_listed) {
    Body<2> body = build_body(input);
    if (listed) {
      Body<2> same = ground();
      same.fields[0].blocks = std::move(body.fields[0].blocks);
      body = std::move(same);
      locate_points(body, false);
    }
    auto state = new_state(body);
    state.stages.emplace_back().name = "cut";
    state.stage.emplace(input, 0, state.ledger, body);
    state.warnings = {"of something"};
    CheckpointHead head;
    head.case_text = text;
    head.mesh = mesh_hash(*body.mesh);
    head.files = {{"hill.stl", "0123"}};
    io::Hdf5Image image;
    const Saver save(image, "scarp");
    save_head(save, head);
    save_run(save, state);
    save_body(save, body);
    const auto bytes = image.finish();
    const io::Hdf5File file(bytes.data.get(), bytes.size, name);
    for (const auto& path : file.paths()) {
      Array array{path, {}, {}};
      try {
        array.content = file.text(path);
      } catch (const InputError&) {
        array.shape = file.shape(path);
        if (!take<double>(file, array) && !take<std::int32_t>(file, array) && !take<std::int64_t>(file, array) &&
            !take<std::uint8_t>(file, array))
          std::abort();
      }
      arrays.push_back(std::move(array));
    }
  }

  /// Without points.
  Body<2> ground() const {
    Body<2> grid = build_ground(input);
    if (!listed) return grid;
    Mesh<2> mesh;
    mesh.lists.offsets = {0};
    for (int n = 0; n < grid.mesh->node_count(); ++n) mesh.lists.nodes.push_back(grid.mesh->node(n));
    for (int e = 0; e < grid.mesh->element_count(); ++e) {
      const int first = e / 4 * 5 + e % 4;  // of 4 by 4 elements
      mesh.lists.connectivity.insert(mesh.lists.connectivity.end(), {first, first + 1, first + 6, first + 5});
      mesh.lists.types.push_back(ElementType::Q4);
      mesh.lists.offsets.push_back(static_cast<int>(mesh.lists.connectivity.size()));
    }
    complete(mesh);
    Body<2> body(std::make_unique<const Mesh<2>>(std::move(mesh)), input.gravity);
    body.fields[0].blocks = std::move(grid.fields[0].blocks);
    body.conditions = std::move(grid.conditions);
    return body;
  }
};

/// The input as a row of numbers, which ends in zeros.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  bool ended() const { return left_ == 0; }
  std::uint8_t next() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  std::size_t below(std::size_t count) {
    const std::size_t high = next();
    return count == 0 ? 0 : (high * 256 + next()) % count;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

void resize(Array& array, const io::Shape& shape) {
  array.shape = shape;
  std::visit([&](auto& its) { its.resize(count_of(shape)); }, array.content);
}

/// One change of one array.
void change(Input& input, std::vector<Array>& arrays) {
  const std::size_t which = input.below(arrays.size());
  Array& array = arrays[which];
  const auto what = input.next() % 8;
  if (auto* words = std::get_if<std::string>(&array.content)) {
    const std::size_t at = input.below(words->size() + 1);
    if (what == 7)
      arrays.erase(arrays.begin() + static_cast<std::ptrdiff_t>(which));
    else if (what < 4)
      words->insert(at, 1, static_cast<char>(input.next()));
    else
      words->erase(at);
    return;
  }
  if (what < 5) {
    std::visit(
        [&]<class Content>(Content& its) {
          using Value = typename Content::value_type;
          if (its.empty()) return;
          const std::size_t at = input.below(its.size());
          its[at] = number_as<Value>(input.next());
        },
        array.content);
  } else if (what == 5) {
    auto shape = array.shape;
    const auto how = input.next();
    if (shape.empty() || how % 8 == 7)
      shape.assign(how % 3, how % 5);
    else
      shape[how % shape.size()] = std::size_t{how} / 2 % 40;
    resize(array, shape);
  } else if (what == 6) {
    const std::size_t count = count_of(array.shape);
    const auto type = input.next() % 3;
    if (type == 0)
      array.content = List<double>(count);
    else if (type == 1)
      array.content = List<std::int32_t>(count);
    else
      array.content = List<std::uint8_t>(count);
  } else {
    arrays.erase(arrays.begin() + static_cast<std::ptrdiff_t>(which));
  }
}

std::string sealed_file(const std::vector<Array>& arrays) {
  io::Hdf5Image image;
  const io::Note note{"", ""};
  for (const auto& array : arrays) {
    std::visit(
        [&]<class Content>(const Content& its) {
          if constexpr (std::is_same_v<Content, std::string>)
            image.write(array.path, its, note);
          else
            image.write(array.path, array.shape, its.data(), note);
        },
        array.content);
  }
  const auto bytes = image.finish();
  std::string content(static_cast<const char*>(bytes.data.get()), bytes.size);
  return content + seal_of(content.data(), content.size());
}

/// Calls `read`, which may throw InputErrors that say what is wrong, in which file, and what to do about it. Was there
/// one?
template <class Read>
bool refused(Read&& read) {
  try {
    read();
    return false;
  } catch (const InputError& error) {
    const std::string all = error.what();
    if (!error.problem().empty() && !error.remedy().empty() && all.find(name) != all.npos) return true;
    fmt::print(stderr, "an error without problem, file or remedy: {}\n", all);
    std::abort();
  }
}

void load(const Good& good, const std::string& content, Elements elements) {
  const CheckpointFile file(name, content, false);
  Body<2> body = good.ground();
  load_body(file.load(), elements, body);
  auto state = new_state(body);
  load_run(file.load(), good.input, body, state);
  try {
    if (state.stage && state.stage->removal) state.stage->removal->take_due(1.0, body, state.ledger);
    StepSettings settings;
    settings.scheme = scheme_of(good.input.method);
    advance(body, 1e-4, settings);
  } catch (const RunError&) {
  }
}

}  // namespace
}  // namespace scarp::run

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scarp::run;
  static const int threads = scarp::exec::set_threads(1);  // of so few points one is the fastest
  static const Good on_grid(false), on_list(true);
  if (threads != 1) std::abort();
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  if (!refused([&] { CheckpointFile(name, bytes, false); })) std::abort();
  Input input(data, size);
  const auto kind = input.next();
  const auto& good = kind & 2 ? on_list : on_grid;
  const auto elements = kind & 1 ? Elements::by_place : Elements::as_kept;
  auto arrays = good.arrays;
  for (int i = 0; i < 8 && !input.ended() && !arrays.empty(); ++i) change(input, arrays);
  refused([&] { load(good, sealed_file(arrays), elements); });
  return 0;
}
