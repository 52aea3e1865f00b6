// GerberAttributes: reads the attributes of a Gerber file, its apertures and its objects (TF, TA, TO, TD). Private to
// cam/.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "passo/cam/gerber.hpp"

namespace passo {

class GerberAttributes {
 public:
  explicit GerberAttributes(GerberLayer& layer) : layer_(layer) {}

  // Reads an attribute such as "TF.FileFunction,Copper,L1,Top". Ignores attributes that are not about copper.
  void read(std::string_view words);
  // Reads an attribute in a comment, "G04 #@! TF.FileFunction,Copper,L1,Top", as written for readers without attribute
  // support.
  void read_comment(std::string_view words);

  const std::string& aperture_function() const { return aperture_function_; }
  std::uint32_t net() const { return net_; }

 private:
  void set_net(std::string_view name);

  GerberLayer& layer_;
  std::string aperture_function_;
  std::uint32_t net_ = 0;
  std::map<std::string, std::uint32_t, std::less<>> nets_;
};

}  // namespace passo
