// PageFolder: the files of a folder, for browsers. Nothing outside the folder is given, no hidden file, and no link.
// Where FILE.br or FILE.gz lies beside FILE, a browser that knows this compression gets it.
#pragma once

#include <optional>
#include <string>

#include "passo/web/web_server.hpp"

namespace passo {

class PageFolder {
 public:
  explicit PageFolder(std::string folder) : folder_(std::move(folder)) {}
  // "/" is index.html. Empty: there is no such file.
  std::optional<WebAnswer> answer(const WebRequest& request) const;

 private:
  std::string folder_;
};

// The page's folder beside the running program, as scripts/page.sh makes it. Empty: there is none.
std::string usual_page_folder();

}  // namespace passo
