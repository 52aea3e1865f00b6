#include "gerber_attributes.hpp"

#include "text_lines.hpp"

namespace passo {

void GerberAttributes::set_net(std::string_view name) {
  if (name.empty() || name == "N/C") {
    net_ = 0;
    return;
  }
  const auto [entry, is_new] = nets_.try_emplace(std::string(name), static_cast<std::uint32_t>(layer_.nets.size()));
  if (is_new) layer_.nets.emplace_back(name);
  net_ = entry->second;
}

void GerberAttributes::read(std::string_view words) {
  const std::string_view kind = words.substr(0, 2);
  words.remove_prefix(std::min<std::size_t>(2, words.size()));
  const std::size_t comma = std::min(words.find(','), words.size());
  const std::string_view name = trimmed(words.substr(0, comma));
  const std::string_view value = trimmed(words.substr(std::min(comma + 1, words.size())));
  if (kind == "TF") {
    if (name == ".FileFunction") layer_.function = value;
    if (name == ".GenerationSoftware") layer_.software = value;
    if (name == ".FilePolarity") layer_.is_negative = value == "Negative";
  } else if (kind == "TA") {
    if (name == ".AperFunction") aperture_function_ = value;
  } else if (kind == "TO") {
    if (name == ".N") set_net(value.substr(0, value.find(',')));
  } else if (kind == "TD") {
    if (name.empty() || name == ".AperFunction") aperture_function_.clear();
    if (name.empty() || name == ".N") net_ = 0;
  }
}

void GerberAttributes::read_comment(std::string_view words) {
  const std::size_t mark = words.find("#@!");
  if (mark == std::string_view::npos) return;
  words = trimmed(words.substr(mark + 3));
  if (words.starts_with('T')) read(words);
}

}  // namespace passo
