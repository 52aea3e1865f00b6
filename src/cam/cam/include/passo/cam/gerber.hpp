// read_gerber: reads a layer of a circuit board, as layout programs write it for board manufacturers, into its copper
// (or solder mask, or silkscreen), its pads and the centre lines of its strokes.
//
// Supports Gerber X3, X2 and RS-274X: all coordinate formats and both units; apertures of all shapes with holes, and
// macros with all primitives, variables and arithmetic; lines and arcs in single and multi quadrant mode; regions of
// several contours; dark and clear polarity; mirrored, rotated and scaled apertures; step and repeat; nested aperture
// blocks; attributes, also in comments. The deprecated image codes (AS, MI, SF, OF, IR) are applied. Guesses and
// ignored commands are noted. RS-274-D, whose apertures are in another file, is refused.
//
// Arcs become chords within 0.5 um, and a round stroke is within 1 um of its true outline; both stay inside the true
// shape.
//
// Time and memory are proportional to the text and to its repetitions, at most `most_gerber_points`; rings with too
// many crossings are refused before they are united. Invalid input produces diagnostics "gerber.…" with line and
// column.
//
// Source: Ucamco, The Gerber Layer Format Specification 2024.05.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

inline constexpr std::size_t most_gerber_points = 16'000'000;  // maximum number of points of all rings before they are
                                                               // united

struct GerberAperture {
  std::uint32_t code = 0;     // 10: D10
  std::string shape = {};     // "C", "R", "O", "P", or the name of a macro; empty: a block
  Nanometres across = {};     // width of a flash, along X
  Nanometres up = {};         // height of a flash, along Y
  std::string function = {};  // .AperFunction: "ViaPad"
};

struct GerberPad {
  DrawnPoint at = {};
  std::uint32_t aperture = 0;  // index into GerberLayer::apertures
  std::uint32_t net = 0;       // index into GerberLayer::nets
  std::uint32_t line = 0;      // line of the file, from 1
};

struct GerberLayer {
  Region dark = {};      // the area that the layer covers
  Drawing strokes = {};  // centre lines of the dark strokes with a round aperture, with its diameter as width; one
                         // layer per aperture
  std::vector<GerberAperture> apertures = {};
  std::vector<GerberPad> pads = {};      // the dark flashes
  std::vector<GerberPad> named = {};     // a place on each dark stroke and contour that has a net
  std::vector<std::string> nets = {""};  // .N; the first entry is for objects without a net
  std::string function = {};             // .FileFunction: "Copper,L1,Top"
  std::string software = {};             // .GenerationSoftware
  bool is_negative = false;              // .FilePolarity, IPNEG: dark areas are free of copper
};

// Reports errors in `diagnostics`; the layer then contains what was read before the error. Notes are in strokes.notes.
// The fuzzer sets a lower `most_points`, so that each input is read quickly.
GerberLayer read_gerber(const std::string& name, std::string_view text, Diagnostics& diagnostics,
                        std::size_t most_points = most_gerber_points);

// Returns whether the beginning of the text looks like a Gerber file.
bool looks_like_gerber(std::string_view text);

}  // namespace passo
