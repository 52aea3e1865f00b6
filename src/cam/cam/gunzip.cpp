// The only file of cam/ that sees zlib.
#include "gunzip.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <zlib.h>

namespace passo {

std::optional<std::string> gunzip(std::string_view bytes, std::size_t most) {
  constexpr int gzip_alone = 16 + MAX_WBITS;
  z_stream stream{};
  if (bytes.size() > std::numeric_limits<uInt>::max() || inflateInit2(&stream, gzip_alone) != Z_OK) return std::nullopt;
  std::string copy(bytes);  // zlib's input is not const
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  std::string out;
  std::array<char, 65'536> piece{};
  int state = Z_OK;
  while (state == Z_OK ||
         (state == Z_STREAM_END && looks_like_gzip({copy.data() + (copy.size() - stream.avail_in), stream.avail_in}))) {
    if (state == Z_STREAM_END && inflateReset(&stream) != Z_OK) break;
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    state = inflate(&stream, Z_NO_FLUSH);
    const std::size_t got = piece.size() - stream.avail_out;
    if (out.size() + got > most) state = Z_BUF_ERROR;
    out.append(piece.data(), std::min(got, most - out.size()));
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END) return std::nullopt;
  return out;
}

}  // namespace passo
