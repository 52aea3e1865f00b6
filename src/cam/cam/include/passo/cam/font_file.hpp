// find_font: finds an installed font by its family and style, as fontconfig knows them.
//
// The name is a family, e.g. "DejaVu Sans" in any case, followed by words for the style after colons, e.g. "DejaVu
// Sans:bold" or "DejaVu Sans:bold:italic", or the style's own name: "DejaVu Sans:style=Condensed Bold". The generic
// families sans, serif and monospace stand for the system's default fonts. Only outline fonts (TrueType, OpenType) are
// considered.
//
// No other family is substituted: an unknown family is an error "engrave.no-family" that names similar ones, an unknown
// style an error "engrave.no-style" that names those of the family.
//
// The first call reads fontconfig's configuration and its cache of the installed fonts: about 20 ms.
//
// Source: fontconfig 2.14.
#pragma once

#include <optional>
#include <string>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct FontFile {
  std::string path = {};
  std::string name = {};  // family and style, e.g. "DejaVu Sans Bold"
  // The index of the font in a collection (.ttc). The upper 16 bits contain the instance of a variable font, counted
  // from 1.
  int face = 0;
};

// Reports errors in `diagnostics`.
std::optional<FontFile> find_font(const std::string& wanted, Diagnostics& diagnostics);

// Returns whether the text names a file rather than a family: it contains a slash, or has the extension of a font file.
bool names_font_file(const std::string& text);

}  // namespace passo
