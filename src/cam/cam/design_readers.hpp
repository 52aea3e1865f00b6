// The readers behind read_design_board(). Private to cam/.
#pragma once

#include <string>
#include <string_view>

#include "passo/cam/design_board.hpp"

namespace passo {

bool looks_like_eagle_board(std::string_view text);
bool looks_like_easyeda_board(std::string_view text);

DesignBoard read_eagle_board(const std::string& name, std::string_view text, Diagnostics& diagnostics);
DesignBoard read_easyeda_board(const std::string& name, std::string_view text, Diagnostics& diagnostics);

}  // namespace passo
