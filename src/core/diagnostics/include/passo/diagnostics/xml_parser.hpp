// XmlParser: reads an XML text with expat, and knows the place of what is wrong with it.
//
// A reader has the member functions begin(const char* name, const char** attributes) and end(const char* name); they
// are called for each element. Handlers of other parts of the text are set with get().
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <expat.h>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

class XmlParser {
 public:
  // `reader` must stay where it is as long as the parser.
  template <class Reader>
  explicit XmlParser(Reader& reader) : parser_(XML_ParserCreate(nullptr), &XML_ParserFree) {
    if (!parser_) return;
    XML_SetUserData(get(), &reader);
    XML_SetElementHandler(
        get(),
        [](void* self, const XML_Char* name, const XML_Char** attributes) {
          static_cast<Reader*>(self)->begin(name, attributes);
        },
        [](void* self, const XML_Char* name) { static_cast<Reader*>(self)->end(name); });
  }

  // Null: there was no memory.
  XML_Parser get() const { return parser_.get(); }

  // Takes the next part of the text. Returns false after an error, and after stop(). `is_last`: the text ends here.
  bool take(std::string_view text, bool is_last) {
    constexpr std::size_t piece = std::size_t{1} << 20;  // expat counts in int
    XML_Status status = get() == nullptr ? XML_STATUS_ERROR : XML_STATUS_OK;
    bool is_done = false;
    while (!is_done && status == XML_STATUS_OK) {
      const std::string_view part = text.substr(0, piece);
      text.remove_prefix(part.size());
      is_done = text.empty();
      status = XML_Parse(get(), part.data(), static_cast<int>(part.size()), is_done && is_last ? 1 : 0);
    }
    return status == XML_STATUS_OK;
  }
  // Ends take() after the present element.
  void stop() { XML_StopParser(get(), XML_FALSE); }

  // Describes the error, in the words of expat.
  std::string fault() const { return get() == nullptr ? "out of memory" : XML_ErrorString(XML_GetErrorCode(get())); }
  // The place in the text, both from 1. From version 2.9 on, expat counts in 64 bits and has other names for it.
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
  std::uint32_t line() const {
    return static_cast<std::uint32_t>(XML_GetCurrentLineNumber64(get()));
  }
  std::uint32_t column() const {
    return static_cast<std::uint32_t>(XML_GetCurrentColumnNumber64(get())) + 1;
  }
#else
  std::uint32_t line() const {
    return static_cast<std::uint32_t>(XML_GetCurrentLineNumber(get()));
  }
  std::uint32_t column() const {
    return static_cast<std::uint32_t>(XML_GetCurrentColumnNumber(get())) + 1;
  }
#endif

  // Returns an error in `file`, at the place in the text.
  Diagnostic refusal(std::string code, const std::string& file, std::string message, std::string expected) const {
    return {.code = std::move(code),
            .file = file,
            .place = {line(), column(), 1},
            .message = std::move(message),
            .expected = std::move(expected),
            .text = ""};
  }

 private:
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser_;
};

}  // namespace passo
