// Recognises files that are often given instead of a G-code program: drawings, pictures, models, archives.
#pragma once

#include <string>
#include <string_view>

#include "passo/base/sentence.hpp"

namespace passo {

struct ForeignFile {
  std::string_view kind;  // "a DXF drawing"; empty: the file was not recognised
  SentenceRow expected;   // how to get G-code from it
};

// `first` are the first bytes of the file, about a kilobyte. The format is detected from the contents; the extension is
// only used for binary data without a signature, and to tell two similar text formats apart.
ForeignFile foreign_file(const std::string& name, std::string_view first);

}  // namespace passo
