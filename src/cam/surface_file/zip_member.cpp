#include "passo/surface_file/zip_member.hpp"

#include "zip_archive.hpp"

namespace passo {

Result<std::string, std::string> read_zip_member(std::string_view bytes, const std::string& name, std::size_t most) {
  const ZipArchive archive(bytes);
  if (!archive.is_open()) return Failure{std::string("the archive is damaged")};
  std::string text;
  const std::string trouble = archive.read(name, most, [&text](std::string_view piece) {
    text += piece;
    return true;
  });
  if (!trouble.empty()) return Failure{trouble};
  return text;
}

}  // namespace passo
