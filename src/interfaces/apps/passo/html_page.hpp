// HtmlPage: the frame of a page that `passo` writes as one file. Nothing is loaded, and nothing runs, whatever a
// program or a board's name may have brought into the page.
#pragma once

#include <string>
#include <string_view>

namespace passo {

// All before the page's first element. `title` and `style` are HTML and CSS, without markup that a file has brought.
std::string html_page_begin(std::string_view title, std::string_view style);
// All after the last one. `more` names where each part is explained, as HTML.
std::string html_page_end(std::string_view more);

}  // namespace passo
