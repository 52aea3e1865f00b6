// PageFolder: the files of a folder, for browsers. Nothing outside the folder is given, no hidden file, and no link.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "passo/web/web_server.hpp"

namespace passo {

class PageFolder {
 public:
  explicit PageFolder(std::string folder) : folder_(std::move(folder)) {}
  // "/" is index.html. Empty: there is no such file.
  std::optional<WebAnswer> file(std::string_view path) const;

 private:
  std::string folder_;
};

}  // namespace passo
