#include "passo/cam/drawing_file.hpp"

#include "gunzip.hpp"

#include "passo/cam/design_board.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {

Drawing read_drawing(const std::string& path, const DrawingFileOptions& options, Diagnostics& diagnostics) {
  Drawing nothing;
  nothing.file = path;
  std::optional<std::string> bytes = read_bytes(
      path, {.area = "drawing", .expected = "a drawing (DXF, SVG, SVGZ, HPGL), a drill file or a KiCad board"},
      diagnostics);
  if (!bytes) return nothing;
  if (looks_like_gzip(*bytes)) {
    constexpr std::size_t most_unpacked = std::size_t{256} * 1024 * 1024;
    bytes = gunzip(*bytes, most_unpacked);
    if (!bytes) {
      diagnostics.add(of_file("drawing.bad-gzip", path,
                              "the compressed file is damaged, or larger than 256 MiB when unpacked",
                              "an SVGZ drawing, or another drawing compressed with gzip"));
      return nothing;
    }
  }
  const bool is_svg = looks_like_svg(*bytes) && !looks_like_dxf(*bytes) && !looks_like_design_board(*bytes);
  if (!is_svg && !looks_like_dxf(*bytes) && (!options.svg.colors.empty() || !options.svg.names.empty())) {
    diagnostics.add(of_file("drawing.no-colours", path, "shapes of this drawing cannot be selected by colour or name",
                            "an SVG or DXF drawing, or --layer"));
    return nothing;
  }
  if (looks_like_dxf(*bytes)) {
    DxfOptions reading = options.dxf;
    reading.colors = options.svg.colors;
    reading.names = options.svg.names;
    return read_dxf(path, *bytes, reading, diagnostics);
  }
  if (looks_like_design_board(*bytes)) return read_design_board(path, *bytes, diagnostics).drills;
  if (is_svg) return read_svg(path, *bytes, options.svg, diagnostics);
  if (looks_like_hpgl(*bytes)) return read_hpgl(path, *bytes, options.hpgl, diagnostics);
  if (looks_like_excellon(*bytes)) return read_excellon(path, *bytes, options.excellon, diagnostics);
  diagnostics.add(of_file("drawing.unknown-kind", path,
                          "this is not a DXF or SVG drawing, HPGL plot, drill file or KiCad board",
                          "a file that begins with SECTION (DXF), <svg, IN; (HPGL), (kicad_pcb, or with M48, METRIC, "
                          "INCH or tools (Excellon)"));
  return nothing;
}

}  // namespace passo
