#include "passo/cam/drawn_colour.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "svg_selection.hpp"

namespace passo {
namespace {

// Of CSS Color Module Level 3, without those that svg_colour() turns into numbers.
constexpr std::array<std::string_view, 128> other_colour_names = {"aliceblue",
                                                                  "antiquewhite",
                                                                  "aquamarine",
                                                                  "azure",
                                                                  "beige",
                                                                  "bisque",
                                                                  "blanchedalmond",
                                                                  "blueviolet",
                                                                  "burlywood",
                                                                  "cadetblue",
                                                                  "chartreuse",
                                                                  "chocolate",
                                                                  "coral",
                                                                  "cornflowerblue",
                                                                  "cornsilk",
                                                                  "crimson",
                                                                  "currentcolor",
                                                                  "darkblue",
                                                                  "darkcyan",
                                                                  "darkgoldenrod",
                                                                  "darkgray",
                                                                  "darkgreen",
                                                                  "darkgrey",
                                                                  "darkkhaki",
                                                                  "darkmagenta",
                                                                  "darkolivegreen",
                                                                  "darkorange",
                                                                  "darkorchid",
                                                                  "darkred",
                                                                  "darksalmon",
                                                                  "darkseagreen",
                                                                  "darkslateblue",
                                                                  "darkslategray",
                                                                  "darkslategrey",
                                                                  "darkturquoise",
                                                                  "darkviolet",
                                                                  "deeppink",
                                                                  "deepskyblue",
                                                                  "dimgray",
                                                                  "dimgrey",
                                                                  "dodgerblue",
                                                                  "firebrick",
                                                                  "floralwhite",
                                                                  "forestgreen",
                                                                  "gainsboro",
                                                                  "ghostwhite",
                                                                  "gold",
                                                                  "goldenrod",
                                                                  "greenyellow",
                                                                  "honeydew",
                                                                  "hotpink",
                                                                  "indianred",
                                                                  "indigo",
                                                                  "ivory",
                                                                  "khaki",
                                                                  "lavender",
                                                                  "lavenderblush",
                                                                  "lawngreen",
                                                                  "lemonchiffon",
                                                                  "lightblue",
                                                                  "lightcoral",
                                                                  "lightcyan",
                                                                  "lightgoldenrodyellow",
                                                                  "lightgray",
                                                                  "lightgreen",
                                                                  "lightgrey",
                                                                  "lightpink",
                                                                  "lightsalmon",
                                                                  "lightseagreen",
                                                                  "lightskyblue",
                                                                  "lightslategray",
                                                                  "lightslategrey",
                                                                  "lightsteelblue",
                                                                  "lightyellow",
                                                                  "limegreen",
                                                                  "linen",
                                                                  "mediumaquamarine",
                                                                  "mediumblue",
                                                                  "mediumorchid",
                                                                  "mediumpurple",
                                                                  "mediumseagreen",
                                                                  "mediumslateblue",
                                                                  "mediumspringgreen",
                                                                  "mediumturquoise",
                                                                  "mediumvioletred",
                                                                  "midnightblue",
                                                                  "mintcream",
                                                                  "mistyrose",
                                                                  "moccasin",
                                                                  "navajowhite",
                                                                  "oldlace",
                                                                  "olivedrab",
                                                                  "orangered",
                                                                  "orchid",
                                                                  "palegoldenrod",
                                                                  "palegreen",
                                                                  "paleturquoise",
                                                                  "palevioletred",
                                                                  "papayawhip",
                                                                  "peachpuff",
                                                                  "peru",
                                                                  "pink",
                                                                  "plum",
                                                                  "powderblue",
                                                                  "rebeccapurple",
                                                                  "rosybrown",
                                                                  "royalblue",
                                                                  "saddlebrown",
                                                                  "salmon",
                                                                  "sandybrown",
                                                                  "seagreen",
                                                                  "seashell",
                                                                  "sienna",
                                                                  "skyblue",
                                                                  "slateblue",
                                                                  "slategray",
                                                                  "slategrey",
                                                                  "snow",
                                                                  "springgreen",
                                                                  "steelblue",
                                                                  "tan",
                                                                  "thistle",
                                                                  "tomato",
                                                                  "turquoise",
                                                                  "violet",
                                                                  "wheat",
                                                                  "whitesmoke",
                                                                  "yellowgreen"};

bool is_palette_number(std::string_view text) {
  constexpr int of_layer = 256;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number >= 0 && number <= of_layer;
}

}  // namespace

bool is_drawn_colour(std::string_view text) {
  constexpr std::size_t long_form = 7;
  const std::string colour = svg_colour(text);
  const bool is_number = colour.size() == long_form && colour.front() == '#' &&
                         colour.find_first_not_of("0123456789abcdef", 1) == std::string::npos;
  return is_number || is_palette_number(colour) ||
         std::ranges::find(other_colour_names, colour) != other_colour_names.end();
}

}  // namespace passo
