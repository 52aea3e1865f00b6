#include "passo/post_processor/controller_words.hpp"

#include <algorithm>
#include <array>

namespace passo {
namespace {

// Radii and angles that the post-processors of CAM programs for these controllers have in common.
constexpr ArcLimits half_circles{.least_radius = 0.01, .most_radius = 1000, .most_degrees = 180};

constexpr ControllerWords passo_words{.name = "passo",
                                      .title = "Passo",
                                      .documentation = "docs/compatibility.md",
                                      .letters = "",
                                      .g_words = "",
                                      .m_words = ""};

// The path mode without P cuts corners as far as the feed rate requires, so a tolerance is stated.
constexpr ControllerWords linuxcnc{
    .name = "linuxcnc",
    .title = "LinuxCNC 2.9",
    .documentation = "https://linuxcnc.org/docs/stable/html/gcode/g-code.html",
    .letters = "ABCDEFGHIJKLMNPQRSTUVWXYZ",
    .g_words =
        "0 1 2 3 4 5 5.1 5.2 5.3 7 8 10 17 17.1 18 18.1 19 19.1 20 21 28 28.1 30 30.1 33 33.1 38.2 38.3 38.4 38.5 "
        "40 41 41.1 42 42.1 43 43.1 43.2 49 52 53 54 55 56 57 58 59 59.1 59.2 59.3 61 61.1 64 70 71 71.1 71.2 72 "
        "72.1 72.2 73 74 76 80 81 82 83 84 85 86 87 88 89 90 90.1 91 91.1 92 92.1 92.2 92.3 93 94 95 96 97 98 99",
    .m_words = "0 1 2 3 4 5 6 7 8 9 19 30 48 49 50 51 52 53 60 61 62 63 64 65 66 67 68 70 71 72 73 98 99",
    .tool_call = ToolCall::m6_and_length,
    .arcs = {.least_radius = 0.01, .most_radius = 10'000},
    .form = {.path_mode = "G64", .has_path_tolerance = true},
    .comments = {.longest_line = 255}};

// Positions are single floats, whose digits end at 0.1 um near 1 m. M6 and canned cycles are errors. Bytes from 0x80
// are commands: an accented letter in a comment can change the feed override.
constexpr ControllerWords grbl{
    .name = "grbl",
    .title = "Grbl 1.1",
    .documentation = "https://github.com/gnea/grbl/tree/master/doc/markdown",
    .letters = "FGIJKLMNPRSTXYZ",
    .g_words =
        "0 1 2 3 4 10 17 18 19 20 21 28 28.1 30 30.1 38.2 38.3 38.4 38.5 40 43.1 49 53 54 55 56 57 58 59 61 80 90 "
        "91 91.1 92 92.1 93 94",
    .m_words = "0 1 2 3 4 5 7 8 9 30 56",
    .tool_call = ToolCall::pause,
    .arcs = {.least_radius = 0.01, .most_radius = 1000},
    .comments = {.has_messages = false, .is_ascii = true, .realtime = "!?~", .longest_line = 79},
    .lacks_mist = true};

constexpr ControllerWords grblhal{
    .name = "grblhal",
    .title = "grblHAL",
    .documentation = "https://github.com/grblHAL/core/wiki",
    .letters = "ABCDEFGHIJKLMNPQRSTUVWXYZ",
    .g_words =
        "0 1 2 3 4 5 5.1 10 17 18 19 20 21 28 28.1 30 30.1 38.2 38.3 38.4 38.5 40 43 43.1 43.2 49 50 51 53 54 55 "
        "56 57 58 59 59.1 59.2 59.3 61 73 80 81 82 83 84 85 86 89 90 91 91.1 92 92.1 92.2 92.3 93 94 98 99",
    .m_words = "0 1 2 3 4 5 6 7 8 9 30 48 49 50 51 53 56 60 61 62 63 64 65 66 67 68 98 99",
    .tool_call = ToolCall::m6,
    .arcs = {.least_radius = 0.01, .most_radius = 1000},
    .comments = {.is_ascii = true, .realtime = "!?~", .longest_line = 255}};

constexpr ControllerWords mach3{
    .name = "mach3",
    .title = "Mach3",
    .documentation = "Using Mach3Mill, chapter 10 (Artsoft)",
    .letters = "ABCDFGHIJKLMNOPQRSTXYZ",
    .g_words =
        "0 1 2 3 4 10 12 13 15 16 17 18 19 20 21 28 28.1 30 31 40 41 42 43 49 50 51 52 53 54 55 56 57 58 59 61 64 68 "
        "69 70 71 73 80 81 82 83 84 85 86 88 89 90 90.1 91 91.1 92 92.1 92.2 92.3 93 94 95 98 99",
    .m_words = "0 1 2 3 4 5 6 7 8 9 30 47 48 49 98 99",
    .tool_call = ToolCall::m6_and_length,
    .arcs = half_circles,
    .form = {.end = "M30", .path_mode = "G64"},
    .comments = {.is_ascii = true, .longest_line = 255}};

// Series 0i and similar controllers: the words that are the same in all of them.
constexpr ControllerWords fanuc_like{
    .name = "fanuc-like",
    .title = "Fanuc-like",
    .documentation = "Fanuc Series 0i-MF operator's manual B-64694EN, II Programming",
    .letters = "ABCDFGHIJKLMNOPQRSTXYZ",
    .g_words =
        "0 1 2 3 4 10 11 15 16 17 18 19 20 21 22 23 27 28 29 30 31 40 41 42 43 44 49 50 51 52 53 54 54.1 55 56 57 58 "
        "59 61 63 64 65 66 67 68 69 73 74 76 80 81 82 83 84 85 86 87 88 89 90 91 92 94 95 96 97 98 99",
    .m_words = "0 1 2 3 4 5 6 7 8 9 19 29 30 98 99",
    .tool_call = ToolCall::m6_and_length,
    .arcs = half_circles,
    .numbers = {.mm_decimals = 3, .inch_decimals = 4, .has_point = true},
    .form = {.end = "M30", .has_frame = true, .line_step = 10, .dwells_in_ms = true},
    .comments = {.has_messages = false, .has_capitals_only = true, .is_ascii = true, .longest_line = 79}};

constexpr std::array rows{passo_words, linuxcnc, grbl, grblhal, mach3, fanuc_like};

}  // namespace

bool ControllerWords::is_listed(std::string_view list, std::string_view number) {
  for (std::size_t at = list.find(number); at != std::string_view::npos; at = list.find(number, at + 1)) {
    const std::size_t end = at + number.size();
    if ((at == 0 || list[at - 1] == ' ') && (end == list.size() || list[end] == ' ')) return true;
  }
  return false;
}

std::span<const ControllerWords> controllers() {
  return rows;
}

const ControllerWords* find_controller(std::string_view name) {
  const auto* const found = std::ranges::find(rows, name, &ControllerWords::name);
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace passo
