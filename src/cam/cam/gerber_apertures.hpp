// GerberApertures: reads the definitions of apertures (AD) and macros (AM) of a Gerber file. Private to cam/.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "gerber_macro.hpp"
#include "gerber_numbers.hpp"
#include "gerber_plotter.hpp"

namespace passo {

class GerberApertures {
 public:
  GerberApertures(GerberLayer& layer, GerberFindings& findings, const GerberNumbers& numbers, GerberPlotter& plotter)
      : layer_(layer), findings_(findings), numbers_(numbers), plotter_(plotter) {}

  // "ADD10C,0.5X0.2". `function` is the attribute that apertures get now.
  void define(const std::string& function);
  // "AMNAME": its statements follow, each a command.
  void begin_macro();
  void add_statement();

 private:
  struct Definition {
    std::uint32_t code = 0;
    std::string_view shape;
    std::vector<double> values;  // in the file's unit
    std::size_t values_begin = 0;
  };
  bool read_definition(Definition& definition);
  bool make_shape(const Definition& definition, PlotterAperture& aperture);
  bool make_standard(const Definition& definition, PlotterAperture& aperture);
  bool make_macro(const Definition& definition, const GerberMacro& macro, PlotterAperture& aperture);
  bool cut_hole(const Definition& definition, std::size_t first, PlotterAperture& aperture);

  GerberLayer& layer_;
  GerberFindings& findings_;
  const GerberNumbers& numbers_;
  GerberPlotter& plotter_;
  std::map<std::string, GerberMacro, std::less<>> macros_;
  GerberMacro* macro_ = nullptr;  // that is being read
};

}  // namespace passo
