#include "html_page.hpp"

#include <fmt/format.h>

namespace passo {

std::string html_page_begin(std::string_view title, std::string_view style) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
      "data:\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n",
      title, style);
}

std::string html_page_end(std::string_view more) {
  return fmt::format("<footer>Made by Passo " PASSO_VERSION ". {}</footer>\n</body>\n</html>\n", more);
}

}  // namespace passo
