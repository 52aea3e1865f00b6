// HtmlPage: the frame of an HTML page that `passo` writes as one file. The page loads nothing and runs no script,
// whatever text a program or a board's name contributes.
#pragma once

#include <string>
#include <string_view>

namespace passo {

// Returns everything before the page's first element. `title` and `style` are HTML and CSS, without text from files.
std::string html_page_begin(std::string_view title, std::string_view style);
// Returns everything after the last element. `more` refers to the explanation of each part, as HTML.
std::string html_page_end(std::string_view more);

}  // namespace passo
