#include "passo/gcode/foreign_file.hpp"

#include <algorithm>
#include <cctype>

#include "gcode_sentences.hpp"

#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

// Without codes: they are in English only.
constexpr SentenceRow of_dwg{{}, "G-code; save the drawing as DXF, which passo cam profile, pocket and drill read"};
constexpr SentenceRow of_holes{{}, "G-code; passo cam drill generates it from the holes"};
constexpr SentenceRow of_lines{{}, "G-code; passo cam profile or passo cam pocket generates it from the drawing"};
constexpr SentenceRow of_drawn_holes{
    {}, "G-code; passo cam profile or pocket generates it from the drawing, passo cam drill from its holes"};
constexpr SentenceRow of_plot{{},
                              "G-code; passo cam engrave --on-line or passo cam profile generates it from the plot"};
constexpr SentenceRow of_picture{
    {}, "G-code; save the picture as PNG, JPEG or TIFF, from which passo cam relief generates it"};
constexpr SentenceRow of_png{{}, "G-code; passo cam relief generates it from the picture"};
constexpr SentenceRow of_font{{}, "G-code; passo cam engrave --text --font generates it with the font"};
constexpr SentenceRow of_airfoil{{}, "G-code; passo cam wire --chord generates it from the airfoil"};
constexpr SentenceRow of_heights{{}, "G-code; a height map is for passo level --map or passo cam relief"};
constexpr SentenceRow of_description{
    {}, "G-code; this file is for passo check PROGRAM --machine, or passo simulate --tool-table"};
constexpr SentenceRow of_paper{
    {}, "G-code; save the drawing as SVG or DXF, which passo cam profile, pocket and engrave read"};
constexpr SentenceRow of_body{{}, "G-code; save the model as STL, from which passo cam relief generates it"};
constexpr SentenceRow of_stl{{}, "G-code; passo cam relief or a CAM program generates it from the model"};
constexpr SentenceRow of_model{{}, "G-code; a CAM program generates it from the model"};
constexpr SentenceRow of_circuit{{}, "G-code; passo cam isolate or passo cam outline generates it from the layer"};
constexpr SentenceRow of_board{{}, "G-code; passo cam board generates it from the board"};
constexpr SentenceRow of_archive{{}, "the unpacked program"};
constexpr SentenceRow of_settings{{}, "G-code; a sender transfers settings to a Grbl machine"};
constexpr SentenceRow of_program{{}, "G-code, which is plain text"};

constexpr ForeignFile png{"a PNG picture", of_png};
constexpr ForeignFile jpeg{"a JPEG picture", of_png};
constexpr ForeignFile tiff{"a TIFF picture", of_png};
constexpr ForeignFile gif{"a GIF picture", of_picture};
constexpr ForeignFile bmp{"a BMP picture", of_picture};
constexpr ForeignFile svg{"an SVG drawing", of_lines};
constexpr ForeignFile dxf{"a DXF drawing", of_drawn_holes};
constexpr ForeignFile dwg{"a DWG drawing", of_dwg};
constexpr ForeignFile hpgl{"an HPGL plot", of_plot};
constexpr ForeignFile pdf{"a PDF document", of_paper};
constexpr ForeignFile postscript{"a PostScript document", of_paper};
constexpr ForeignFile svgz{"a compressed SVG drawing", of_lines};
constexpr ForeignFile font{"a font", of_font};
constexpr ForeignFile airfoil{"an airfoil file", of_airfoil};
constexpr ForeignFile heights{"a height map", of_heights};
constexpr ForeignFile description{"a TOML file, e.g. a machine file or a tool table", of_description};
constexpr ForeignFile model{"a mesh (OBJ, PLY, OFF)", of_body};
constexpr ForeignFile model_3mf{"a 3MF model", of_stl};
constexpr ForeignFile gerber{"a Gerber file", of_circuit};
constexpr ForeignFile kicad{"a KiCad board", of_board};
constexpr ForeignFile excellon{"an Excellon drill file", of_holes};
constexpr ForeignFile stl{"an STL model", of_stl};
constexpr ForeignFile step{"a STEP model", of_model};
constexpr ForeignFile gzip{"a gzip archive", of_archive};
constexpr ForeignFile zip{"a ZIP archive", of_archive};
constexpr ForeignFile elf{"a program for a computer or a board (ELF)", of_program};
constexpr ForeignFile printer{"a program for a 3D printer", gcode_says::from_cam};
constexpr ForeignFile settings{"a list of Grbl settings", of_settings};
constexpr ForeignFile xml{"an XML file", of_program};

// "dxf" of "Part.DXF"; empty: none.
std::string ending_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  std::string ending = dot == std::string::npos ? std::string() : name.substr(dot + 1);
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

