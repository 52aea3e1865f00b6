// PageFolder: serves the files of a folder to browsers. It never serves files outside the folder, hidden files, or
// links. If FILE.br or FILE.gz exists beside FILE, a browser that supports this compression gets it.
#pragma once

#include <optional>
#include <string>

#include "passo/web/web_server.hpp"

namespace passo {

class PageFolder {
 public:
  explicit PageFolder(std::string folder) : folder_(std::move(folder)) {}
  // Returns the file at a path; "/" is index.html. Empty: there is no such file.
  std::optional<WebAnswer> answer(const WebRequest& request) const;

 private:
  std::string folder_;
};

// Returns the folder of the web interface beside the running program, as created by scripts/page.sh. Empty: there is
// none.
std::string usual_page_folder();

}  // namespace passo
