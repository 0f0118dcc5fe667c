// HDF5 files in memory. Oracles: what was written; the library's own reading of the file (its types and shapes).
#include "scarp/io/hdf5.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "scarp/base/error.hpp"

namespace scarp::io::test {
namespace {

constexpr Note note{"kPa", "of the soil, σ"};

Bytes example() {
  Hdf5Image image;
  const std::vector<double> x{1.5, -0.0, std::numeric_limits<double>::denorm_min(), 1e308}, y{4, 5, 6, 7};
  const std::vector<const double*> rows{x.data(), y.data()};
  const std::vector<std::int32_t> ids{3, -1};
  const std::int64_t steps = std::int64_t{1} << 60;
  image.write_rows<double>("a/rows", rows, 4, note);
  image.write("a/b/ids", {2}, ids.data(), {"", "numbers"});
  image.write("steps", {}, &steps, {"", ""});
  image.write("text", std::string("a case\nwith \"σ\""), {"", ""});
  image.write("none", {0}, x.data(), {"", ""});
  image.write("empty", std::string(), {"", ""});
  return image.finish();
}

TEST(Hdf5, WhatIsWrittenIsRead) {
  const auto bytes = example();
  EXPECT_EQ(std::memcmp(bytes.data.get(), "\x89HDF\r\n\x1a\n", 8), 0);
  const Hdf5File file(bytes.data.get(), bytes.size, "example.h5");
  EXPECT_EQ(file.paths(), (std::vector<std::string>{"a/b/ids", "a/rows", "empty", "none", "steps", "text"}));
  EXPECT_EQ(file.shape("a/rows"), (Shape{2, 4}));
  std::vector<double> x(4), y(4), both(8);
  file.read_rows<double>("a/rows", std::vector<double*>{x.data(), y.data()}, 4);
  EXPECT_EQ(x[2], std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(std::signbit(x[1]));
  EXPECT_EQ(y, (std::vector<double>{4, 5, 6, 7}));
  file.read("a/rows", {2, 4}, both.data());
  EXPECT_EQ(both[3], 1e308);
  EXPECT_EQ(both[4], 4);
  std::vector<std::int32_t> ids(2);
  file.read("a/b/ids", {2}, ids.data());
  EXPECT_EQ(ids, (std::vector<std::int32_t>{3, -1}));
  std::int64_t steps = 0;
  file.read("steps", {}, &steps);
  EXPECT_EQ(steps, std::int64_t{1} << 60);
  EXPECT_EQ(file.text("text"), "a case\nwith \"σ\"");
  EXPECT_EQ(file.text("empty"), "");
  EXPECT_EQ(file.shape("none"), (Shape{0}));
  EXPECT_EQ(file.note("a/rows")[0], "kPa");
  EXPECT_EQ(file.note("a/rows")[1], "of the soil, σ");
  EXPECT_TRUE(file.has("a/b"));
  EXPECT_FALSE(file.has("a/c"));
  EXPECT_FALSE(file.has("b/ids/deeper"));
}

TEST(Hdf5, TheSameContentGivesTheSameBytes) {
  const auto first = example(), second = example();
  ASSERT_EQ(first.size, second.size);
  EXPECT_EQ(std::memcmp(first.data.get(), second.data.get(), first.size), 0);
}

/// The error of f says all of `parts`.
template <class F>
void expect_refused(F&& f, const std::vector<std::string>& parts) {
  try {
    f();
    ADD_FAILURE() << "nothing was refused";
  } catch (const InputError& error) {
    for (const auto& part : parts) EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Hdf5, WhatDoesNotFitIsNamed) {
  const auto bytes = example();
  const Hdf5File file(bytes.data.get(), bytes.size, "example.h5");
  double number = 0;
  std::int32_t whole = 0;
  expect_refused([&] { file.read("a/c", {}, &number); }, {"\"a/c\"", "is missing", "example.h5"});
  expect_refused([&] { file.read("steps", {}, &number); }, {"\"steps\"", "is not of type float64"});
  expect_refused([&] { file.read("a/b/ids", {3}, &whole); }, {"has the shape (2), and (3) is needed"});
  expect_refused([&] { file.text("steps"); }, {"is not a text"});
  expect_refused([&] { file.shape("a"); }, {"is missing"});
}

TEST(Hdf5, WhatIsNoFileIsRefused) {
  expect_refused([] { Hdf5File("no file", 7, "text.h5"); }, {"is not one of HDF5", "text.h5"});
  const auto bytes = example();
  expect_refused([&] { Hdf5File(bytes.data.get(), bytes.size / 2, "half.h5"); }, {"is not one of HDF5", "half.h5"});
}

TEST(Hdf5, SeveralAreOpenAtATime) {
  const auto bytes = example();
  const Hdf5File first(bytes.data.get(), bytes.size, "one"), second(bytes.data.get(), bytes.size, "one");
  Hdf5Image image;
  image.write("text", std::string("more"), {"", ""});
  EXPECT_EQ(first.text("text"), second.text("text"));
  const auto more = image.finish();
  EXPECT_EQ(Hdf5File(more.data.get(), more.size, "more").text("text"), "more");
}

TEST(Hdf5, AnImageGrowsBeyondWhatWasExpected) {
  Hdf5Image image;
  const std::vector<double> many(1 << 19, 0.5);  // 4 MB in pieces of 256 kB
  for (const char* name : {"a", "b", "c"}) image.write(name, {many.size()}, many.data(), {"", ""});
  const auto bytes = image.finish();
  EXPECT_LT(bytes.size, 3 * many.size() * sizeof(double) + 8192);
  const Hdf5File file(bytes.data.get(), bytes.size, "many");
  std::vector<double> back(many.size());
  file.read("c", {back.size()}, back.data());
  EXPECT_EQ(back, many);
}

}  // namespace
}  // namespace scarp::io::test