constexpr std::string_view spaces = " \t\n\v\f\r";

bool is_space(char c) {
  return spaces.find(c) != std::string_view::npos;
}

// Takes the next line that is not blank from the front of the text.
std::string_view take_line(std::string_view& text) {
  std::string_view line;
  while (line.empty() && !text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    line = trimmed(text.substr(0, end), spaces);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return line;
}

ForeignFile by_mark(std::string_view first) {
  struct Mark {
    std::string_view bytes;
    ForeignFile file;
  };
  using namespace std::string_view_literals;
  const Mark marks[] = {{"\x89PNG"sv, png},
                        {"\xFF\xD8\xFF"sv, jpeg},
                        {"II*\0"sv, tiff},
                        {"MM\0*"sv, tiff},
                        {"II+\0"sv, tiff},
                        {"MM\0+"sv, tiff},
                        {"GIF8"sv, gif},
                        {"\x1F\x8B"sv, gzip},
                        {"PK\x03\x04"sv, zip},
                        {"\x7F"
                         "ELF"sv,
                         elf},
                        {"%PDF-"sv, pdf},
                        {"%!PS"sv, postscript},
                        {"\xC5\xD0\xD3\xC6"sv, postscript},
                        {"\0\1\0\0"sv, font},
                        {"OTTO"sv, font},
                        {"ttcf"sv, font},
                        {"true\0"sv, font},
                        {"wOFF"sv, font},
                        {"wOF2"sv, font},
                        {"AutoCAD Binary DXF"sv, dxf},
                        {"AC10"sv, dwg},
                        {"ISO-10303-21"sv, step},
                        {"\x1B.("sv, hpgl},
                        {"\x1B%"sv, hpgl}};
  const auto found = std::ranges::find_if(marks, [&](const Mark& mark) { return first.starts_with(mark.bytes); });
  return found == std::end(marks) ? ForeignFile{} : found->file;
}

bool is_hpgl(std::string_view line, const std::string& ending) {
  const bool is_named = ending == "plt" || ending == "hpgl" || ending == "hpg";
  for (const std::string_view begin : {"IN;", "DF;", "IN;SP", "PU;", "SP1;"}) {
    if (line.starts_with(begin)) return true;
  }
  // Two letters begin each command. No word of G-code has two.
  return is_named && line.size() >= 2 && std::isupper(static_cast<unsigned char>(line[0])) != 0 &&
         std::isupper(static_cast<unsigned char>(line[1])) != 0;
}

// Each command of Gerber ends in a star. In G-code a star begins a checksum, stands in brackets or in a comment.
bool is_gerber(std::string_view line) {
  const bool begins = line.size() > 2 && std::string_view("%GXYDM").find(line[0]) != std::string_view::npos;
  if (!begins || (!line.ends_with("*") && !line.ends_with("*%"))) return false;
  return line.starts_with("G04") || line.find_first_of(";(") == std::string_view::npos;
}

// A header of Excellon begins with M48, which is a code of G-code too. Its units or a tool with a diameter follow.
bool is_excellon(std::string_view line, std::string_view rest, const std::string& ending) {
  while (line.starts_with(';')) line = take_line(rest);
  if (line != "M48") return false;
  if (ending == "drl" || ending == "xln" || ending == "exc") return true;
  const std::string_view next = take_line(rest);
  return next.starts_with("METRIC") || next.starts_with("INCH") || next.starts_with("FMAT") || next.starts_with(';');
}

// Digits, and blanks before them alone.
bool is_count(std::string_view columns) {
  const std::string_view digits = trimmed(columns, spaces);
  return !digits.empty() && columns.ends_with(digits) &&
         std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; });
}

// LibreCAD's fonts say so. Those of Hershey begin with a number in five columns and a count in three, then letters.
bool is_font(std::string_view first, std::string_view line) {
  if (line.starts_with('#') && first.find("LibreCAD Font") != std::string_view::npos) return true;
  const std::string_view whole = first.substr(0, first.find_first_of("\r\n"));
  return whole.size() >= 10 && is_count(whole.substr(0, 5)) && is_count(whole.substr(5, 3)) &&
         std::isupper(static_cast<unsigned char>(whole[8])) != 0 &&
         std::isupper(static_cast<unsigned char>(whole[9])) != 0;
}

// So many numbers between blanks or commas, and nothing else. G-code has letters.
std::size_t numbers_in(std::string_view line) {
  std::size_t count = 0;
  bool in_number = false;
  for (const char c : line) {
    const bool separates = is_space(c) || c == ',';
    if (!separates && std::string_view("0123456789.+-eE").find(c) == std::string_view::npos) return 0;
    if (!separates && !in_number && c != 'e' && c != 'E') ++count;
    in_number = !separates;
  }
  return count;
}

