// Parses the command-line arguments for stock, tools and clamps.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "passo/cutting/stock_job.hpp"

namespace passo {

// Parses "X0:100,Y0:80,Z-10:0". The error is a message that names `option`.
Result<WishedBlock, std::string> parse_block(const char* option, std::string_view text);
// Parses a clamp: X and Y as above, and Z with its top, "Z15" or "Z0:15".
Result<StockBlock, std::string> parse_clamp(std::string_view text);

struct WishedTool {
  std::optional<std::int32_t> number;  // nothing: for every tool without its own shape
  ToolShape shape;
};
// Parses "ball:3", "2=vee:60:6": flat:D, ball:D, bull:D:CORNER, vee:ANGLE:D[:TIP], taper:TIP:DEGREES_A_SIDE:D.
Result<WishedTool, std::string> parse_tool(std::string_view text);

}  // namespace passo
