// What stands before the first letter of a text file: marks of its encoding.
#pragma once

#include <string>

namespace scarp {

/// Takes the byte order mark of UTF-8 (EF BB BF), which editors on Windows write and do not show, off the front of a
/// text. Throws InputError for a text in UTF-16 or UTF-32, told by its own mark or by the zero bytes between its
/// letters; `file` stands for it in the message.
void drop_byte_order_mark(std::string& text, const std::string& file);

}  // namespace scarp
