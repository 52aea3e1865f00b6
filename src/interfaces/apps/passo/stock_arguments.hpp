// What the command line says of stock, tools and clamps, as text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "passo/cutting/stock_job.hpp"

namespace passo {

// "X0:100,Y0:80,Z-10:0". The failure is a message that names `option`.
Result<WishedBlock, std::string> parse_block(const char* option, std::string_view text);
// A clamp: X and Y as above, and Z with its top, "Z15" or "Z0:15".
Result<StockBlock, std::string> parse_clamp(std::string_view text);

struct WishedTool {
  std::optional<std::int32_t> number;  // nothing: of every tool that has no shape of its own
  ToolShape shape;
};
// "ball:3", "2=vee:60:6": flat:D, ball:D, bull:D:CORNER, vee:ANGLE:D[:TIP], taper:TIP:DEGREES_A_SIDE:D.
Result<WishedTool, std::string> parse_tool(std::string_view text);

}  // namespace passo
