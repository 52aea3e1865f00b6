// Recognises files that are often given in the place of a G-code program: drawings, pictures, models, archives.
#pragma once

#include <string>
#include <string_view>

namespace passo {

struct ForeignFile {
  std::string_view kind;      // "a DXF drawing"; empty: nothing foreign was recognised
  std::string_view expected;  // what leads from there to G-code
};

// `first` are the first bytes of the file, about a kilobyte. The content decides. The end of the name tells what binary
// data are that have no mark of their own, and which of two kinds of text is meant.
ForeignFile foreign_file(const std::string& name, std::string_view first);

}  // namespace passo
