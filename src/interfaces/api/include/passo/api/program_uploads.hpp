// ProgramUploads: chunked uploads of programs, so that an upload shows its progress and can continue after a lost
// connection. Each chunk states its offset; the received data is kept until the upload is complete, dropped, or timed
// out.
//
// Bounded in the number of simultaneous uploads and in total bytes. The announced size is reserved, so a started upload
// never fails for lack of room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "passo/interpreter/interpreter.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct ProgramUpload {
  std::uint64_t id = 0;
  std::string name;
  Dialect dialect = Dialect::linuxcnc;
  std::size_t bytes = 0;  // total size
  std::string text;       // the data received so far
  Seconds heard{0};       // time of the last chunk
};

class ProgramUploads {
 public:
  static constexpr std::size_t most_uploads = 8;
  static constexpr std::size_t most_bytes = std::size_t{128} << 20;
  // An upload without data for this long is removed if another one needs the room.
  static constexpr Seconds longest_silence{600};

  // Begins an upload. Returns null if there is no room. `bytes`: above 0.
  const ProgramUpload* begin(std::string name, Dialect dialect, std::size_t bytes, Seconds now);
  const ProgramUpload* find(std::uint64_t id) const;
  const std::map<std::uint64_t, ProgramUpload>& all() const { return uploads_; }
  enum class Taken : std::uint8_t { more, whole, gap, too_long };
  // Appends a chunk. `from`: its offset. A chunk that does not begin where the last one ended has no effect.
  Taken append(std::uint64_t id, std::size_t from, std::string_view piece, Seconds now);
  // Removes an existing upload and returns it.
  ProgramUpload remove(std::uint64_t id);

 private:
  void drop_silent(Seconds now);

  std::map<std::uint64_t, ProgramUpload> uploads_;
  std::size_t bytes_ = 0;  // total of the reserved bytes
  std::uint64_t last_id_ = 0;
};

}  // namespace passo
