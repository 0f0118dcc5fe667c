#include "scarp/base/text.hpp"

#include <string_view>

#include "scarp/base/error.hpp"

namespace scarp {
namespace {

using namespace std::string_view_literals;

/// The encoding of a text that is not UTF-8, or "". UTF-32 goes before UTF-16: its mark begins with that of the other.
const char* foreign_encoding(std::string_view text) {
  if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv)) return "UTF-32";
  if (text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv)) return "UTF-16";
  // Without a mark: of the first letter, which is ASCII in every file that scarp reads, one byte is zero.
  if (text.size() >= 4 && (text[0] == '\0') != (text[1] == '\0'))
    return text[2] == '\0' && text[3] == '\0' ? "UTF-32" : "UTF-16";
  return "";
}

}  // namespace

void drop_byte_order_mark(std::string& text, const std::string& file) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (const std::string encoding = foreign_encoding(text); !encoding.empty())
    throw InputError("the text is not in UTF-8", encoding,
                     "save it as UTF-8: in the editor's \"save as\", or iconv -f " + encoding + " -t UTF-8",
                     {file, 1, 1});
}

}  // namespace scarp