// Lines of X and Y, a name before them perhaps; or lines of X, Y and Z.
ForeignFile by_numbers(std::string_view line, std::string_view rest, const std::string& ending) {
  const std::string_view second = take_line(rest);
  const std::string_view third = take_line(rest);
  const std::string_view fourth = take_line(rest);
  if (numbers_in(line) == 3 && numbers_in(second) == 3) return heights;
  // Lines of a parameter file begin with a whole number, those of a section with a share of its length.
  const auto is_place = [&](std::string_view pair) {
    return numbers_in(pair) == 2 &&
           (ending == "dat" || pair.substr(0, pair.find_first_of(" \t,")).find('.') < pair.size());
  };
  if (is_place(second) && is_place(third) && is_place(fourth)) return airfoil;
  return {};
}

// "[axis.X]" or "name = ": a bracket or an equals sign stands in G-code behind a letter or a #.
bool is_toml(std::string_view first, const std::string& ending) {
  if (ending == "toml") return true;
  for (std::string_view rest = first.substr(0, first.rfind('\n')); !rest.empty();) {
    const std::string_view line = take_line(rest);
    if (line.starts_with("[axis.") || line.starts_with("[tool.") || line.starts_with("[board]")) return true;
  }
  return false;
}

bool is_triangles(std::string_view first, std::string_view line, const std::string& ending) {
  if (line == "ply" || line == "OFF") return true;
  return ending == "obj" && (first.find("\nv ") != std::string_view::npos || line.starts_with("v "));
}

// What slicers write at the top, or a code that heats. A code of the user's own with its number has no S.
bool is_for_a_printer(std::string_view first) {
  for (std::string_view rest = first; !rest.empty();) {
    const std::string_view line = take_line(rest);
    if (line.starts_with(';')) {
      for (const std::string_view slicer : {";FLAVOR:", "PrusaSlicer", "OrcaSlicer", "SuperSlicer", "BambuStudio",
                                            "Slic3r", "Cura_SteamEngine", "Simplify3D", "ideaMaker"}) {
        if (line.find(slicer) != std::string_view::npos) return true;
      }
      continue;
    }
    for (const std::string_view heats : {"M104 S", "M109 S", "M140 S", "M190 S"}) {
      if (line.starts_with(heats)) return true;
    }
  }
  return false;
}

// Lines like "$100=250.000 (x, step/mm)". A program with one of them has it for another reason.
bool is_list_of_settings(std::string_view line, std::string_view rest) {
  const auto is_setting = [](std::string_view text) {
    const std::size_t equals = text.find('=');
    return text.starts_with('$') && equals != std::string_view::npos && is_count(text.substr(1, equals - 1));
  };
  const std::string_view second = take_line(rest);
  return is_setting(line) && is_setting(second) && is_setting(take_line(rest));
}

ForeignFile by_text(std::string_view first, const std::string& ending) {
  std::string_view rest = first;
  const std::string_view line = take_line(rest);
  if (line.starts_with('<')) {
    if (first.find("<svg") != std::string_view::npos || ending == "svg") return svg;
    return line.starts_with("<?xml") || line.starts_with("<!") ? xml : ForeignFile{};
  }
  if (line.starts_with("(kicad_pcb")) return kicad;
  if (is_gerber(line)) return gerber;
  if (line.starts_with("solid") && (first.find("facet") != std::string_view::npos || ending == "stl")) return stl;
  if (is_hpgl(line, ending)) return hpgl;
  if (is_excellon(line, rest, ending)) return excellon;
  if (is_font(first, line)) return font;
  if (is_triangles(first, line, ending)) return model;
  if (is_toml(first, ending)) return description;
  if (const ForeignFile of_numbers = by_numbers(line, rest, ending); !of_numbers.kind.empty()) return of_numbers;
  if (is_for_a_printer(first)) return printer;
  if (is_list_of_settings(line, rest)) return settings;
  if (line == "999" && ending == "dxf") return dxf;
  return line == "0" && take_line(rest) == "SECTION" ? dxf : ForeignFile{};
}

bool is_binary(std::string_view first) {
  return first.find('\0') != std::string_view::npos;
}

}  // namespace

ForeignFile foreign_file(const std::string& name, std::string_view first) {
  const std::string ending = ending_of(name);
  if (const ForeignFile marked = by_mark(first); !marked.kind.empty()) {
    if (marked.kind == gzip.kind && ending == "svgz") return svgz;
    return marked.kind == zip.kind && ending == "3mf" ? model_3mf : marked;
  }
  if (!is_binary(first)) return by_text(first.starts_with("\xEF\xBB\xBF") ? first.substr(3) : first, ending);
  if (ending == "stl") return stl;
  if (first.starts_with("BM")) return bmp;
  return {};
}

}  // namespace passo
