// GerberApertures: reads the aperture definitions (AD) and aperture macros (AM) of a Gerber file. Private to cam/.
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

  // Reads a definition such as "ADD10C,0.5X0.2". `function`: the current aperture attribute.
  void define(const std::string& function);
  // Begins a macro definition, "AMNAME"; its statements follow, one per command.
  void begin_macro();
  void add_statement();

 private:
  struct Definition {
    std::uint32_t code = 0;
    std::string_view shape;
    std::vector<double> values;  // arguments, in the file's unit
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
  GerberMacro* macro_ = nullptr;  // the macro being defined
};

}  // namespace passo
