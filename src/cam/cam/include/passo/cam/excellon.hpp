// read_excellon: drill files, as layout programs write them for board makers, into holes, slots and routed paths.
//
// Reads the Excellon formats 1 and 2: METRIC and INCH, leading or trailing zeros left out, or decimal points; tools in
// the header or where they are used; slots by G85, routed slots (G00, M15, G01 to G03, M16); repeats (R); G90, G91 and
// G93; the comments in which KiCad, Altium and EasyEDA state their format. What the header does not say is guessed from
// the numbers and noted in Drawing::notes. Routes that are cut in another plane, patterns and mirrored axes are
// refused.
//
// Time and memory are proportional to the text and to the holes, of which there are at most `most_drawn`. A hostile
// text gives diagnostics "excellon.…" with line and column.
//
// Source: Excellon, CNC-7 programming; Ucamco, the XNC format specification 2021.11.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

enum class LeftOutZeros : std::uint8_t { leading, trailing };

// What the user knows better than the file.
struct ExcellonOptions {
  std::optional<bool> inch = {};
  std::optional<LeftOutZeros> zeros = {};
};

// Errors are in `diagnostics`; the drawing then holds what was read so far.
Drawing read_excellon(const std::string& name, std::string_view text, const ExcellonOptions& options,
                      Diagnostics& diagnostics);

// Whether the text begins like a drill file.
bool looks_like_excellon(std::string_view text);

}  // namespace passo
