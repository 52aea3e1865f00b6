#include "passo/report/html.hpp"

#include <cstdint>

#include "characters.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    switch (text.front()) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\'': result += "&#39;"; break;
      case '\t':
      case '\n': result += text.front(); break;
      default: result += length > 0 ? text.substr(0, length) : "\uFFFD";
    }
    text.remove_prefix(length > 0 ? length : 1);
  }
  return result;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

std::string inline_svg(std::string_view svg, std::string_view name, std::string_view label) {
  const std::size_t begin = svg.find("<svg ");
  if (begin == std::string_view::npos) return "";
  std::string text(svg.substr(begin));
  replace_all(text, " id=\"", fmt::format(" id=\"{}-", name));
  replace_all(text, "xlink:href=\"#", fmt::format("xlink:href=\"#{}-", name));
  replace_all(text, "url(#", fmt::format("url(#{}-", name));
  return fmt::format("<svg role=\"img\" aria-label=\"{}\" {}", html_text(label), text.substr(5));
}

std::string inline_png(std::string_view png, std::string_view label) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n", html_text(label), base64(png));
}

}  // namespace passo
