// read_gerber: a layer of a circuit board, as layout programs write it for board makers, into its copper (or mask, or
// print), its pads and the centre lines of its strokes.
//
// Reads Gerber X3, X2 and RS-274X: all formats of coordinates and both units; apertures of all shapes with holes, and
// macros with all primitives, variables and arithmetic; lines and arcs in single and multi quadrant mode; regions of
// several contours; dark and clear polarity; mirrored, turned and scaled apertures; step and repeat; aperture blocks,
// one in another; attributes, also in comments. Old codes that move the image (AS, MI, SF, OF, IR) are obeyed. What is
// guessed or ignored is noted. RS-274-D, whose apertures are in another file, is refused.
//
// Arcs are chords within 0.5 um, and a round stroke is within 1 um of its true rim; neither leaves the true shape.
//
// Time and memory are proportional to the text and to what the text repeats, of which there are at most
// `most_gerber_points`; lines that cross too often to be united are refused before it is tried. A hostile text gives
// diagnostics "gerber.…" with line and column.
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

inline constexpr std::size_t most_gerber_points = 16'000'000;  // of all rings before they are united

struct GerberAperture {
  std::uint32_t code = 0;     // 10: D10
  std::string shape = {};     // "C", "R", "O", "P", or a macro's name; empty: a block
  Nanometres across = {};     // of what a flash makes, along X
  Nanometres up = {};         // along Y
  std::string function = {};  // .AperFunction: "ViaPad"
};

struct GerberPad {
  DrawnPoint at = {};
  std::uint32_t aperture = 0;  // index into GerberLayer::apertures
  std::uint32_t net = 0;       // index into GerberLayer::nets
  std::uint32_t line = 0;      // of the file, from 1
};

struct GerberLayer {
  Region dark = {};      // all that the layer covers
  Drawing strokes = {};  // centre lines of dark strokes, as wide as their round aperture; a layer is an aperture
  std::vector<GerberAperture> apertures = {};
  std::vector<GerberPad> pads = {};      // dark flashes
  std::vector<std::string> nets = {""};  // .N; the first is for what has none
  std::string function = {};             // .FileFunction: "Copper,L1,Top"
  std::string software = {};             // .GenerationSoftware
  bool is_negative = false;              // .FilePolarity, IPNEG: what is dark here is free of copper
};

// Errors are in `diagnostics`; the layer then holds what was read so far. Notes are in strokes.notes. A fuzzer asks for
// fewer points: each of its texts has to be read at once.
GerberLayer read_gerber(const std::string& name, std::string_view text, Diagnostics& diagnostics,
                        std::size_t most_points = most_gerber_points);

// Whether the text begins like a Gerber file.
bool looks_like_gerber(std::string_view text);

}  // namespace passo
