// read_excellon: reads drill files, as layout programs write them for board manufacturers, into holes, slots and routed
// paths.
//
// Supports the Excellon formats 1 and 2: METRIC and INCH; suppressed leading or trailing zeros, or decimal points;
// tools defined in the header, where they are used, behind the holes, or in Allegro's comments; slots by G85, routed
// slots (G00, M15, G01 to G03, M16; M15 may be missing); repeats (R); G90, G91 and G93; headers without an end; the
// comments in which KiCad, Altium, EasyEDA and Allegro state their format or unit. What the file does not state is
// guessed from the numbers and noted in Drawing::notes. Routes in another plane, patterns and mirrored axes
// are refused.
//
// Time and memory are proportional to the text and to the number of holes, at most `most_drawn`. Invalid input produces
// diagnostics "excellon.…" with line and column.
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

// Values given by the user, which override the file.
struct ExcellonOptions {
  std::optional<bool> inch = {};
  std::optional<LeftOutZeros> zeros = {};
};

// Reports errors in `diagnostics`; the drawing then contains what was read before the error.
Drawing read_excellon(const std::string& name, std::string_view text, const ExcellonOptions& options,
                      Diagnostics& diagnostics);

// Returns whether the beginning of the text looks like a drill file.
bool looks_like_excellon(std::string_view text);

}  // namespace passo
