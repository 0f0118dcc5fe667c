// Reading a Gmsh file piece by piece: text or binary numbers behind one interface, each error with its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace scarp::gmsh {

/// A cursor over the whole file. `what` names the thing to be read in errors, all of which are InputErrors.
///
/// In ASCII files a record is one line: numbers are read from the present line only, so that a missing value is
/// reported where it is missing.
class Scanner {
 public:
  Scanner(std::string file, std::string bytes) : file_(std::move(file)), bytes_(std::move(bytes)) {}

  void set_binary(bool binary) { binary_ = binary; }
  bool binary() const { return binary_; }

  /// Text in either kind of file: skips blanks and line ends; false at the end of the file.
  bool skip_space();
  /// The rest of the present line, without its end; moves on to the next line.
  std::string_view line(const char* what);
  /// The next word of the present line, for the parts that are text in either kind of file.
  std::string_view word(const char* what);
  std::int64_t text_integer(const char* what);

  /// Numbers: words of the present line, or 4-byte integers, 8-byte sizes and doubles.
  std::int64_t integer(const char* what);
  std::uint64_t size(const char* what);
  double number(const char* what);  ///< always finite

  /// ASCII: goes to the next line that is not blank. Binary: nothing to do.
  void begin_record();
  /// ASCII: nothing more may stand on the present line. Binary: nothing to do.
  void end_record();

  /// Checks that `count` things of at least so many bytes each can be in the rest of the file, before anything is
  /// allocated for them.
  std::size_t checked_count(std::uint64_t count, std::size_t bytes_in_ascii, std::size_t bytes_in_binary,
                            const char* what);

  /// Checks that the section ends here.
  void end_section(const std::string& name);
  /// Passes over a section that is not needed.
  void skip_section(const std::string& name);

  /// Where reading is: a line, or a byte in binary files.
  std::size_t here() const { return binary_ ? at_ : line_; }
  /// Where the last number began.
  std::size_t last() const { return binary_ ? last_ : line_; }
  [[noreturn]] void fail(const std::string& problem, const std::string& value, const std::string& remedy,
                         std::size_t where) const;

 private:
  template <class T>
  T raw(const char* what);
  template <class T>
  T parse(std::string_view text, const char* what, const char* kind);
  [[noreturn]] void cut_short(const char* what) const;
  void skip_blanks();

  std::string file_, bytes_;
  bool binary_ = false;
  std::size_t at_ = 0, last_ = 0, line_ = 1;
};

/// A word from the file as it may be shown: short, and without bytes that a terminal cannot show.
std::string shown(std::string_view text);

}  // namespace scarp::gmsh
