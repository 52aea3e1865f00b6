#include "link_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "terminal.hpp"
#include <fmt/format.h>
#include <unistd.h>

namespace passo {
namespace {

// A board that lives answers at once, but a line and a computer have their hiccups.
constexpr Seconds noticeable{0.6};
constexpr int between_words = 10;  // seconds

}  // namespace

void LinkMonitor::update(Seconds silence, Seconds patience, bool ended) {
  if (ended) {
    if (told_ >= 0 && rewrites_) say_("\n");
    told_ = -1;
    return;
  }
  if (silence < noticeable) {
    if (told_ >= 0)
      say_(fmt::format("{}passo: the board answers again; the program continues\n", rewrites_ ? "\r\033[K" : ""));
    told_ = -1;
    return;
  }
  const int left = static_cast<int>(std::ceil(std::max((patience - silence).value(), 0.0)));
  const bool first = told_ < 0;
  if (!first && (rewrites_ ? left == told_ : told_ - left < between_words)) return;
  told_ = left;
  if (rewrites_) {
    say_(fmt::format(
        "\r\033[Kpasso: the board does not answer (cable?). The program continues when it answers, or ends in {} s ",
        left));
  } else if (first) {
    say_(
        fmt::format("passo: the board does not answer; check its cable. The machine stops on the path. The program "
                    "continues when the board answers, or ends in {} s\n",
                    left));
  } else {
    say_(fmt::format("passo: the board still does not answer; the program ends in {} s\n", left));
  }
}

LinkMonitor link_monitor() {
  return LinkMonitor(rewrites_lines(STDERR_FILENO), [](const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  });
}

}  // namespace passo
