// Where an expat parser is in its text. From version 2.9 on, expat counts in 64 bits and has other names for it.
#pragma once

#include <cstdint>

#include <expat.h>

namespace passo {

// Lines count from 1, columns in bytes from 0.
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
inline std::uint32_t xml_line(XML_Parser parser) {
  return static_cast<std::uint32_t>(XML_GetCurrentLineNumber64(parser));
}
inline std::uint32_t xml_column(XML_Parser parser) {
  return static_cast<std::uint32_t>(XML_GetCurrentColumnNumber64(parser));
}
#else
inline std::uint32_t xml_line(XML_Parser parser) {
  return static_cast<std::uint32_t>(XML_GetCurrentLineNumber(parser));
}
inline std::uint32_t xml_column(XML_Parser parser) {
  return static_cast<std::uint32_t>(XML_GetCurrentColumnNumber(parser));
}
#endif

}  // namespace passo
