#include "passo/cam/dxf.hpp"

#include "dxf_document.hpp"
#include "dxf_expansion.hpp"
#include "text_lines.hpp"

namespace passo {

Drawing read_dxf(const std::string& name, std::string_view text, const DxfOptions& options, Diagnostics& diagnostics) {
  const DxfDocument document = read_dxf_document(name, text, diagnostics);
  if (diagnostics.any_error()) {
    Drawing nothing;
    nothing.file = name;
    return nothing;
  }
  return DxfExpansion(name, document, options, diagnostics).expand();
}

bool looks_like_dxf(std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF")) return true;
  TextLines lines(text);
  std::string_view code;
  std::string_view value;
  for (int i = 0; i < 50 && lines.next(code) && lines.next(value); ++i) {
    code = trimmed(code);
    if (code == "0" && trimmed(value) == "SECTION") return true;
    if (code != "999") return false;
  }
  return false;
}

}  // namespace passo
