// ZipArchive: reads single files of a zip archive in memory, piece by piece. Private to surface_file/.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace passo {

class ZipArchive {
 public:
  // `bytes` must outlive this object.
  explicit ZipArchive(std::string_view bytes);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  // False: it is damaged.
  bool is_open() const { return file_ != nullptr; }
  bool has(const std::string& name) const;
  // Passes the unpacked file to `take` in pieces of a few KiB, until `take` returns false or `most` bytes have been
  // read. Returns the reason if the file cannot be read to its end; empty: it was read.
  std::string read(const std::string& name, std::size_t most, const std::function<bool(std::string_view)>& take) const;

 private:
  struct Close {
    void operator()(void* file) const;
  };
  struct Reading;

  std::unique_ptr<Reading> reading_;
  std::unique_ptr<void, Close> file_;
};

}  // namespace passo
